# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from capsule_person import imagined_shape, pose
from scipy.spatial.transform import Rotation

from teo_skeleton_retriever.depth.depth_lookup import Surfaces
from teo_skeleton_retriever.depth.hand_shape import CHILD, PARENT, HandFit, HandView, fit_hands, laid, turned
from teo_skeleton_retriever.depth.skin import HAND_DEPTHS

HAND = pose((-0.4, -0.2, -0.1), (0.25, 0.05, -0.2), curl=0.3).right_hand
BENT = pose((-0.25, 0.05, -0.35), (0.25, 0.05, -0.2), curl=0.9).right_hand


def view(hand: np.ndarray, *, noise: float = 0.0, seed: int = 0, **changes: Any) -> HandView:
    depth = hand[:, 2] - HAND_DEPTHS + np.random.default_rng(seed).normal(0.0, 1.0, 21) * noise
    nothing = np.full((21, 2), math.nan)
    seen = HandView(
        rays=hand[:, :2] / hand[:, 2:],
        surfaces=Surfaces(
            np.column_stack([depth, nothing]),
            np.column_stack([np.full(21, 0.004), nothing]),
            np.column_stack([np.ones(21), np.zeros((21, 2))]),
        ),
        world=imagined_shape(hand),
        expected=math.nan,
        wrist=math.nan,
    )
    return seen._replace(**changes)


def fit(seen: HandView) -> HandFit:
    (found,) = fit_hands([seen], 1.0)
    assert found is not None
    return found


def error(found: HandFit, hand: np.ndarray) -> float:
    return float(np.linalg.norm(found.points - hand, axis=1).mean())


@pytest.mark.parametrize("hand", [HAND, BENT])
def test_the_shape_evens_out_noise(hand: np.ndarray) -> None:
    assert np.mean([error(fit(view(hand, noise=0.01, seed=i)), hand) for i in range(10)]) < 0.0075


@pytest.mark.parametrize("hand", [HAND, BENT])
@pytest.mark.parametrize("tilt", [(0.9, 0.0, 0.0), (-0.9, 0.0, 0.0), (0.0, 0.9, 0.0), (0.0, -0.9, 0.0)])
def test_a_shape_imagined_leaning_the_wrong_way_does_not_outweigh_what_is_measured(
    hand: np.ndarray, tilt: tuple[float, float, float]
) -> None:
    leaning = imagined_shape(hand) @ Rotation.from_rotvec(tilt).as_matrix()
    assert error(fit(view(hand, world=leaning)), hand) < 0.006


def test_fingers_without_depth_follow_from_the_shape() -> None:
    seen = view(HAND)
    seen.surfaces.depth[9:, 0] = math.nan
    seen.surfaces.support[9:, 0] = 0.0
    found = fit(seen)
    assert error(found, HAND) < 0.012
    assert not found.measured[9:].any()
    assert (found.sigma[9:] > found.sigma[:9].max()).all()


def test_of_two_surfaces_the_hands_own_is_chosen_by_where_it_is_thought_to_be() -> None:
    seen = view(HAND, expected=float(HAND[:, 2].mean()))
    seen.surfaces.depth[:, 1] = seen.surfaces.depth[:, 0]
    seen.surfaces.depth[:, 0] -= 0.2  # the other hand, before this one
    seen.surfaces.support[:, :2] = 0.5
    seen.surfaces.sigma[:, 1] = 0.004
    assert error(fit(seen), HAND) < 0.01


def test_without_depth_the_hand_is_where_its_arm_ends() -> None:
    seen = view(HAND, wrist=float(HAND[0, 2]))
    seen.surfaces.depth[:] = math.nan
    found = fit(seen)
    assert error(found, HAND) < 0.02
    assert not found.certain


def test_a_hand_of_which_few_keypoints_are_seen_is_not_fitted() -> None:
    seen = view(HAND)
    seen.rays[:15] = math.nan
    assert fit_hands([seen], 1.0) == [None]


def test_a_hand_is_turned_and_never_mirrored() -> None:
    bones = (HAND[1:] - HAND[0])[None]
    mirrored = bones * [-1.0, 1.0, 1.0]
    way, *_ = np.linalg.lstsq(mirrored[0], turned(mirrored, bones, np.ones((1, 20)))[0], rcond=None)
    assert np.linalg.det(way) == pytest.approx(1.0)


def test_depths_of_something_else_do_not_pull_a_hand() -> None:
    measured = HAND[:, 2].copy()
    measured[[8, 12, 16, 20]] += 0.15  # what is behind four fingertips
    bends = HAND / HAND[:, 2:]
    depths = laid((HAND[CHILD] - HAND[PARENT])[None], bends[None], measured[None], np.ones((1, 21)))[0]
    np.testing.assert_allclose(depths, HAND[:, 2], atol=0.006)
