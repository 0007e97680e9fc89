# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How a hand is held, as SignWriting is taught: white is the palm, a gap the floor's plane."""

from __future__ import annotations

import numpy as np
import pytest

from teo_sign_authoring.signwriting.page import orientation_of, written_side
from teo_sign_authoring.signwriting.written_sign import read_fsw
from teo_sign_capture.signing_space import direction


@pytest.mark.parametrize(
    ("symbol", "side", "palm", "fingers"),
    [
        ("S15a00", "right", "back", "up"),  # white, upright: one sees the own palm
        ("S15a20", "right", "front", "up"),  # black: the palm faces the addressee
        ("S15a10", "right", "in", "up"),  # half white, on the left: the right palm faces left
        ("S15a18", "left", "in", "up"),  # its mirror
        ("S15a02", "right", "back", "in"),  # turned by 90 deg counterclockwise: before the chest
        ("S15a0a", "left", "back", "in"),
        ("S15a30", "right", "up", "front"),  # white with a gap: palm up
        ("S15a50", "right", "down", "front"),
        ("S15a40", "right", "in", "front"),
        ("S15a52", "right", "down", "in"),
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
