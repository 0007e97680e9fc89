# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Movements, as the names of the symbols in Unicode say them and their drawings show."""

from __future__ import annotations

import numpy as np
import pytest

from teo_sign_authoring.signwriting.movement import Circling, Path, Swinging, movement_of
from teo_sign_authoring.signwriting.written_sign import read_fsw

UP, DOWN, LEFT, RIGHT = (0, 0, 1), (0, 0, -1), (0, 1, 0), (0, -1, 0)
FRONT, BACK = (1, 0, 0), (-1, 0, 0)


def path(symbol: str) -> Path:
    movement = movement_of(read_fsw(f"M520x520{symbol}480x480")[0])
    assert movement is not None and isinstance(movement.kind, Path)
    return movement.kind


@pytest.mark.parametrize(
    ("symbol", "way"),
    [
        ("S22a00", UP),  # double lines: parallel to the wall
        ("S22a04", DOWN),
        ("S22a02", LEFT),
        ("S22a06", RIGHT),
        ("S26500", FRONT),  # single line: parallel to the floor
        ("S26504", BACK),
        ("S26506", RIGHT),
        ("S28800", UP),
        ("S2b700", FRONT),
        ("S2b704", BACK),
        ("S2d500", LEFT),
        ("S2d508", RIGHT),
        ("S2a600", UP),
    ],
)
def test_an_arrow_goes_the_way_it_points(symbol: str, way: tuple[int, int, int]) -> None:
    kind = path(symbol)
    np.testing.assert_allclose(kind.way / np.linalg.norm(kind.way), way, atol=1e-9)


def test_longer_arrows_are_longer_ways() -> None:
    lengths = [float(np.linalg.norm(path(f"S22{letter}04").way)) for letter in "abcd"]
    assert lengths == sorted(lengths)
    assert 4.0 < lengths[0] < lengths[-1] < 40.0  # [cm]


@pytest.mark.parametrize(
    ("symbol", "times", "to_and_fro"),
    [("S22a04", 1, False), ("S22f04", 2, False), ("S26c00", 2, True), ("S27100", 3, True)],
)
def test_double_and_triple_arrows_repeat(symbol: str, times: int, to_and_fro: bool) -> None:
    kind = path(symbol)
    assert (kind.times, kind.to_and_fro) == (times, to_and_fro)


@pytest.mark.parametrize(("symbol", "hands"), [("S22a04", "right"), ("S22a14", "left"), ("S22a24", "both")])
def test_arrowheads_say_whose_movement_it_is(symbol: str, hands: str) -> None:
    movement = movement_of(read_fsw(f"M520x520{symbol}480x480")[0])
    assert movement is not None and movement.hands == hands


def test_a_curve_over_the_floor_swings_up() -> None:
    (segment,) = path("S2b700").segments
    assert segment.bulge[2] > 0.0


@pytest.mark.parametrize(
    ("symbol", "begins", "goes"),
    [
        ("S2e300", UP, LEFT),  # counterclockwise, as drawn
        ("S2e308", UP, RIGHT),
        ("S2ea00", BACK, UP),  # the near side rises: like a wheel that rolls forward
        ("S2ea06", BACK, RIGHT),
    ],
)
def test_circles_begin_and_turn_as_drawn(
    symbol: str, begins: tuple[int, int, int], goes: tuple[int, int, int]
) -> None:
    movement = movement_of(read_fsw(f"M520x520{symbol}480x480")[0])
    assert movement is not None and isinstance(movement.kind, Circling)
    np.testing.assert_allclose(movement.kind.first / np.linalg.norm(movement.kind.first), begins, atol=1e-9)
    np.testing.assert_allclose(movement.kind.then / np.linalg.norm(movement.kind.then), goes, atol=1e-9)


def test_fingers_that_beat_are_a_swing_and_a_jaw_is_nothing_a_hand_does() -> None:
    movement = movement_of(read_fsw("M520x520S22504480x480")[0])
    assert movement is not None and isinstance(movement.kind, Swinging)
    assert movement_of(read_fsw("M520x520S29600480x480")[0]) is None  # a loop is not read
