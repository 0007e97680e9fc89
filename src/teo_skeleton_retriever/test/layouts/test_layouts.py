# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from teo_skeleton_retriever.compat.original_skeleton import (
    SKELETON_STD,
)
from teo_skeleton_retriever.layouts.layout import BODY_25, COCO_18, FACE_70, HAND_21, Layout

SIZES = {BODY_25: 25, COCO_18: 18, HAND_21: 21, FACE_70: 70, SKELETON_STD: 17}


@pytest.mark.parametrize("layout", SIZES, ids=lambda layout: layout.name)
def test_every_layout_has_its_number_of_different_keypoints(layout: Layout) -> None:
    assert len(layout) == SIZES[layout] == len(set(layout.keypoints))


def test_body_25_is_numbered_as_openpose_documents() -> None:
    documented = {
        0: "Nose",
        4: "RWrist",
        7: "LWrist",
        8: "MidHip",
        15: "REye",
        18: "LEar",
        19: "LBigToe",
        24: "RHeel",
    }
    assert {i: BODY_25.keypoints[i] for i in documented} == documented
    assert len(BODY_25.bones) == 24


def test_coco_puts_the_right_eye_before_the_left() -> None:
    assert COCO_18.keypoints[14:] == ("REye", "LEye", "REar", "LEar")


def test_a_hand_is_five_chains_from_the_wrist() -> None:
    assert [HAND_21.bones[4 * i][0] for i in range(5)] == ["Wrist"] * 5
    assert [HAND_21.bones[4 * i + 3][1] for i in range(5)] == [
        "ThumbTip", "IndexTip", "MiddleTip", "RingTip", "PinkyTip",
    ]  # fmt: skip


def test_face_rings_are_closed_and_pupils_stand_alone() -> None:
    assert ("Face41", "Face36") in FACE_70.bones
    assert ("Face16", "Face0") not in FACE_70.bones
    assert not any("Face68" in bone or "Face69" in bone for bone in FACE_70.bones)
