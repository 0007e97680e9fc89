# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Scripts of key poses that a person can be asked to play, and the signs that they are made of.

Names of signs are of what they resemble; no language is meant.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from teo_synthetic_signer.errors import unknown_name
from teo_synthetic_signer.script.keys import ArmKey, Key, Vector

HANGING = ArmKey(
    at="side",
    offset=(0.03, 0.035, 0.02),
    point="wrist",
    fingers=(0.15, 0.0, -1.0),
    palm=(-0.35, -1.0, 0.0),
    shape="relaxed",
)
# Both arms hang.
REST = Key(right=HANGING, left=HANGING, move=0.7, hold=0.3)
_SPEAK = {"jawOpen": 0.25}
_ROUND = {"mouthPucker": 0.7}
_SMILE = {"mouthSmileLeft": 0.6, "mouthSmileRight": 0.6}
_ASK = {"browInnerUp": 0.9, "browOuterUpLeft": 0.8, "browOuterUpRight": 0.8}

# Directions: forwards, outwards, up.
_UP: Vector = (0.15, -0.1, 1.0)
_IN_UP: Vector = (0.35, -0.7, 0.6)
_AHEAD: Vector = (1.0, -0.25, 0.25)
_TO_VIEWER: Vector = (1.0, 0.0, 0.0)
_TO_SELF: Vector = (-1.0, -0.1, 0.0)
_INWARDS: Vector = (0.1, -1.0, 0.0)
_DOWN: Vector = (0.0, 0.0, -1.0)
_UPWARDS: Vector = (0.0, 0.0, 1.0)


def neutral(
    shape: str, fingers: Vector = _UP, palm: Vector = _TO_VIEWER, at: Vector = (0.30, 0.06, -0.12)
) -> ArmKey:
    """Put the hand before the shoulder, where most signs are made."""
    return ArmKey(
        at="shoulders", offset=(at[0], at[1] + 0.10, at[2]), fingers=fingers, palm=palm, shape=shape
    )


def _beaten(key: Key, times: int, by: Vector, move: float = 0.16) -> list[Key]:
    """Repeat a key pose with a short movement of the hands there and back."""

    def shifted(arm: ArmKey | None) -> ArmKey | None:
        if arm is None or arm.at.startswith("other"):
            return arm
        a, b, c = arm.offset
        return replace(arm, offset=(a + by[0], b + by[1], c + by[2]))

    away = replace(key, right=shifted(key.right), left=shifted(key.left), move=move, hold=0.0)
    back = replace(key, move=move, hold=0.05)
    return [key, *[away, back] * times]


def spelled(shapes: Sequence[str]) -> list[Key]:
    """Spell: the hand stays before the shoulder and changes its shape."""
    return [
        Key(
            left=HANGING if i == 0 else None,
            right=neutral(shape, at=(0.30, 0.06 + 0.008 * i, 0.0)),
            move=0.5 if i == 0 else 0.2,
            hold=0.22,
            face=_SPEAK if i % 2 else {},
        )
        for i, shape in enumerate(shapes)
    ]


