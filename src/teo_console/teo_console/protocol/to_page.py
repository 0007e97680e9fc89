# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the node tells a page: the one situation that all pages share, and answers to their requests.

Poses are binary frames: the time [s] as a float64, then a float32 for each joint [rad], little-endian. Thirty
a second go to every page: as JSON they would be ten times as long.

Times are seconds of the node's clock, as the stamps of the messages that they come from.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence
from typing import Literal

import msgspec
from msgspec import Struct

TokenKind = Literal["sign", "letter", "number", "pause"]
Origin = Literal[
    "unknown", "model", "lemma", "synonym", "spelled", "number", "repaired", "word_list", "pause",
    "paraphrase", "hypernym", "draft",
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


class Welcome(Struct, frozen=True, kw_only=True, tag_field="type", tag="welcome"):
    """The first message on a connection, and again when the joints change."""

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


def decode_pose(frame: bytes) -> tuple[float, tuple[float, ...]]:
    """Read a pose: its time [s], and the positions [rad]."""
    stamp, *positions = struct.unpack(f"<d{(len(frame) - 8) // 4}f", frame)
    return stamp, tuple(positions)
