# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a hand's symbol says: its handshape, where palm and fingers point, and the page's axes in space.

TEO's six motors make what they can of the 261 hands of ISWA 2010. The names of the bases say what is up
(the reference of ISWA 2010, by the names of Unicode 8): "fist index" is a fist whose index finger is
straight, "hinge" is bent at the knuckles, "angle" closes on the thumb.

Vectors of the page are right and up; those of the space are front, left, up, as base_link has them. Signs
are drawn as the signer sees them. What moves parallel to the wall in front (double lines) is seen from
behind, what moves parallel to the floor (single lines) from above: there, up on the page is to the front.

Palm and fingers follow from fill and rotation of a hand's symbol. ISWA 2010, hands: fills 0 to 2 are seen
from behind, parallel to the wall; 3 to 5 (drawn with a gap) from above, parallel to the floor. White is
the palm (0, 3), black the back (2, 5), half and half the edge (1, 4), with the palm on the white half.
Rotations 0 to 7 are a right hand, turned counterclockwise by 45 deg each; from 8 on a left one, mirrored.
"""

from __future__ import annotations

from typing import Literal, NamedTuple

import numpy as np

from teo_common.arrays import Array
from teo_sign_authoring.signwriting.written_sign import Symbol

# base: handshape of the project. Bases that are not here have no likeness among them.
_SHAPES: dict[str, tuple[int, ...]] = {
    "index": (*range(0x100, 0x106), 0x109),
    "hook": (0x106, 0x107, 0x108, 0x10A, 0x10B, 0x10C, 0x10D),
    "two": (0x10E, 0x10F, 0x115, 0x116, 0x117, 0x11A, 0x11B, 0x11C, 0x11D),
    "bent_two": (0x110, 0x111, 0x112, 0x113, 0x114, 0x118, 0x119),
    "thumb_two": (
        *(0x11E, 0x11F, 0x120, 0x121, 0x122, 0x123, 0x124, 0x125, 0x126, 0x127, 0x12C, 0x12D, 0x12E, 0x12F),
        *(0x132, 0x133, 0x134),
    ),
    "two_flick": (0x129, 0x13D, 0x13E, 0x13F),
    "four": (0x144, 0x147, 0x148),
    "open": (0x14C, 0x14D, 0x152, 0x161, 0x162, 0x163, 0x164, 0x165),
    "claw": (
        *(0x145, 0x149, 0x14A, 0x14E, 0x14F, 0x150, 0x151, 0x153, 0x154, 0x156),
        *(0x166, 0x167, 0x168, 0x169),
    ),
    "bent": (0x146, 0x14B, 0x155, 0x157, 0x158, 0x159, *range(0x17B, 0x185)),
    "flat": (*range(0x15A, 0x161),),
    "cupped": (0x16C, 0x16D, 0x16E, 0x16F, 0x170, 0x171, 0x172, 0x173),
    "bunched": (0x174, 0x175, 0x176, 0x177, 0x178, 0x179, 0x17A, 0x185),
    "three": (0x186, 0x187, 0x18C),
    "little": (0x192, 0x193, 0x194, 0x195, 0x198),
    "thumb_little": (0x19A, 0x19B),
    "horns": (0x1A0, 0x1A1),
    "middle_flick": (0x1BB, 0x1C1, 0x1C3, 0x1C5),
    "ring_flick": (0x1A5,),
    "ring": (0x1CE, 0x1CF, 0x1D2, 0x1D3, 0x1D4),
    "l": (0x1DC, 0x1DE, 0x1DF, 0x1E0, 0x1E1, 0x1E2, 0x1EC, 0x1ED, 0x1EE, 0x1EF, 0x1F0, 0x1E4, 0x1E5),
    "pinch": (0x1E6, 0x1E7, 0x1E8, 0x1EA, 0x1EB, 0x1F1, 0x1F2, 0x1F3, 0x1F4),
    "thumb": (0x1F5, 0x1F6, 0x1F7, 0x1FA),
    "fist": (0x1F8, 0x1F9, 0x1FB, 0x1FC, 0x1FD, 0x1FE, 0x1FF, 0x200, 0x201, 0x202, 0x203, 0x204),
}

# Bases that TEO makes as another hand, and what it cannot show.
_LOSSES: dict[str, tuple[int, ...]] = {
    "fingers crossed": (0x11A, 0x11B, 0x11C, 0x11D, 0x133),
    "the palm bent back at the heel": (0x14D, 0x14F, 0x151, 0x15C, 0x15E, 0x1F6, 0x204),
    "fingers parted": (0x161, 0x162, 0x163, 0x164, 0x165, 0x148),
    "thumb between the fingers": (0x12C, 0x184, 0x1FB, 0x1FC, 0x1FD),
    "one of two fingers bent": (0x113, 0x114, 0x116, 0x117, 0x124, 0x125, 0x126),
    "a bent thumb": (0x121, 0x122, 0x12F, 0x1E0, 0x1E1, 0x1E2, 0x15F),
    "a thumb before the palm": (0x160, 0x17C, 0x172, 0x173, 0x1FA, 0x127, 0x134, 0x1E4, 0x1E5),
    "thumb and index not quite closed": (0x1E6, 0x1E7, 0x1F1, 0x1EC, 0x1ED),
    "index and thumb at a wide angle": (0x1EE, 0x1EF, 0x1F0),
}

_BY_BASE = {base: shape for shape, bases in _SHAPES.items() for base in bases}
_LOSS_BY_BASE = {base: loss for loss, bases in _LOSSES.items() for base in bases}

# Fingers that are bent at the knuckles are drawn from the side, whichever side of the hand is shown: they
# point to the left of the hand that is drawn upright.
_BENT_ASIDE = frozenset(
    {
        *(*_SHAPES["bent"], *_SHAPES["cupped"]),
        *(0x185, 0x13D, 0x13E, 0x13F, 0x1D2, 0x1D3, 0x1D4, *range(0x1EC, 0x1F5)),
    }
) - {0x157, 0x158, 0x159}

# What a closed hand is opened, and an open one closed, by the dots of finger movement; others stay.
OPENED = {
    "fist": "open",
    "bunched": "open",
    "pinch": "l",
    "ring": "open",
    "middle_flick": "open",
    "ring_flick": "open",
    "two_flick": "thumb_two",
    "thumb": "open",
    "hook": "index",
    "bent_two": "two",
    "claw": "open",
    "bent": "flat",
    "cupped": "open",
    "relaxed": "open",
    "little": "open",
}
CLOSED = {
    "open": "claw",
    "flat": "bunched",
    "four": "bunched",
    "bent": "bunched",
    "claw": "fist",
    "cupped": "bunched",
    "relaxed": "bunched",
    "l": "pinch",
    "thumb_two": "two_flick",
    "two": "bent_two",
    "index": "hook",
    "three": "fist",
}


class Handshape(NamedTuple):
    """A hand of the project, and what it does not show of the written one."""

    name: str
    loss: str = ""


def handshape_of(base: int) -> Handshape | None:
    """The project's handshape for a hand symbol; None if it has none like it."""
    name = _BY_BASE.get(base)
    return None if name is None else Handshape(name, _LOSS_BY_BASE.get(base, ""))


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
    """How a hand is held; `side` is which hand it is, also where it is drawn as the other one."""
    plane = plane_of(symbol)
    upright = in_space(turned(_PAGE_UP, symbol.rotation), plane)
    to_palm_side = in_space(turned(_PAGE_LEFT, symbol.rotation), plane)
    towards_reader = np.array([-1.0, 0.0, 0.0]) if plane == "wall" else np.array([0.0, 0.0, 1.0])
    fingers = upright
    if symbol.fill in EDGE_SHOWN:
        palm = to_palm_side
    else:
        palm = towards_reader if symbol.fill in _PALM_SHOWN else -towards_reader
        if symbol.base in _BENT_ASIDE:
            # Bent fingers are drawn aside: the hand is held between its back, as drawn, and where they point.
            fingers = (upright + to_palm_side) / np.sqrt(2.0)
    return Orientation(for_hand(palm, side), for_hand(fingers, side))


def drawn_tip(symbol: Symbol) -> Array:
    """Where on the page the fingertips are, right and down [px]. Shape (2,)."""
    way = turned(_PAGE_LEFT if symbol.base in _BENT_ASIDE else _PAGE_UP, symbol.rotation)
    reach = float(np.abs(way) @ symbol.size) / 2.0 / max(float(np.abs(way).max()), 1e-9)
    reach = min(reach, float(symbol.size.max()) / 2.0)
    return np.asarray(symbol.middle + reach * way * np.array([1.0, -1.0]))
