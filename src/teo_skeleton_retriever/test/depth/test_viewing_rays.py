# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
from capsule_person import CAMERA

from teo_skeleton_retriever.depth.depth_lookup import viewing_rays
from teo_skeleton_retriever.layouts.layout import BODY_25
from teo_skeleton_retriever.layouts.person_2d import as_body_25


def test_keypoints_that_are_unsure_absent_or_outside_the_image_are_not_seen() -> None:
    keypoints = np.array([[10.0, 10.0, 0.9], [10.0, 10.0, 0.2], [0.0, 0.0, 0.0], [-5.0, 10.0, 0.9]])
    seen = viewing_rays(keypoints, CAMERA, 0.3)
    assert seen.seen.tolist() == [True, False, False, False]
    assert np.isnan(seen.rays[1:]).all()
    assert seen.confidence.tolist() == [0.9, 0.0, 0.0, 0.0]


def test_logits_for_confidences_stay_within_0_and_1() -> None:
    assert viewing_rays(np.array([[10.0, 10.0, 8.3]]), CAMERA, 0.3).confidence.tolist() == [1.0]


def test_bodies_of_every_layout_have_the_same_arms() -> None:
    arms = np.arange(24.0).reshape(8, 3) + 1.0
    for size in (25, 18, 15):
        body = np.zeros((size, 3))
        body[:8] = arms
        np.testing.assert_array_equal(as_body_25(body)[1:8], arms[1:])
    assert not as_body_25(np.zeros((0, 3))).any()


def test_the_top_of_the_head_is_no_nose() -> None:
    body = np.full((15, 3), 5.0)
    assert not as_body_25(body)[BODY_25.index["Nose"]].any()
