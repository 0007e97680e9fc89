"""What a person can be asked to do: scripts of key poses, like signing."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from teo_skeleton_retriever.synthetic.errors import unknown_name
from teo_skeleton_retriever.synthetic.keys import ArmKey, Key, Vector

_HANGING = ArmKey(
    at="side",
    offset=(0.03, 0.035, 0.02),
    point="wrist",
    fingers=(0.15, 0.0, -1.0),
    palm=(-0.35, -1.0, 0.0),
    shape="relaxed",
)
REST = Key(right=_HANGING, left=_HANGING, move=0.7, hold=0.5)
"""Both arms hang."""
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


def _neutral(
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


def _spelled(shapes: Sequence[str]) -> list[Key]:
    """Spell: the hand stays before the shoulder and changes its shape."""
    return [
        Key(
            right=_neutral(shape, at=(0.30, 0.06 + 0.008 * i, 0.0)),
            move=0.5 if i == 0 else 0.2,
            hold=0.22,
            face=_SPEAK if i % 2 else {},
        )
        for i, shape in enumerate(shapes)
    ]


_HELLO = _beaten(
    Key(
        right=ArmKey(at="temple", offset=(0.10, 0.10, -0.06), fingers=_UP, palm=_TO_VIEWER, shape="open"),
        face=_SMILE,
    ),
    2,
    (0.0, 0.07, 0.0),
)
_THINK = [
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
_EAT = _beaten(
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
_THANKS = [
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
_BOOK = [
    Key(right=_BOOK_CLOSED, left=_BOOK_CLOSED),
    Key(right=_BOOK_OPEN, left=_BOOK_OPEN, move=0.4, arc=0.0),
]
_HOUSE = [
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
_STAMP = [
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
_LOVE = [
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
_STACKED = [
    Key(
        right=replace(_FOREARMS, offset=(0.22, -0.05, 0.04)),
        left=replace(_FOREARMS, offset=(0.20, -0.05, -0.05)),
        move=0.5,
        hold=0.3,
    ),
]
_BEHIND = [
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
_COVER = [
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
        left=_HANGING,
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
_SWING_OUT = _neutral("flat", fingers=(0.6, 0.8, 0.1), palm=(0.6, -0.5, 0.0), at=(0.22, 0.36, 0.02))
_SWING_IN = _neutral("flat", fingers=(0.7, -0.7, 0.2), palm=(-0.5, -0.6, 0.0), at=(0.26, -0.24, 0.02))
_HIGH = _neutral("index", fingers=(0.3, 0.1, 1.0), palm=_TO_VIEWER, at=(0.26, 0.16, 0.30))
_LOW = _neutral("index", fingers=(1.0, 0.0, -0.4), palm=_DOWN, at=(0.34, 0.02, -0.30))


def _fast() -> list[Key]:
    keys = [Key(right=_SWING_OUT, move=0.5)]
    keys += [Key(right=key, move=0.28, hold=0.04, arc=0.05) for key in (_SWING_IN, _SWING_OUT) * 3]
    keys += [Key(right=key, left=key, move=0.30, hold=0.04, arc=0.05) for key in (_HIGH, _LOW) * 3]
    return keys


def _moved(keys: Sequence[Key], **changes: object) -> list[Key]:
    return [replace(key, **changes) for key in keys]  # type: ignore[arg-type]  # names of Key's fields


_ASIDE = (0.0, 0.30)
_TURN = math.radians(30.0)

SCRIPTS: dict[str, tuple[Key, ...]] = {
    "signing": (REST, *_HELLO, *_BOOK, *_THANKS, *_STAMP, *_spelled(("l", "o", "v")), REST),
    "hello": (REST, *_HELLO, *_THANKS, REST),
    "face": (REST, *_THINK, *_COVER, *_EAT, REST),
    "crossing": (REST, *_LOVE, *_STACKED, *_BEHIND, *_BOOK, REST),
    "two_hands": (REST, *_HOUSE, *_STAMP, *_BOOK, REST),
    "fast": (REST, *_fast(), REST),
    "spelling": (
        REST,
        *_spelled(
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
        *_HELLO[:1],
        replace(_HELLO[0], place=(0.0, 0.15), step="L", move=0.5),
        replace(_HELLO[0], place=_ASIDE, step="R", move=0.5),
        *_moved(_THANKS, place=_ASIDE),
        replace(REST, place=_ASIDE),
    ),
    "turning": (
        REST,
        *_moved(_BOOK, heading=_TURN, head=(-0.3, 0.0, 0.0)),
        *_moved(_THANKS, heading=_TURN, head=(-0.3, 0.0, 0.0)),
        *_moved(_HOUSE, heading=-_TURN, head=(0.3, 0.0, 0.0)),
        REST,
    ),
    "still": (REST, replace(REST, hold=2.0)),
}
_ABOUT = {
    "signing": "a greeting, two-handed signs, one hand on the other, and spelling",
    "hello": "a greeting and thanks, one hand",
    "face": "hands at and before the face",
    "crossing": "arms crossed, forearms stacked, a hand behind the other arm",
    "two_hands": "two-handed signs and one hand on the other",
    "fast": "wrists faster than 2 m/s",
    "spelling": "eighteen hand shapes, one after the other",
    "side_step": "a greeting while stepping aside by 0.3 m",
    "turning": "two-handed signs while turned by 30 deg to either side",
    "still": "standing with both arms down",
}


def script(name: str) -> tuple[Key, ...]:
    """Give a script by name.

    Raises:
        SyntheticError: none has that name.
    """
    if name not in SCRIPTS:
        raise unknown_name("script", name, SCRIPTS)
    return SCRIPTS[name]


def about(name: str) -> str:
    """Say what happens in a script."""
    return _ABOUT[name]
