# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

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


def test_a_few_centimetres_within_a_zone_are_no_other_place() -> None:
    first, second = BODY.find(PLACES["chest"]), BODY.find(PLACES["chest"] + 0.04)
    assert same_zone(first, second).all()
    assert not wrong_place(first, second).any()


def test_a_step_into_the_next_zone_is_not_yet_another_place() -> None:
    first, second = BODY.find(PLACES["chest"]), BODY.find(PLACES["chest"] - (0.0, 0.0, 0.15))
    assert not same_zone(first, second).any()
    assert not wrong_place(first, second).any()


def test_a_hand_that_lies_across_a_border_is_on_both_its_sides() -> None:
    above, below = (BODY.find(np.array([[0.3, 0.0, -0.16 + way]])) for way in (0.03, -0.03))
    farther = BODY.find(np.array([[0.3, 0.0, -0.16 - 0.06]]))
    assert same_zone(above, below).all()
    assert not same_zone_of_middles(above, below).any()
    assert not same_zone(BODY.find(np.array([[0.3, 0.0, -0.16 + 0.05]])), farther).any()
