# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from itertools import combinations

import numpy as np
import pytest

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.depth.depth_lookup import Surfaces
from teo_skeleton_retriever.depth.girdle_depth import GirdleDepths, girdle_depths

BEHIND = np.array([0.06, 0.057, 0.057])
NOWHERE = np.full(3, np.nan)
RNG = np.random.default_rng(7)
HIDDEN = [rows for count in (0, 1, 2) for rows in combinations(range(3), count)]


def surfaces(skin: FloatArray, before: FloatArray) -> Surfaces:
    """The skin, but where something lies before it (finite) that alone."""
    depth = np.full((3, 3), np.nan)
    depth[:, 0] = np.where(np.isfinite(before), before, skin)
    known = np.isfinite(depth)
    return Surfaces(depth, np.where(known, 0.008, np.nan), known.astype(float))


def found(truth: FloatArray, before: FloatArray, head: float, expected: FloatArray = NOWHERE) -> GirdleDepths:
    skin = truth - BEHIND + RNG.normal(0.0, 0.008, 3)
    sigma = np.where(np.isfinite(expected), 0.01, np.nan)
    return girdle_depths(surfaces(skin, before), BEHIND, head=head, expected=expected, expected_sigma=sigma)


def person(turned: float) -> tuple[FloatArray, float]:
    """Depths of neck, right and left shoulder, and of the face [m]."""
    middle, half = RNG.uniform(1.0, 2.5), 0.18 * math.sin(turned)
    return np.array([middle, middle - half, middle + half]), middle - RNG.uniform(0.06, 0.13)


@pytest.mark.parametrize("hidden", HIDDEN)
@pytest.mark.parametrize("turned", [-30.0, -10.0, 0.0, 10.0, 30.0])
def test_what_a_hand_hides_is_put_where_the_rest_and_the_images_before_say(
    hidden: tuple[int, ...], turned: float
) -> None:
    truth, face = person(math.radians(turned))
    before = NOWHERE.copy()
    before[list(hidden)] = (truth - BEHIND)[list(hidden)] - RNG.uniform(0.2, 0.35, len(hidden))
    told = found(truth, before, face, expected=truth)
    assert np.flatnonzero(told.hidden).tolist() == list(hidden)
    assert (np.abs(told.depth - truth) < 3.0 * told.sigma + 0.03).all()


@pytest.mark.parametrize("hidden", [rows for rows in HIDDEN if rows])
def test_in_the_first_image_head_and_what_is_seen_tell(hidden: tuple[int, ...]) -> None:
    truth, face = person(0.0)
    before = NOWHERE.copy()
    before[list(hidden)] = (truth - BEHIND)[list(hidden)] - 0.3
    told = found(truth, before, face)
    assert np.flatnonzero(told.hidden).tolist() == list(hidden)
    assert np.abs(told.depth - truth).max() < 0.08


def test_a_hand_before_the_face_does_not_push_the_shoulders_back() -> None:
    truth, face = person(0.0)
    told = found(truth, NOWHERE, face - 0.25)
    assert not told.hidden.any()
    assert np.abs(told.depth - truth).max() < 0.04


def test_without_any_depth_nothing_is_said() -> None:
    nothing = Surfaces(np.full((3, 3), np.nan), np.full((3, 3), np.nan), np.zeros((3, 3)))
    told = girdle_depths(nothing, BEHIND, head=math.nan, expected=NOWHERE, expected_sigma=NOWHERE)
    assert np.isnan(told.depth).all()
    assert not told.hidden.any()


def test_who_was_taken_for_a_hand_in_one_image_is_found_in_the_next() -> None:
    truth, face = person(0.0)
    told = found(truth, NOWHERE, face, expected=truth - np.array([0.0, 0.25, 0.25]))
    assert not told.hidden.any()
