# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import numpy as np
import pytest

from teo_skeleton_retriever.depth.occluders import occluders
from teo_skeleton_retriever.layouts.person_layout import ARMS, KEYPOINTS, ROW

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
    nearest = arms.before(rays, depth)
    np.testing.assert_array_equal(np.isfinite(nearest), [True, True, False, False, False])
    np.testing.assert_allclose(nearest[:2], 1.0)


def test_a_limb_does_not_hide_its_own_joints() -> None:
    arms = occluders(arm_across(-0.2, 1.0), {})
    rays, depth = np.zeros((KEYPOINTS, 2)), np.full(KEYPOINTS, math.nan)
    rays[ELBOW], depth[ELBOW] = (-0.15, -0.2), 1.05
    rays[ROW["Nose"]], depth[ROW["Nose"]] = (-0.1, -0.2), 1.4
    hidden = np.isfinite(arms.before(rays, depth, arms.of({ELBOW: [ELBOW]})))
    assert np.flatnonzero(hidden).tolist() == [ROW["Nose"]]


@pytest.mark.parametrize(("before", "hidden"), [(0.06, False), (0.24, True)])
def test_a_forearm_that_points_at_the_camera_hides_its_own_elbow(before: float, hidden: bool) -> None:
    body = NOWHERE.copy()
    body[ELBOW], body[WRIST] = (0.0, 0.0, 1.5), (0.0, 0.05, 1.5 - before)
    arms = occluders(body, {"R": np.full((21, 3), 0.3)})
    rays, depth = np.zeros((KEYPOINTS, 2)), np.full(KEYPOINTS, math.nan)
    depth[ELBOW] = 1.5
    found = arms.before(rays, depth, arms.of({ELBOW: [ELBOW]}))
    assert np.isfinite(found[ELBOW]) == hidden


def test_the_skin_of_an_arm_is_told_from_the_face_behind_it() -> None:
    arms = occluders(arm_across(-0.2, 1.0), {})
    rays, _ = looked_at((0.0, -0.2, 1.0), (0.0, 0.2, 1.0))
    depths = np.array([[0.97, 1.45, math.nan], [0.97, 1.45, math.nan]])
    shown = arms.shown(rays, depths)
    np.testing.assert_array_equal(shown, [[True, False, False], [False, False, False]])
