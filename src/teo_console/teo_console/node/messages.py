# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""ROS messages as the protocol's types."""

from __future__ import annotations

import re
from typing import Any, get_args

from msgspec.structs import replace
from rcl_interfaces.srv import SetParameters
from std_srvs.srv import Trigger
from teo_sign_msgs.msg import (
    DriverState,
    ExecutorStatus,
    SignSentence,
    SignToken,
    TranslationStatus,
)
from teo_sign_msgs.srv import GetSign, ListQueue

from teo_console.protocol import (
    Answer,
    Caption,
    ExecutorState,
    Motion,
    Origin,
    Queued,
    Refusal,
    RobotMode,
    Sentence,
    SentenceType,
    Sign,
    TokenKind,
)
from teo_console.sentences import PathReport, SigningReport


def _words(message: type, prefix: str, words: Any) -> dict[int, Any]:
    """The protocol's words by the numbers of a message's constants, as STATE_IDLE for "idle"."""
    numbers = {word: getattr(message, f"{prefix}_{word.upper()}", None) for word in get_args(words)}
    return {number: word for word, number in numbers.items() if number is not None}


_KINDS: dict[int, TokenKind] = {SignToken.KIND_LEXICAL: "sign", **_words(SignToken, "KIND", TokenKind)}
_ORIGINS: dict[int, Origin] = _words(SignToken, "ORIGIN", Origin)
_TYPES: dict[int, SentenceType] = _words(SignSentence, "TYPE", SentenceType)
_EXECUTOR: dict[int, ExecutorState] = _words(ExecutorStatus, "STATE", ExecutorState)
_MODES: dict[int, RobotMode] = _words(DriverState, "MODE", RobotMode)

# A refusal of driver or executor: its stable reason, and a sentence for people.
_REFUSAL = re.compile(r"([a-z][a-z0-9_]*): (.+)", re.DOTALL)
# That of a parameter.
_REFUSED_VALUE = re.compile(r"\[([a-z][a-z0-9_]*)\] (.+)", re.DOTALL)


def seconds(stamp: object) -> float:
    """Give a builtin_interfaces Time or Duration in seconds."""
    return float(stamp.sec) + float(stamp.nanosec) * 1e-9  # type: ignore[attr-defined]  # generated, untyped


def to_answer(number: int, response: Trigger.Response) -> Answer:
    """What became of a command; "not_done" if it was refused without a reason's code."""
    return _answer(number, response.success, response.message, _REFUSAL)


def to_answer_of_set(number: int, response: SetParameters.Response) -> Answer:
    """What became of a parameter that was to be set."""
    (result,) = response.results
    return _answer(number, result.successful, result.reason, _REFUSED_VALUE)


def _answer(number: int, success: bool, said: str, refusal: re.Pattern[str]) -> Answer:
    if success:
        return Answer(id=number, success=True, message=said)
    refused = refusal.fullmatch(said)
    code, sentence = refused.groups() if refused else ("not_done", said)
    return Answer(id=number, success=False, code=code, message=sentence)


def to_sentence(message: SignSentence) -> Sentence:
    """A sentence as announced."""
    return Sentence(
        utterance=message.utterance_id,
        index=message.sentence_index,
        count=message.sentence_count,
        text=message.text,
        form=_TYPES.get(message.type, "statement"),
        negated=message.negated,
        uncertain=message.uncertain,
        dropped=tuple(message.dropped),
        captions=tuple(_to_caption(token) for token in message.tokens),
        state="waiting",
    )


def to_signing_report(message: ExecutorStatus) -> SigningReport:
    """What the executor says."""
    return SigningReport(
        stamp=seconds(message.header.stamp),
        state=_EXECUTOR.get(message.state, "unknown"),
        key=(message.utterance_id, message.sentence_index) if message.utterance_id else None,
        duration=message.duration,
        captions=tuple(
            replace(_to_caption(timing.token), start=timing.start, duration=timing.duration)
            for timing in message.timings
        ),
        code=message.code,
        message=message.message,
    )


def to_path_report(message: DriverState) -> PathReport:
    """What the driver says of its path."""
    under_way = message.mode in (DriverState.MODE_MOVING, DriverState.MODE_PAUSED)
    known = under_way and message.path_duration > 0.0
    return PathReport(
        stamp=seconds(message.header.stamp),
        speed=message.speed_scaling,
        remaining=message.path_duration - message.path_time if known else None,
    )


def to_mode(message: DriverState) -> RobotMode:
    """What the driver does."""
    return _MODES.get(message.mode, "unknown")


def to_refusal(message: TranslationStatus) -> Refusal | None:
    """A text that was refused; None if it was translated."""
    if not message.code:
        return None
    return Refusal(
        stamp=seconds(message.header.stamp), text=message.text, code=message.code, message=message.message
    )


def to_queue(response: ListQueue.Response) -> tuple[Queued, ...]:
    """The executor's queue."""
    rows = zip(response.utterance_ids, response.sentence_indices, response.texts, strict=True)
    return tuple(
        Queued(utterance=utterance, index=index, text=text, current=row == response.current)
        for row, (utterance, index, text) in enumerate(rows)
    )


def to_answer_of_sign(number: int, gloss: str, response: GetSign.Response) -> Answer:
    """One sign of the table, or why it is not there."""
    if not response.success:
        return Answer(id=number, success=False, code=response.code, message=response.message)
    points = response.trajectory.points
    motion = Motion(
        joints=tuple(response.trajectory.joint_names),
        times=tuple(seconds(point.time_from_start) for point in points),
        positions=tuple(tuple(point.positions) for point in points),
    )
    sign = Sign(gloss=gloss, handedness=response.handedness, entry=response.entry, motion=motion)
    return Answer(id=number, success=True, sign=sign)


def _to_caption(token: SignToken) -> Caption:
    return Caption(
        gloss=token.gloss,
        kind=_KINDS.get(token.kind, "sign"),
        origin=_ORIGINS.get(token.origin, "unknown"),
        words=tuple(token.source_words),
        word_index=token.word_index,
        inflection=token.inflection,
        confidence=token.confidence,
    )
