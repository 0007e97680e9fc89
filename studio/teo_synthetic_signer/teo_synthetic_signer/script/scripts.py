# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Scripts of key poses that a person can be asked to play, and the signs that they are made of.

Names of signs are of what they resemble; no language is meant.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from teo_synthetic_signer.errors import named
from teo_synthetic_signer.script.keys import ArmKey, Key, Vector


def _arm(
    at: str, offset: Vector, fingers: Vector, palm: Vector, shape: str = "flat", point: str = "palm"
) -> ArmKey:
    """Give where an arm goes: a row of a table with the columns of `ArmKey`."""
    return ArmKey(at=at, offset=offset, fingers=fingers, palm=palm, shape=shape, point=point)


HANGING = _arm("side", (0.03, 0.035, 0.02), (0.15, 0.0, -1.0), (-0.35, -1.0, 0.0), "relaxed", "wrist")
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
            left=HANGING if i == 0 else None,
            right=_neutral(shape, at=(0.30, 0.06 + 0.008 * i, 0.0)),
            move=0.5 if i == 0 else 0.2,
            hold=0.22,
            face=_SPEAK if i % 2 else {},
        )
        for i, shape in enumerate(shapes)
    ]


_HELLO = _beaten(
    Key(right=_arm("temple", (0.10, 0.10, -0.06), _UP, _TO_VIEWER, "open"), face=_SMILE), 1, (0.0, 0.07, 0.0)
)
# A greeting with the hand well before the shoulder, where a robot with long upper arms can hold it as well.
_WAVE = _beaten(
    Key(right=_neutral("open", at=(0.38, 0.05, 0.08)), face=_SMILE), 2, (0.0, 0.09, 0.0), move=0.22
)
_THINK = [
    Key(
        right=_arm(
            "forehead", (0.02, 0.06, 0.0), (-0.5, -0.35, 0.8), (-0.7, -0.6, -0.4), "index", "index_tip"
        ),
        face=_ASK,
    ),
    Key(
        right=_arm("forehead", (0.12, 0.12, -0.05), (0.1, 0.0, 1.0), (0.3, -1.0, 0.0), "index", "index_tip"),
        move=0.25,
    ),
]
_EAT = _beaten(
    Key(
        right=_arm("mouth", (0.035, 0.0, 0.0), (0.35, -0.45, 0.8), (-1.0, -0.2, 0.4), "bent", "middle_tip"),
        face=_SPEAK,
    ),
    2,
    (0.06, 0.02, -0.04),
)
_THANKS = [
    Key(
        right=_arm("chin", (0.02, 0.0, 0.0), (-0.35, -0.35, 0.9), (-1.0, 0.0, -0.3), "flat", "middle_tip"),
        face=_SMILE,
    ),
    Key(
        right=_arm("chin", (0.30, 0.04, -0.14), (0.8, -0.2, 0.5), (-0.5, 0.0, 1.0), "flat", "middle_tip"),
        move=0.4,
    ),
]
_BOOK_CLOSED = _arm("sternum", (0.22, 0.035, -0.06), _AHEAD, (0.0, -1.0, 0.0), "flat")
_BOOK_OPEN = _arm("sternum", (0.22, 0.11, -0.06), (1.0, -0.1, 0.3), (-0.2, -0.25, 1.0), "flat")
_BOOK = [
    Key(right=_BOOK_CLOSED, left=_BOOK_CLOSED),
    Key(right=_BOOK_OPEN, left=_BOOK_OPEN, move=0.4, arc=0.0),
]
_ROOF = _arm("sternum", (0.26, 0.02, 0.12), (0.3, -0.7, 0.75), (0.2, -0.7, -0.7), "flat", "middle_tip")
_WALL = _arm("sternum", (0.26, 0.13, -0.08), _UP, _INWARDS, "flat")
_HOUSE = [Key(right=_ROOF, left=_ROOF, face=_ROUND), Key(right=_WALL, left=_WALL, move=0.4)]
_PALM_UP = _arm("sternum", (0.22, 0.02, -0.12), (0.8, -0.6, 0.1), _UPWARDS, "flat")
_STAMP = [
    Key(left=_PALM_UP, right=_arm("other_palm", (0.0, 0.0, 0.16), _AHEAD, _INWARDS, "fist")),
    Key(left=_PALM_UP, right=_arm("other_palm", (0.0, 0.0, 0.055), _AHEAD, _INWARDS, "fist"), move=0.2),
    Key(
        left=_PALM_UP,
        right=_arm(
            "other_palm", (0.0, 0.0, 0.02), (0.75, -0.45, -0.45), (-0.1, -0.9, -0.35), "index", "index_tip"
        ),
        move=0.35,
    ),
]
_CROSSED = _arm("sternum", (0.14, -0.12, 0.06), (0.1, -0.45, 0.9), (-1.0, 0.2, 0.2), "fist", "wrist")
_LOVE = [
    Key(right=_CROSSED, left=replace(_CROSSED, offset=(0.085, -0.11, 0.02)), move=0.55, hold=0.4, face=_SMILE)
]
_FOREARMS = _arm("sternum", (0.24, -0.06, -0.02), (0.2, -1.0, 0.15), (0.0, 0.0, -1.0), "flat", "wrist")
_STACKED = [
    Key(
        right=replace(_FOREARMS, offset=(0.22, -0.05, 0.04)),
        left=replace(_FOREARMS, offset=(0.20, -0.05, -0.05)),
        move=0.5,
        hold=0.3,
    )
]
_BEHIND = [
    Key(
        left=_arm("sternum", (0.26, -0.06, 0.0), (0.15, -1.0, 0.35), (-0.2, 0.0, -1.0), "flat", "wrist"),
        right=_arm("sternum", (0.13, 0.0, -0.05), _IN_UP, _TO_SELF, "v"),
        move=0.5,
        hold=0.5,
    )
]
# The forearm passes before the face, the elbow before a shoulder.
_ACROSS_FACE = [
    Key(
        right=_arm("nose", (0.16, -0.06, 0.03), (0.1, -1.0, 0.25), _TO_SELF, "flat", "wrist"),
        left=HANGING,
        move=0.5,
        hold=0.4,
    ),
    Key(
        right=_arm("forehead", (0.10, -0.04, 0.0), (0.0, -1.0, 0.3), _TO_SELF, "flat", "wrist"),
        move=0.35,
        hold=0.2,
    ),
]
# A hand stays far before the other shoulder, the other before the face, at half an arm's length.
_FAR_BEFORE = [
    Key(
        right=_arm("other_shoulder", (0.26, 0.0, 0.0), (0.2, -0.3, 1.0), _TO_VIEWER, "flat"),
        left=HANGING,
        move=0.5,
        hold=0.3,
    ),
    Key(
        right=HANGING,
        left=_arm("eye", (0.28, -0.05, 0.0), (0.2, -0.3, 1.0), _TO_VIEWER, "open"),
        move=0.5,
        hold=0.3,
    ),
    Key(
        right=_arm("eye", (0.22, -0.03, 0.0), (0.2, -0.3, 1.0), _TO_VIEWER, "fist"),
        left=_arm("shoulder", (0.25, 0.0, 0.0), (0.2, -0.3, 1.0), _TO_SELF, "flat"),
        move=0.5,
        hold=0.3,
    ),
]
_COVERING = _arm("nose", (0.10, 0.05, 0.02), (0.1, -0.25, 1.0), _TO_SELF, "open")
_OPENED = _arm("nose", (0.14, 0.16, 0.0), _UP, (-0.2, -1.0, 0.0), "open")
_COVER = [
    Key(right=_COVERING, left=_COVERING, move=0.5, hold=0.4),
    Key(right=_OPENED, left=_OPENED, move=0.35, hold=0.2, face=_SMILE),
    Key(
        right=_arm("mouth", (0.06, 0.02, 0.0), (0.1, -1.0, 0.3), _TO_SELF, "flat"),
        left=HANGING,
        move=0.5,
        hold=0.3,
    ),
    Key(right=_arm("forehead", (0.06, 0.03, 0.0), (0.1, -1.0, 0.25), _TO_SELF, "v"), move=0.4, hold=0.2),
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

_SHAPES = (
    *("fist", "b", "c", "index", "f", "l", "o", "u", "v"),
    *("w", "y", "hook", "little", "claw", "bent", "horns", "thumb_up", "open"),
)

SCRIPTS: dict[str, tuple[Key, ...]] = {
    "signing": (REST, *_HELLO, *_BOOK, *_THANKS, *_STAMP, *_spelled(("l", "o", "v")), REST),
    "greeting": (REST, *_WAVE, REST),
    "hello": (REST, *_HELLO, *_THANKS, REST),
    "face": (REST, *_THINK, *_COVER, *_EAT, REST),
    "before_face": (REST, *_ACROSS_FACE, *_FAR_BEFORE, REST),
    "crossing": (REST, *_LOVE, *_STACKED, *_BEHIND, *_BOOK, REST),
    "two_hands": (REST, *_HOUSE, *_STAMP, *_BOOK, REST),
    "fast": (REST, *_fast(), REST),
    "spelling": (
        REST,
        *_spelled(_SHAPES),
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


def script(name: str) -> tuple[Key, ...]:
    """Give a script by name.

    Raises:
        SyntheticError: None has that name.
    """
    return named("script", name, SCRIPTS)


def about(name: str) -> str:
    """Say what happens in a script."""
    return _ABOUT[name]
