# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from teo_common.arrays import Array
from teo_sign_capture.retarget.place_figures import (
    HEIGHTS,
    SIDES,
    Zones,
    same_zone,
    same_zone_of_middles,
    wrong_place,
)

# A body of 0.2 m from the middle to the shoulder: waist, chest, chin, crown; right hands are at negative y.
BODY = Zones(
    heights=np.array([-0.35, -0.16, 0.12, 0.33]),
    sides=np.array([-0.24, -0.08, 0.08]),
    face=np.array([[0.10, 0.0, 0.17], [0.10, 0.0, 0.26]]),
    near=0.10,
    breadth=0.08,
    behind=-0.10,
)
PLACES: dict[str, Array] = {
    "mouth": np.array([[0.12, 0.0, 0.16]]),
    "chest": np.array([[0.15, -0.02, -0.05]]),
    "beside the shoulder": np.array([[0.30, -0.35, 0.02]]),
    "before the face": np.array([[0.40, -0.02, 0.20]]),
    "nape": np.array([[-0.15, -0.02, 0.05]]),
    "throat": np.array([[0.15, -0.02, 0.05]]),
    "knee": np.array([[0.30, -0.15, -0.50]]),
}


@pytest.mark.parametrize(
    ("place", "height", "side"),
    [
        ("mouth", "face", "middle"),
        ("chest", "chest", "middle"),
        ("beside the shoulder", "chest", "outside"),
        ("knee", "below the waist", "own side"),
    ],
)
def test_places_are_in_the_zones_that_their_names_say(place: str, height: str, side: str) -> None:
    found = BODY.find(PLACES[place])
    assert (HEIGHTS[found.height[0]], SIDES[found.side[0]]) == (height, side)


@pytest.mark.parametrize(
    ("shown", "made"),
    [
        ("beside the shoulder", "mouth"),
        ("mouth", "before the face"),
        ("chest", "knee"),
        ("nape", "throat"),
    ],
)
def test_another_place_is_wrong_either_way(shown: str, made: str) -> None:
    first, second = BODY.find(PLACES[shown]), BODY.find(PLACES[made])
    assert wrong_place(first, second).all()
    assert wrong_place(second, first).all()


CHEST = (0.15, -0.02, -0.05)
BORDER = -0.16  # between belly and chest


@pytest.mark.parametrize(
    ("first", "second", "same", "same_middle"),
    [
        (CHEST, (0.19, 0.02, -0.01), True, True),  # some centimetres within a zone
        (CHEST, (0.15, -0.02, -0.20), False, False),  # a step into the next zone
        ((0.3, 0.0, BORDER + 0.03), (0.3, 0.0, BORDER - 0.03), True, False),  # hands that lie across a border
        ((0.3, 0.0, BORDER + 0.05), (0.3, 0.0, BORDER - 0.06), False, False),
    ],
)
def test_hands_near_each_other_are_in_one_zone_or_the_next_and_at_no_other_place(
    first: Sequence[float], second: Sequence[float], same: bool, same_middle: bool
) -> None:
    one, other = (BODY.find(np.array([place])) for place in (first, second))
    assert same_zone(one, other).all() == same
    assert same_zone_of_middles(one, other).all() == same_middle
    assert not wrong_place(one, other).any()
