# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From the page to the space before the signer.

Vectors of the page are right and up; those of the space are front, left, up, as base_link has them. Signs
are drawn as the signer sees them. What moves parallel to the wall in front (double lines) is seen from
behind, what moves parallel to the floor (single lines) from above: there, up on the page is to the front.

Palm and fingers follow from fill and rotation of a hand's symbol. ISWA 2010, hands: fills 0 to 2 are seen
from behind, parallel to the wall; 3 to 5 (drawn with a gap) from above, parallel to the floor. White is the
palm (0, 3), black the back (2, 5), half and half the edge (1, 4), with the palm on the white half. Rotations
0 to 7 are a right hand, turned counterclockwise by 45 deg each; from 8 on a left one, mirrored.
"""

from __future__ import annotations

from typing import Literal, NamedTuple

import numpy as np

from teo_common.arrays import Array
from teo_sign_authoring.signwriting.handshapes import BENT_ASIDE
from teo_sign_authoring.signwriting.written_sign import Symbol

Plane = Literal["wall", "floor"]
Side = Literal["right", "left"]
SIDES: tuple[Side, Side] = ("right", "left")

# A head is 36 px wide and high; TEO's, from chin to crown, is 0.18 m.
CM_PER_PIXEL = 0.5

_EIGHTH = np.pi / 4.0


def turned(vector: Array, rotation: int) -> Array:
    """A vector of the page, drawn with rotation 0, as it is with another: 45 deg a step, from 8 on mirrored.

    Args:
        vector: Right and up. Shape (2,).
        rotation: 0 to 15.
    """
    right, up = float(vector[0]), float(vector[1])
    angle = rotation % 8 * _EIGHTH
    cos, sin = np.cos(angle), np.sin(angle)
    if rotation < 8:
        return np.array([right * cos - up * sin, right * sin + up * cos])
    return np.array([-right * cos + up * sin, right * sin + up * cos])


def in_space(vector: Array, plane: Plane) -> Array:
    """A vector of the page (right, up) as front, left, up. Shape (3,)."""
    right, up = float(vector[0]), float(vector[1])
    return np.array([0.0, -right, up]) if plane == "wall" else np.array([up, -right, 0.0])


def for_hand(vector: Array, side: Side) -> Array:
    """A vector of the space as that hand's score writes it: the left hand's is mirrored. Shape (3,)."""
    return vector if side == "right" else np.asarray(vector * np.array([1.0, -1.0, 1.0]))


_WORDS = (("front", "back"), ("in", "out"), ("up", "down"))
# Shares of the largest component: below the first a component is left out, below the second it counts half.
_LEAST_SHARE, _HALF_SHARE = 0.3, 0.7


def direction_words(vector: Array) -> str:
    """A direction of a hand's score in words: "2 up in". Shape (3,)."""
    share = np.abs(vector) / np.abs(vector).max()
    halves = bool(np.any((share >= _LEAST_SHARE) & (share < _HALF_SHARE)))
    words = []
    for index in np.argsort(-share, kind="stable").tolist():
        if share[index] >= _LEAST_SHARE:
            factor = "2 " if halves and share[index] >= _HALF_SHARE else ""
            words.append(factor + _WORDS[index][int(vector[index] < 0.0)])
    return " ".join(words)


def displacement_words(vector: Array) -> str:
    """A displacement in words and whole centimetres: "3 up 2 out"; empty for none.

    Args:
        vector: In the axes of a hand's score [cm]. Shape (3,).
    """
    words = []
    for index, size in enumerate(vector.tolist()):
        if round(abs(size)):
            words.append(f"{round(abs(size))} {_WORDS[index][int(size < 0.0)]}")
    return " ".join(words)


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
