# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What page and node say to each other over the websocket, as types: JSON both ways, poses as binary frames.

`FromPage` and `ToPage` are tagged unions by their field `type`. Times are seconds of the node's clock, as the
stamps of the messages that they come from. `python -m teo_console.protocol` writes both unions as the JSON
Schema that `protocol.schema.json` holds.

A pose is the time [s] as a float64, then a float32 for each joint [rad], little-endian. Every page gets 30 a
second: as JSON they would be ten times as long.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Sequence
from enum import StrEnum
from typing import Annotated, Literal

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
    """Have a text signed."""

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


class SetLanguage(Request, frozen=True, tag="set_language"):
    """Have translator and executor change to another sign language."""

    language: Name


FromPage = (
    SignText | SignGlosses | Command | SetSpeed | ConfirmSpoken | DiscardSpoken | FetchSign | SetLanguage
)

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


TokenKind = Literal["sign", "letter", "number", "pause"]
Origin = Literal[
    "unknown", "model", "lemma", "synonym", "spelled", "number", "repaired", "word_list", "pause",
    "paraphrase",
]  # fmt: skip
SentenceType = Literal["statement", "yes_no_question", "wh_question", "exclamation"]
SentenceState = Literal["waiting", "signing", "signed", "refused"]
NodeRole = Literal["translator", "executor", "driver"]
NodeState = Literal["alive", "unwell", "silent", "missing"]
RobotMode = Literal["unknown", "holding", "moving", "paused", "stopped", "inactive", "fault"]
ExecutorState = Literal["unknown", "idle", "signing", "waiting", "refused", "paused", "stopped", "fault"]


class Caption(Struct, frozen=True, kw_only=True):
    """One sign of a sentence, and how it came about: see SignToken of teo_sign_msgs."""

    gloss: str
    kind: TokenKind
    origin: Origin
    words: tuple[str, ...]
    """Of the text, that it stands for."""
    word_index: int
    inflection: str
    confidence: float
    start: float | None = None
    """From the beginning of the sentence's motion [s]; None before it is planned."""
    duration: float | None = None
    """Of the sign itself [s]; None before it is planned."""


class Sentence(Struct, frozen=True, kw_only=True):
    """One sentence on its way."""

    utterance: str
    index: int
    count: int
    """Place in its text, and sentences of that."""
    text: str
    form: SentenceType
    negated: bool
    uncertain: bool
    dropped: tuple[str, ...]
    """Words of the text that no sign stands for."""
    captions: tuple[Caption, ...]
    state: SentenceState
    duration: float = 0.0
    """Of the whole motion [s]; 0 before it is planned."""
    code: str = ""
    message: str = ""
    """Why it was refused."""


class Progress(Struct, frozen=True, kw_only=True):
    """How far the current sentence is: `elapsed + speed * (t - stamp)` at a time `t`."""

    stamp: float
    elapsed: float
    """Since its motion began [s]."""
    speed: float
    """Motion's seconds a second, 0 to 1."""


class Health(Struct, frozen=True, kw_only=True):
    """How a node is."""

    role: NodeRole
    state: NodeState
    message: str
    """What it says of itself; empty if it is well or does not speak."""
    quiet: float
    """Time since it was last heard [s]; 0 while it is heard or where it never was."""


class Robot(Struct, frozen=True, kw_only=True):
    """What the driver and the executor say."""

    mode: RobotMode
    message: str
    executor: ExecutorState
    executor_code: str
    executor_message: str
    speed: float
    """In force now, 0 to 1: it is 0 in a pause."""
    speed_wanted: float
    """As last asked for by a page, 0.1 to 1."""


class Queued(Struct, frozen=True, kw_only=True):
    """A sentence that the executor has accepted."""

    utterance: str
    index: int
    text: str
    current: bool


class Spoken(Struct, frozen=True, kw_only=True):
    """What a recogniser of speech has heard, until a page confirms or discards it."""

    id: str
    text: str


class Refusal(Struct, frozen=True, kw_only=True):
    """The last text that the translator refused."""

    stamp: float
    text: str
    code: str
    message: str


class Situation(Struct, frozen=True, kw_only=True, tag_field="type", tag="situation"):
    """All that pages show of the robot; every page gets the same."""

    stamp: float
    nodes: tuple[Health, ...]
    robot: Robot
    current: Sentence | None
    progress: Progress | None
    queue: tuple[Queued, ...]
    history: tuple[Sentence, ...]
    """Sentences that were signed or refused, the newest first."""
    spoken: tuple[Spoken, ...]
    refusal: Refusal | None
    pages: int
    """Pages that are open."""


class Names(Struct, frozen=True, kw_only=True):
    """What pages call the robot and the languages that run."""

    robot: str
    """In capitals, as people write it: "TEO"."""
    signs: str
    """Of the sign language, short: "LSE"."""
    spoken: str
    """BCP 47 tag of the language of the texts, "es": a browser knows its name in any language."""
    example: str
    """A text to try."""
    language: str
    """Of the sign language, its ISO 639-3 code."""
    languages: dict[str, str]
    """Sign languages that this robot has signs of: their short names by code."""


class Welcome(Struct, frozen=True, kw_only=True, tag_field="type", tag="welcome"):
    """The first message on a connection, and again when the joints change."""

    names: Names
    joints: tuple[str, ...]
    """In the order of the numbers of binary frames; empty while none was heard."""
    robot: bool
    """Whether /api/robot.urdf has the robot's description."""


class Motion(Struct, frozen=True, kw_only=True):
    """Knots of a sign, or rows of a sentence's motion."""

    joints: tuple[str, ...]
    times: tuple[float, ...]
    """Of each knot [s], from 0."""
    positions: tuple[tuple[float, ...], ...]
    """Of each knot, in the order of the joints [rad]."""


class Sign(Struct, frozen=True, kw_only=True):
    """One sign of the table."""

    gloss: str
    handedness: str
    entry: str
    """Text of its JSON file."""
    motion: Motion


class Answer(Struct, frozen=True, kw_only=True, tag_field="type", tag="answer"):
    """What became of a request."""

    id: int | None
    """Of the request; None if that cannot be read."""
    success: bool
    code: str = ""
    """Stable reason if not success."""
    message: str = ""
    """A sentence for people."""
    sign: Sign | None = None


ToPage = Situation | Welcome | Answer

_ENCODER = msgspec.json.Encoder()


def encode(message: ToPage) -> str:
    """Write a message for a page."""
    return _ENCODER.encode(message).decode()


def encode_pose(stamp: float, positions: Sequence[float]) -> bytes:
    """Write a pose.

    Args:
        stamp: When it was measured, by the node's clock [s].
        positions: Of the joints in the order of the last `Welcome` [rad].
    """
    return struct.pack(f"<d{len(positions)}f", stamp, *positions)


def schema_text() -> str:
    """Both directions as JSON Schema, with the types that they share under `$defs`: the text of its file."""
    (from_page, to_page), definitions = msgspec.json.schema_components((FromPage, ToPage))
    schema = {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Messages of the console's websocket",
        "$defs": {**definitions, "FromPage": from_page, "ToPage": to_page},
        "description": "A page sends FromPage, the node ToPage.",
    }
    return json.dumps(schema, indent=2, ensure_ascii=False) + "\n"


if __name__ == "__main__":
    print(schema_text(), end="")
