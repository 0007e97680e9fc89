# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Handshapes of ISWA 2010 as the project's: what TEO's six motors make of 261 hands.

The names of the bases say what is up (the reference of ISWA 2010, by the names of Unicode 8): "fist index" is
a fist whose index finger is straight, "hinge" is bent at the knuckles, "angle" closes on the thumb.
"""

from __future__ import annotations

from typing import NamedTuple

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
        0x145,
        0x149,
        0x14A,
        0x14E,
        0x14F,
        0x150,
        0x151,
        0x153,
        0x154,
        0x156,
        0x166,
        0x167,
        0x168,
        0x169,
    ),
    "bent": (
        *(
            0x146,
            0x14B,
            0x155,
            0x157,
            0x158,
            0x159,
            0x17B,
            0x17C,
            0x17D,
            0x17E,
            0x17F,
            0x180,
            0x181,
            0x182,
            0x183,
        ),
        0x184,
    ),
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
BENT_ASIDE = frozenset(
    {
        *_SHAPES["bent"],
        0x185,
        *_SHAPES["cupped"],
        *range(0x1EC, 0x1F5),
        0x13D,
        0x13E,
        0x13F,
        0x1D2,
        0x1D3,
        0x1D4,
    }
) - {0x157, 0x158, 0x159}

# Closed hands, and what each is opened: by the dots of finger movement.
_OPENED = {
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
_CLOSED = {
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


def opened(shape: str) -> str | None:
    """The hand that a closed one opens to; None if it is open."""
    return _OPENED.get(shape)


def closed(shape: str) -> str | None:
    """The hand that an open one closes to; None if it is closed."""
    return _CLOSED.get(shape)
