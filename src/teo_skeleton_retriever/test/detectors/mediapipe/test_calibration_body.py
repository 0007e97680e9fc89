# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest
from capsule_person import ROW, person_2d, pose

from teo_skeleton_retriever.detectors.mediapipe.calibration import BODY_SHIFTS, corrected_body


def at(distance: float) -> np.ndarray:
    return person_2d(pose((-0.2, 0.2, -0.1), (0.2, 0.2, -0.1), at=(0.0, -0.2, distance))).body


def test_shoulders_are_moved_out_and_down() -> None:
    moved = corrected_body(at(2.0), BODY_SHIFTS) - at(2.0)
    assert moved[ROW["LShoulder"], 0] > 0 > moved[ROW["RShoulder"], 0]  # the person faces the camera
    assert (moved[[ROW["LShoulder"], ROW["RShoulder"]], 1] > 0).all()
    assert not moved[ROW["Nose"]].any()


def test_who_stands_twice_as_far_is_moved_half_as_much_in_the_image() -> None:
    near, far = (corrected_body(at(d), BODY_SHIFTS) - at(d) for d in (1.5, 3.0))
    np.testing.assert_allclose(near[ROW["LShoulder"]], 2 * far[ROW["LShoulder"]], rtol=1e-6)


def test_without_hips_shoulders_are_moved_out_only() -> None:
    body = at(2.0).copy()
    body[ROW["MidHip"]] = 0.0
    assert (corrected_body(body, BODY_SHIFTS) - body)[ROW["LShoulder"], 1] == pytest.approx(0.0, abs=1e-9)


def test_nobody_stays_nobody() -> None:
    assert not corrected_body(np.zeros((25, 3)), BODY_SHIFTS).any()
