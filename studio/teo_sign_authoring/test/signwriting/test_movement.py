# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Movements, as symbols are named in Unicode and drawn; how a hand is held, as SignWriting is taught."""

from __future__ import annotations

import numpy as np
import pytest

from teo_sign_authoring.signwriting.hand_symbols import orientation_of, written_side
from teo_sign_authoring.signwriting.movement import Circling, Path, Swinging, movement_of
from teo_sign_authoring.signwriting.written_sign import read_fsw
from teo_sign_capture.signing_space import direction

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
        ("S22a06", RIGHT),
        ("S26500", FRONT),  # single line: parallel to the floor
        ("S26506", RIGHT),
        ("S28800", UP),
        ("S2b700", FRONT),
        ("S2d500", LEFT),
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


@pytest.mark.parametrize(
    ("symbol", "begins", "goes"),
    [
        ("S2e300", UP, LEFT),  # counterclockwise, as drawn
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


@pytest.mark.parametrize(
    ("symbol", "side", "palm", "fingers"),
    [
        ("S15a00", "right", "back", "up"),  # white, upright: one sees the own palm
        ("S15a20", "right", "front", "up"),  # black: the palm faces the addressee
        ("S15a10", "right", "in", "up"),  # half white, on the left: the right palm faces left
        ("S15a18", "left", "in", "up"),  # its mirror
        ("S15a02", "right", "back", "in"),  # turned by 90 deg counterclockwise: before the chest
        ("S15a30", "right", "up", "front"),  # white with a gap: palm up
        ("S15a50", "right", "down", "front"),
        ("S15a40", "right", "in", "front"),
        ("S15a14", "right", "out", "down"),
        ("S15a01", "right", "back", "up in"),
    ],
)
def test_fill_and_rotation_say_palm_and_fingers(symbol: str, side: str, palm: str, fingers: str) -> None:
    (hand,) = read_fsw(f"M520x520{symbol}480x480")
    assert written_side(hand) == side
    held = orientation_of(hand, written_side(hand))
    np.testing.assert_allclose(held.palm, direction(palm), atol=1e-9)
    np.testing.assert_allclose(held.fingers, direction(fingers), atol=1e-9)


def test_the_thumb_of_an_upright_right_palm_points_out() -> None:
    (hand,) = read_fsw("M520x520S15a00480x480")
    np.testing.assert_allclose(orientation_of(hand, "right").thumb_side, direction("out"), atol=1e-9)


def test_fingers_that_beat_are_a_swing_and_a_loop_is_not_read() -> None:
    movement = movement_of(read_fsw("M520x520S22504480x480")[0])
    assert movement is not None and isinstance(movement.kind, Swinging)
    assert movement_of(read_fsw("M520x520S29600480x480")[0]) is None
    assert path("S2b700").segments[0].bulge[2] > 0.0  # a curve over the floor swings up