HELLO = _beaten(
    Key(
        right=ArmKey(at="temple", offset=(0.10, 0.10, -0.06), fingers=_UP, palm=_TO_VIEWER, shape="open"),
        face=_SMILE,
    ),
    1,
    (0.0, 0.07, 0.0),
)
# A greeting with the hand well before the shoulder, where a robot with long upper arms can hold it as well.
WAVE = _beaten(Key(right=neutral("open", at=(0.38, 0.05, 0.08)), face=_SMILE), 2, (0.0, 0.09, 0.0), move=0.22)
THINK = [
    Key(
        right=ArmKey(
            at="forehead",
            offset=(0.02, 0.06, 0.0),
            point="index_tip",
            fingers=(-0.5, -0.35, 0.8),
            palm=(-0.7, -0.6, -0.4),
            shape="index",
        ),
        face=_ASK,
    ),
    Key(
        right=ArmKey(
            at="forehead",
            offset=(0.12, 0.12, -0.05),
            point="index_tip",
            fingers=(0.1, 0.0, 1.0),
            palm=(0.3, -1.0, 0.0),
            shape="index",
        ),
        move=0.25,
    ),
]
EAT = _beaten(
    Key(
        right=ArmKey(
            at="mouth",
            offset=(0.035, 0.0, 0.0),
            point="middle_tip",
            fingers=(0.35, -0.45, 0.8),
            palm=(-1.0, -0.2, 0.4),
            shape="bent",
        ),
        face=_SPEAK,
    ),
    2,
    (0.06, 0.02, -0.04),
)
THANKS = [
    Key(
        right=ArmKey(
            at="chin",
            offset=(0.02, 0.0, 0.0),
            point="middle_tip",
            fingers=(-0.35, -0.35, 0.9),
            palm=(-1.0, 0.0, -0.3),
            shape="flat",
        ),
        face=_SMILE,
    ),
    Key(
        right=ArmKey(
            at="chin",
            offset=(0.30, 0.04, -0.14),
            point="middle_tip",
            fingers=(0.8, -0.2, 0.5),
            palm=(-0.5, 0.0, 1.0),
            shape="flat",
        ),
        move=0.4,
    ),
]
_BOOK_CLOSED = ArmKey(
    at="sternum", offset=(0.22, 0.035, -0.06), fingers=_AHEAD, palm=(0.0, -1.0, 0.0), shape="flat"
)
_BOOK_OPEN = ArmKey(
    at="sternum", offset=(0.22, 0.11, -0.06), fingers=(1.0, -0.1, 0.3), palm=(-0.2, -0.25, 1.0), shape="flat"
)
BOOK = [
    Key(right=_BOOK_CLOSED, left=_BOOK_CLOSED),
    Key(right=_BOOK_OPEN, left=_BOOK_OPEN, move=0.4, arc=0.0),
]
HOUSE = [
    Key(
        right=ArmKey(
            at="sternum",
            offset=(0.26, 0.02, 0.12),
            point="middle_tip",
            fingers=(0.3, -0.7, 0.75),
            palm=(0.2, -0.7, -0.7),
            shape="flat",
        ),
        left=ArmKey(
            at="sternum",
            offset=(0.26, 0.02, 0.12),
            point="middle_tip",
            fingers=(0.3, -0.7, 0.75),
            palm=(0.2, -0.7, -0.7),
            shape="flat",
        ),
        face=_ROUND,
    ),
    Key(
        right=ArmKey(at="sternum", offset=(0.26, 0.13, -0.08), fingers=_UP, palm=_INWARDS, shape="flat"),
        left=ArmKey(at="sternum", offset=(0.26, 0.13, -0.08), fingers=_UP, palm=_INWARDS, shape="flat"),
        move=0.4,
    ),
]
_PALM_UP = ArmKey(
    at="sternum", offset=(0.22, 0.02, -0.12), fingers=(0.8, -0.6, 0.1), palm=_UPWARDS, shape="flat"
)
STAMP = [
    Key(
        left=_PALM_UP,
        right=ArmKey(at="other_palm", offset=(0.0, 0.0, 0.16), fingers=_AHEAD, palm=_INWARDS, shape="fist"),
    ),
    Key(
        left=_PALM_UP,
        right=ArmKey(at="other_palm", offset=(0.0, 0.0, 0.055), fingers=_AHEAD, palm=_INWARDS, shape="fist"),
        move=0.2,
    ),
    Key(
        left=_PALM_UP,
        right=ArmKey(
            at="other_palm",
            offset=(0.0, 0.0, 0.02),
            point="index_tip",
            fingers=(0.75, -0.45, -0.45),
            palm=(-0.1, -0.9, -0.35),
            shape="index",
        ),
        move=0.35,
    ),
]
_CROSSED = ArmKey(
    at="sternum",
    offset=(0.14, -0.12, 0.06),
    point="wrist",
    fingers=(0.1, -0.45, 0.9),
    palm=(-1.0, 0.2, 0.2),
    shape="fist",
)
LOVE = [
    Key(right=_CROSSED, left=replace(_CROSSED, offset=(0.085, -0.11, 0.02)), move=0.55, hold=0.4, face=_SMILE)
]
_FOREARMS = ArmKey(
    at="sternum",
    offset=(0.24, -0.06, -0.02),
    point="wrist",
    fingers=(0.2, -1.0, 0.15),
    palm=(0.0, 0.0, -1.0),
    shape="flat",
)
STACKED = [
    Key(
        right=replace(_FOREARMS, offset=(0.22, -0.05, 0.04)),
        left=replace(_FOREARMS, offset=(0.20, -0.05, -0.05)),
        move=0.5,
        hold=0.3,
    ),
]
BEHIND = [
    Key(
        left=ArmKey(
            at="sternum",
            offset=(0.26, -0.06, 0.0),
            point="wrist",
            fingers=(0.15, -1.0, 0.35),
            palm=(-0.2, 0.0, -1.0),
            shape="flat",
        ),
        right=ArmKey(at="sternum", offset=(0.13, 0.0, -0.05), fingers=_IN_UP, palm=_TO_SELF, shape="v"),
        move=0.5,
        hold=0.5,
    ),
]
# The forearm passes before the face, the elbow before a shoulder.
ACROSS_FACE = [
    Key(
        right=ArmKey(
            at="nose", offset=(0.16, -0.06, 0.03), point="wrist", fingers=(0.1, -1.0, 0.25), palm=_TO_SELF
        ),
        left=HANGING,
        move=0.5,
        hold=0.4,
    ),
    Key(
        right=ArmKey(
            at="forehead", offset=(0.10, -0.04, 0.0), point="wrist", fingers=(0.0, -1.0, 0.3), palm=_TO_SELF
        ),
        move=0.35,
        hold=0.2,
    ),
]
# A hand stays far before the other shoulder, the other before the face, at half an arm's length.
FAR_BEFORE = [
    Key(
        right=ArmKey(
            at="other_shoulder",
            offset=(0.26, 0.0, 0.0),
            fingers=(0.2, -0.3, 1.0),
            palm=_TO_VIEWER,
            shape="flat",
        ),
        left=HANGING,
        move=0.5,
        hold=0.3,
    ),
    Key(
        right=HANGING,
        left=ArmKey(
            at="eye", offset=(0.28, -0.05, 0.0), fingers=(0.2, -0.3, 1.0), palm=_TO_VIEWER, shape="open"
        ),
        move=0.5,
        hold=0.3,
    ),
    Key(
        right=ArmKey(
            at="eye", offset=(0.22, -0.03, 0.0), fingers=(0.2, -0.3, 1.0), palm=_TO_VIEWER, shape="fist"
        ),
        left=ArmKey(
            at="shoulder", offset=(0.25, 0.0, 0.0), fingers=(0.2, -0.3, 1.0), palm=_TO_SELF, shape="flat"
        ),
        move=0.5,
        hold=0.3,
    ),
]
COVER = [
    Key(
        right=ArmKey(
            at="nose", offset=(0.10, 0.05, 0.02), fingers=(0.1, -0.25, 1.0), palm=_TO_SELF, shape="open"
        ),
        left=ArmKey(
            at="nose", offset=(0.10, 0.05, 0.02), fingers=(0.1, -0.25, 1.0), palm=_TO_SELF, shape="open"
        ),
        move=0.5,
        hold=0.4,
    ),
    Key(
        right=ArmKey(at="nose", offset=(0.14, 0.16, 0.0), fingers=_UP, palm=(-0.2, -1.0, 0.0), shape="open"),
        left=ArmKey(at="nose", offset=(0.14, 0.16, 0.0), fingers=_UP, palm=(-0.2, -1.0, 0.0), shape="open"),
        move=0.35,
        hold=0.2,
        face=_SMILE,
    ),
    Key(
        right=ArmKey(
            at="mouth", offset=(0.06, 0.02, 0.0), fingers=(0.1, -1.0, 0.3), palm=_TO_SELF, shape="flat"
        ),
        left=HANGING,
        move=0.5,
        hold=0.3,
    ),
    Key(
        right=ArmKey(
            at="forehead", offset=(0.06, 0.03, 0.0), fingers=(0.1, -1.0, 0.25), palm=_TO_SELF, shape="v"
        ),
        move=0.4,
        hold=0.2,
    ),
]
SWING_OUT = neutral("flat", fingers=(0.6, 0.8, 0.1), palm=(0.6, -0.5, 0.0), at=(0.22, 0.36, 0.02))
SWING_IN = neutral("flat", fingers=(0.7, -0.7, 0.2), palm=(-0.5, -0.6, 0.0), at=(0.26, -0.24, 0.02))
HIGH = neutral("index", fingers=(0.3, 0.1, 1.0), palm=_TO_VIEWER, at=(0.26, 0.16, 0.30))
LOW = neutral("index", fingers=(1.0, 0.0, -0.4), palm=_DOWN, at=(0.34, 0.02, -0.30))


