# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from teo_skeleton_retriever.layouts.layout import BODY_25, COCO_18, HAND_21, Layout
from teo_skeleton_retriever.layouts.skeleton_3d import BodyFrame, body_frame


@pytest.mark.parametrize(
    ("layout", "documented"),
    [
        (BODY_25, {0: "Nose", 4: "RWrist", 7: "LWrist", 8: "MidHip", 15: "REye", 18: "LEar", 19: "LBigToe"}),
        (COCO_18, {14: "REye", 15: "LEye", 16: "REar", 17: "LEar"}),
        (HAND_21, {0: "Wrist", 4: "ThumbTip", 8: "IndexTip", 12: "MiddleTip", 16: "RingTip", 20: "PinkyTip"}),
    ],
    ids=lambda one: getattr(one, "name", ""),
)
def test_keypoints_are_numbered_as_openpose_documents(layout: Layout, documented: dict[int, str]) -> None:
    assert {i: layout.keypoints[i] for i in documented} == documented


# Someone who faces the camera, upright, at 2 m, in its optical frame: x right, y down, z away.
FACING = {
    "left_shoulder": np.array([0.2, -0.3, 2.0]),
    "right_shoulder": np.array([-0.2, -0.3, 2.0]),
    "left_hip": np.array([0.12, 0.2, 2.0]),
    "right_hip": np.array([-0.12, 0.2, 2.0]),
}
NOWHERE = np.full(3, math.nan)
angles = st.floats(-math.pi, math.pi)
moves = st.tuples(angles, angles, angles, st.floats(-3, 3), st.floats(-3, 3), st.floats(-3, 3))


def frame_of(points: dict[str, np.ndarray]) -> BodyFrame:
    frame = body_frame(**points)
    assert frame is not None
    return frame


def test_someone_who_faces_the_camera_looks_at_it() -> None:
    frame = frame_of(FACING)
    np.testing.assert_allclose(frame.origin, [0.0, 0.2, 2.0])
    x, y, z = frame.rotation.T
    np.testing.assert_allclose(x, [0, 0, -1], atol=1e-12)  # out of the chest, towards the camera
    np.testing.assert_allclose(y, [1, 0, 0], atol=1e-12)  # the person's left is the camera's right
    np.testing.assert_allclose(z, [0, -1, 0], atol=1e-12)  # up
    assert frame.anchor == "hips"


@given(moves)
@settings(max_examples=50)
def test_in_the_body_frame_it_does_not_matter_where_a_person_stands(move: tuple[float, ...]) -> None:
    rotation, shift = Rotation.from_euler("xyz", move[:3]).as_matrix(), np.array(move[3:])
    hand = np.array([0.1, 0.0, 1.6])
    moved = frame_of({name: rotation @ point + shift for name, point in FACING.items()})
    np.testing.assert_allclose(
        moved.from_camera(rotation @ hand + shift), frame_of(FACING).from_camera(hand), atol=1e-9
    )
    np.testing.assert_allclose(moved.rotation.T @ moved.rotation, np.eye(3), atol=1e-12)
    assert np.linalg.det(moved.rotation) == pytest.approx(1.0)


@pytest.mark.parametrize("hips", [{"left_hip": None}, {"right_hip": NOWHERE}])
def test_without_hips_it_stands_on_the_shoulders(hips: dict[str, np.ndarray | None]) -> None:
    frame = frame_of({**FACING, **hips})
    assert frame.anchor == "shoulders"
    np.testing.assert_allclose(frame.origin, [0.0, -0.3, 2.0])
    np.testing.assert_allclose(frame.rotation, frame_of(FACING).rotation, atol=1e-12)


@pytest.mark.parametrize(
    "changes",
    [
        {"left_shoulder": NOWHERE},
        {"left_shoulder": FACING["right_shoulder"]},
        {"left_hip": np.array([5.0, -0.3, 2.0]), "right_hip": np.array([5.0, -0.3, 2.0])},
    ],
)
def test_points_that_make_no_frame_give_none(changes: dict[str, np.ndarray]) -> None:
    assert body_frame(**{**FACING, **changes}) is None
