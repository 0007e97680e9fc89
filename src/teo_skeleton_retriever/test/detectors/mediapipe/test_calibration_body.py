# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
from capsule_person import ROW, person_2d, pose

from teo_skeleton_retriever.detectors.mediapipe.calibration import corrected_body


def at(distance: float) -> np.ndarray:
    return person_2d(pose((-0.2, 0.2, -0.1), (0.2, 0.2, -0.1), at=(0.0, -0.2, distance))).body


def test_shoulders_are_moved_out_and_down() -> None:
    moved = corrected_body(at(2.0)) - at(2.0)
    assert moved[ROW["LShoulder"], 0] > 0 > moved[ROW["RShoulder"], 0]  # the person faces the camera
    assert (moved[[ROW["LShoulder"], ROW["RShoulder"]], 1] > 0).all()
    assert not moved[ROW["Nose"]].any()


def test_who_stands_twice_as_far_is_moved_half_as_much_in_the_image() -> None:
    """About: elbows and nose are nearer than the shoulders, and are seen larger from near."""
    near, far = (corrected_body(at(d)) - at(d) for d in (1.5, 3.0))
    np.testing.assert_allclose(near[ROW["LShoulder"]], 2 * far[ROW["LShoulder"]], rtol=0.1)


def test_without_hips_shoulders_are_moved_out_by_what_else_is_seen() -> None:
    whole = corrected_body(at(2.0))
    half = at(2.0).copy()
    half[ROW["MidHip"]] = 0.0
    difference = (whole - corrected_body(half))[ROW["LShoulder"], :2]
    trunk = (at(2.0)[ROW["MidHip"]] - at(2.0)[ROW["Neck"]])[:2]
    np.testing.assert_allclose(difference, 0.044 * trunk, atol=1e-9)


def test_an_elbow_is_moved_away_from_its_shoulder() -> None:
    body = at(2.0)
    moved = corrected_body(body)
    for side in "LR":
        shoulder, elbow = ROW[f"{side}Shoulder"], ROW[f"{side}Elbow"]
        upper_arm = (body[elbow] - body[shoulder])[:2]
        assert (moved[elbow] - body[elbow])[:2] @ upper_arm > 0.0


def test_nobody_stays_nobody() -> None:
    assert not corrected_body(np.zeros((25, 3))).any()