def _fast() -> list[Key]:
    keys = [Key(right=SWING_OUT, move=0.5)]
    keys += [Key(right=key, move=0.28, hold=0.04, arc=0.05) for key in (SWING_IN, SWING_OUT) * 3]
    keys += [Key(right=key, left=key, move=0.30, hold=0.04, arc=0.05) for key in (HIGH, LOW) * 3]
    return keys


def _moved(keys: Sequence[Key], **changes: object) -> list[Key]:
    return [replace(key, **changes) for key in keys]  # type: ignore[arg-type]  # names of Key's fields


_ASIDE = (0.0, 0.30)
_TURN = math.radians(30.0)

SCRIPTS: dict[str, tuple[Key, ...]] = {
    "signing": (REST, *HELLO, *BOOK, *THANKS, *STAMP, *spelled(("l", "o", "v")), REST),
    "greeting": (REST, *WAVE, REST),
    "hello": (REST, *HELLO, *THANKS, REST),
    "face": (REST, *THINK, *COVER, *EAT, REST),
    "before_face": (REST, *ACROSS_FACE, *FAR_BEFORE, REST),
    "crossing": (REST, *LOVE, *STACKED, *BEHIND, *BOOK, REST),
    "two_hands": (REST, *HOUSE, *STAMP, *BOOK, REST),
    "fast": (REST, *_fast(), REST),
    "spelling": (
        REST,
        *spelled(
            (
                "fist",
                "b",
                "c",
                "index",
                "f",
                "l",
                "o",
                "u",
                "v",
                "w",
                "y",
                "hook",
                "little",
                "claw",
                "bent",
                "horns",
                "thumb_up",
                "open",
            )
        ),
        REST,
    ),
    "side_step": (
        REST,
        *HELLO[:1],
        replace(HELLO[0], place=(0.0, 0.15), step="L", move=0.5),
        replace(HELLO[0], place=_ASIDE, step="R", move=0.5),
        *_moved(THANKS, place=_ASIDE),
        replace(REST, place=_ASIDE),
    ),
    "turning": (
        REST,
        *_moved(BOOK, heading=_TURN, head=(-0.3, 0.0, 0.0)),
        *_moved(THANKS, heading=_TURN, head=(-0.3, 0.0, 0.0)),
        *_moved(HOUSE, heading=-_TURN, head=(0.3, 0.0, 0.0)),
        REST,
    ),
    "still": (REST, replace(REST, hold=2.0)),
}
_ABOUT = {
    "signing": "a greeting, two-handed signs, one hand on the other, and spelling",
    "greeting": "one sign: a hand that waves before the shoulder",
    "hello": "a greeting and thanks, one hand",
    "face": "hands at and before the face",
    "before_face": "forearms across the face, hands far before the face and the shoulders",
    "crossing": "arms crossed, forearms stacked, a hand behind the other arm",
    "two_hands": "two-handed signs and one hand on the other",
    "fast": "wrists faster than 2 m/s",
    "spelling": "eighteen hand shapes, one after the other",
    "side_step": "a greeting while stepping aside by 0.3 m",
    "turning": "two-handed signs while turned by 30 deg to either side",
    "still": "standing with both arms down",
}


def add_script(name: str, keys: Sequence[Key], what: str) -> None:
    """Make a script known by a name, in place of one that has it.

    Args:
        name: By which it can be asked for from now on.
        keys: What is done; the first says where both arms are.
        what: Happens in it, in a few words.
    """
    SCRIPTS[name], _ABOUT[name] = tuple(keys), what


def script(name: str) -> tuple[Key, ...]:
    """Give a script by name.

    Raises:
        SyntheticError: None has that name.
    """
    if name not in SCRIPTS:
        raise unknown_name("script", name, SCRIPTS)
    return SCRIPTS[name]


def about(name: str) -> str:
    """Say what happens in a script."""
    return _ABOUT[name]
