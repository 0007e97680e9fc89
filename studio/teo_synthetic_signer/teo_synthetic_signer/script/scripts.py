# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a person can be asked to do: scripts of key poses, like signing."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from teo_synthetic_signer.errors import unknown_name
from teo_synthetic_signer.script.keys import Key
from teo_synthetic_signer.script.signs import (
    ACROSS_FACE,
    BEHIND,
    BOOK,
    COVER,
    EAT,
    FAR_BEFORE,
    HELLO,
    HIGH,
    HOUSE,
    LOVE,
    LOW,
    REST,
    STACKED,
    STAMP,
    SWING_IN,
    SWING_OUT,
    THANKS,
    THINK,
    WAVE,
    spelled,
)


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
