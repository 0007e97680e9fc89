# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How a hand is held: palm and fingers from fill and rotation of its symbol.

ISWA 2010, hands: fills 0 to 2 are seen from behind, parallel to the wall; 3 to 5 (drawn with a gap) from
above, parallel to the floor. White is the palm (0, 3), black the back (2, 5), half and half the edge (1,
4), with the palm on the white half. Rotations 0 to 7 are a right hand, turned counterclockwise by 45 deg
each; from 8 on a left one, mirrored.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from teo_common.arrays import Array
from teo_sign_authoring.signwriting.handshapes import BENT_ASIDE
from teo_sign_authoring.signwriting.page import Plane, Side, for_hand, in_space, turned
from teo_sign_authoring.signwriting.written_sign import Symbol

_PAGE_UP, _PAGE_LEFT = np.array([0.0, 1.0]), np.array([-1.0, 0.0])
# Fills that show the palm, and the edge of the hand.
_PALM_SHOWN, EDGE_SHOWN = (0, 3), (1, 4)


class Orientation(NamedTuple):
    """Ways of a hand in the axes of its score, unit vectors: front, in, up.

    Attributes:
        palm: The way the palm faces. Shape (3,).
        fingers: From wrist to knuckles. Shape (3,).
    """

    palm: Array
    fingers: Array

    @property
    def thumb_side(self) -> Array:
        """From the little finger to the index. Shape (3,)."""
        return np.cross(self.fingers, self.palm)


def written_side(symbol: Symbol) -> Side:
    """The hand that a hand symbol is drawn as."""
    return "right" if symbol.rotation < 8 else "left"


def plane_of(symbol: Symbol) -> Plane:
    """The plane that a hand symbol lies in."""
    return "wall" if symbol.fill < 3 else "floor"


def orientation_of(symbol: Symbol, side: Side) -> Orientation:
    """How a hand is held.

    Args:
        symbol: The hand.
        side: Which hand it is, also where it is drawn as the other one.
    """
    plane = plane_of(symbol)
    upright = in_space(turned(_PAGE_UP, symbol.rotation), plane)
    to_palm_side = in_space(turned(_PAGE_LEFT, symbol.rotation), plane)
    towards_reader = np.array([-1.0, 0.0, 0.0]) if plane == "wall" else np.array([0.0, 0.0, 1.0])
    fingers = upright
    if symbol.fill in EDGE_SHOWN:
        palm = to_palm_side
    else:
        palm = towards_reader if symbol.fill in _PALM_SHOWN else -towards_reader
        if symbol.base in BENT_ASIDE:
            # Bent fingers are drawn aside: the hand is held between its back, as drawn, and where they point.
            fingers = (upright + to_palm_side) / np.sqrt(2.0)
    return Orientation(for_hand(palm, side), for_hand(fingers, side))


def drawn_tip(symbol: Symbol) -> Array:
    """Where on the page the fingertips are, right and down [px]. Shape (2,)."""
    way = turned(_PAGE_LEFT if symbol.base in BENT_ASIDE else _PAGE_UP, symbol.rotation)
    reach = float(np.abs(way) @ symbol.size) / 2.0 / max(float(np.abs(way).max()), 1e-9)
    reach = min(reach, float(symbol.size.max()) / 2.0)
    return np.asarray(symbol.middle + reach * way * np.array([1.0, -1.0]))
