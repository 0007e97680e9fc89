# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a page asks the node for. Every request carries a number, which its answer repeats."""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated

import msgspec
from msgspec import Meta, Struct

from teo_console.errors import ConsoleError

# Characters of a text: a page of a book. The translator has a limit of its own, and a reason to refuse by.
TEXT_LENGTH = 2000
# Of a gloss in SignToken.
_GLOSS_LENGTH = 64
# Bytes of a message: the longest text in four-byte characters, escaped, and the words around it.
MESSAGE_BYTES = 32 * 1024

Number = Annotated[int, Meta(ge=0, le=2**31 - 1)]
Text = Annotated[str, Meta(min_length=1, max_length=TEXT_LENGTH)]
Gloss = Annotated[str, Meta(min_length=1, max_length=_GLOSS_LENGTH)]
Name = Annotated[str, Meta(min_length=1, max_length=64)]


class Request(Struct, frozen=True, kw_only=True, forbid_unknown_fields=True, tag_field="type"):
    """What every request has."""

    id: Number


class SignText(Request, frozen=True, tag="sign_text"):
    """Have a Spanish text signed."""

    text: Text


class SignGlosses(Request, frozen=True, tag="sign_glosses"):
    """Have signs of the table signed in a row, without translation."""

    glosses: Annotated[tuple[Gloss, ...], Meta(min_length=1, max_length=32)]


class Order(StrEnum):
    """What the robot can be told at any time."""

    STOP = "stop"
    REARM = "rearm"
    PAUSE = "pause"
    RESUME = "resume"
    CLEAR_QUEUE = "clear_queue"


class Command(Request, frozen=True, tag="command"):
    """Tell the robot something at once."""

    order: Order


class SetSpeed(Request, frozen=True, tag="set_speed"):
    """How fast the robot signs, of the speed that was planned. 0 would be a pause, which is an order."""

    factor: Annotated[float, Meta(ge=0.1, le=1.0)]


class ConfirmSpoken(Request, frozen=True, tag="confirm_spoken"):
    """Sign what was recognised, as it stands or mended."""

    spoken: Name
    text: Text


class DiscardSpoken(Request, frozen=True, tag="discard_spoken"):
    """Forget what was recognised."""

    spoken: Name


class FetchSign(Request, frozen=True, tag="get_sign"):
    """One sign of the table: its entry, and its motion."""

    gloss: Gloss


FromPage = SignText | SignGlosses | Command | SetSpeed | ConfirmSpoken | DiscardSpoken | FetchSign

_DECODER = msgspec.json.Decoder(FromPage)


def decode(message: str) -> FromPage:
    """Read a message of a page.

    Raises:
        ConsoleError: "malformed": it is no such message; the sentence says where it is wrong.
    """
    try:
        asked: FromPage = _DECODER.decode(message)
    except (msgspec.DecodeError, RecursionError, UnicodeError) as error:
        raise ConsoleError(
            "malformed", f"expected a message as protocol.schema.json has it: {error}"
        ) from error
    return asked
