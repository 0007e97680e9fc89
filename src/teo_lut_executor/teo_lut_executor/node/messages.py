# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Messages from and to what the executor works with."""

from __future__ import annotations

import array
from collections.abc import Sequence
from typing import cast

from builtin_interfaces.msg import Duration, Time
from teo_sign_msgs.msg import DriverState, ExecutorStatus, SignSentence, SignToken
from teo_sign_msgs.msg import TokenTiming as TokenTimingMessage
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from teo_common.arrays import Array
from teo_lut_executor.execution.interface import DriverMode, DriverReport, Sentence, Status
from teo_motion.sentence.plan import TokenTiming
from teo_motion.sentence.sentence_form import SentenceForm, SentenceType
from teo_motion.trajectory.driver_points import Samples
from teo_motion.trajectory.ruckig_segment import State
from teo_signs.sign import Sign
from teo_signs.tokens import Kind, Token

_NANO = 1_000_000_000


def to_sentence(message: SignSentence) -> Sentence:
    """A sentence from its message, unchecked: the planner checks tokens and form."""
    return Sentence(
        tokens=tuple(_to_token(token) for token in message.tokens),
        utterance_id=message.utterance_id,
        index=message.sentence_index,
        count=message.sentence_count,
        form=SentenceForm(
            type=cast(SentenceType, message.type),  # `check_form` refuses what is none
            negated=message.negated,
        ),
        text=message.text,
        language=message.language,
    )


def to_trajectory(names: Sequence[str], samples: Samples, *, start: float | None) -> JointTrajectory:
    """A motion as the driver takes it.

    Args:
        names: Joints.
        samples: The motion. The first is where the robot is by then, and is left out: the driver goes on
            from its own state.
        start: When the robot is to be there [s], the message's stamp; None for as soon as the driver has it
            (stamp 0).
    """
    message = JointTrajectory(joint_names=list(names))
    if start is not None:
        message.header.stamp = _to_time(start)
    message.points = [
        _point(position, velocity, acceleration, time)
        for time, position, velocity, acceleration in zip(
            samples.times[1:].tolist(),
            samples.positions[1:],
            samples.velocities[1:],
            samples.accelerations[1:],
            strict=True,
        )
    ]
    return message


def to_stop(names: Sequence[str], end: State, lead: float) -> JointTrajectory:
    """Come to a standstill, beginning now (stamp 0).

    Args:
        names: Joints.
        end: Where to stand.
        lead: In which time [s].
    """
    point = _point(end.position, end.velocity, end.acceleration, lead)
    return JointTrajectory(joint_names=list(names), points=[point])


def _point(position: Array, velocity: Array, acceleration: Array, time: float) -> JointTrajectoryPoint:
    # The generated setters take arrays as they are, and check lists number for number.
    return JointTrajectoryPoint(
        positions=array.array("d", position.tobytes()),
        velocities=array.array("d", velocity.tobytes()),
        accelerations=array.array("d", acceleration.tobytes()),
        time_from_start=_to_duration(time),
    )


def to_report(message: DriverState) -> DriverReport:
    """What the driver says of itself."""
    under_way = message.mode in (DriverState.MODE_MOVING, DriverState.MODE_PAUSED)
    known = under_way and message.path_duration > 0.0
    return DriverReport(
        mode=DriverMode(message.mode),
        speed_scaling=message.speed_scaling,
        stamp=message.header.stamp.sec + message.header.stamp.nanosec / _NANO,
        remaining=message.path_duration - message.path_time if known else None,
        message=message.message,
    )


def to_status(status: Status) -> ExecutorStatus:
    """What everybody is told."""
    message = ExecutorStatus(
        state=int(status.activity), queued=status.queued, code=status.code, message=status.message
    )
    message.header.stamp = _to_time(status.stamp)
    if status.sentence is not None:
        message.utterance_id = status.sentence.utterance_id
        message.sentence_index = status.sentence.index
        message.sentence_count = status.sentence.count
    if status.plan is not None:
        message.duration = status.plan.duration
        message.stretch = status.plan.stretch
        message.timings = to_timings(status.plan.timings)
    return message


def to_timings(timings: tuple[TokenTiming, ...]) -> list[TokenTimingMessage]:
    """When each token is signed."""
    return [
        TokenTimingMessage(
            token=_from_token(timing.token),
            start=timing.start,
            duration=timing.duration,
            stretch=timing.stretch,
        )
        for timing in timings
    ]


def sign_trajectory(sign: Sign) -> JointTrajectory:
    """The knots of a sign, positions only."""
    message = JointTrajectory(joint_names=list(sign.joints))
    message.points = [
        JointTrajectoryPoint(positions=knot.tolist(), time_from_start=_to_duration(time))
        for time, knot in zip(sign.times.tolist(), sign.knots, strict=True)
    ]
    return message


def _to_time(seconds: float) -> Time:
    """A time of the node's clock [s] as a stamp."""
    whole, nanoseconds = divmod(round(seconds * _NANO), _NANO)
    return Time(sec=whole, nanosec=nanoseconds)


def _to_duration(seconds: float) -> Duration:
    whole, nanoseconds = divmod(round(seconds * _NANO), _NANO)
    return Duration(sec=whole, nanosec=nanoseconds)


def _to_token(message: SignToken) -> Token:
    return Token(
        gloss=message.gloss,
        kind=cast(Kind, message.kind),  # `check_tokens` refuses what is none
        confidence=message.confidence,
        duration_scale=message.duration_scale,
        word_index=message.word_index,
        source_words=tuple(message.source_words),
        inflection=message.inflection,
        origin=message.origin,
    )


def _from_token(token: Token) -> SignToken:
    return SignToken(
        gloss=token.gloss,
        kind=int(token.kind),
        confidence=token.confidence,
        duration_scale=token.duration_scale,
        word_index=token.word_index,
        source_words=list(token.source_words),
        inflection=token.inflection,
        origin=_origin(token),
    )


def _origin(token: Token) -> int:
    """That of the translator; of a letter that the table's lack of a sign has made, spelled."""
    made_here = token.kind is Kind.LETTER and token.origin != SignToken.ORIGIN_UNKNOWN
    return SignToken.ORIGIN_SPELLED if made_here else token.origin
