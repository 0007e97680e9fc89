# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import numpy as np
import pytest

from teo_skeleton_retriever.depth.occluders import occluders
from teo_skeleton_retriever.layouts.person_layout import ARMS

ELBOW, WRIST = ARMS["R"][1:]
NOWHERE = np.full((25, 3), math.nan)


def arm_across(height: float, depth: float) -> np.ndarray:
    """A right forearm of 0.25 m that lies across the view."""
    body = NOWHERE.copy()
    body[ELBOW], body[WRIST] = (-0.15, height, depth), (0.10, height, depth)
    return body


def looked_at(*places: tuple[float, float, float]) -> tuple[np.ndarray, np.ndarray]:
    points = np.array(places)
    return points[:, :2] / points[:, 2:], points[:, 2]


@pytest.mark.parametrize("hands", [{}, {"R": np.full((21, 3), math.nan)}])
def test_what_lies_behind_a_forearm_or_the_hand_that_goes_on_from_it_is_hidden(hands) -> None:
    arms = occluders(arm_across(-0.2, 1.0), hands)
    # Behind the forearm, behind the hand that no detector saw, above it, before it, beyond the hand.
    rays, depth = looked_at(
        (0.0, -0.3, 1.5), (0.24, -0.3, 1.5), (0.0, 0.0, 1.5), (0.0, -0.16, 0.8), (0.6, -0.3, 1.5)
    )
    assert arms.hide(rays, depth, {}).tolist() == [True, True, False, False, False]


def test_the_skin_of_an_arm_is_told_from_the_face_behind_it() -> None:
    arms = occluders(arm_across(-0.2, 1.0), {})
    rays, _ = looked_at((0.0, -0.2, 1.0), (0.0, 0.2, 1.0))
    depths = np.array([[0.97, 1.45, math.nan], [0.97, 1.45, math.nan]])
    shown = arms.shown(rays, depths)
    np.testing.assert_array_equal(shown, [[True, False, False], [False, False, False]])
