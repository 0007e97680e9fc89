# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The node's parameters, in one table."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields

from teo_common.parameters import ParameterRow
from teo_lut_executor.execution.events import QueueSettings
from teo_motion.planner import DEFAULT_CLEARANCE, DEFAULT_MAX_DURATION, DEFAULT_PERIOD
from teo_motion.sentence.rhythm import SigningStyle
from teo_motion.trajectory.limits import DEFAULT_ACCELERATION, DEFAULT_JERK, MotionLimits
from teo_signs.errors import PlanError
from teo_signs.lexicon import DEFAULT_STANDING
from teo_signs.sign_schema import STANDINGS, Standing

Value = str | int | float

_STYLE = SigningStyle()
_QUEUE = QueueSettings()


def _row(name: str, default: float, low: float, high: float, description: str) -> ParameterRow:
    return ParameterRow(name=name, default=default, low=low, high=high, description=description)


PARAMETERS = (
    ParameterRow(
        name="lut_directory",
        default="",
        description="Directory of the look-up table; empty for the package's table of LSE.",
        read_only=True,
    ),
    ParameterRow(
        name="least_standing",
        default=DEFAULT_STANDING,
        description=f"Lowest standing of signs ({', '.join(STANDINGS)}); words of a lower one are spelled.",
    ),
    ParameterRow(
        name="dominant_hand",
        default="right",
        description="Hand that makes one-handed signs (right, left); left mirrors every sign.",
    ),
    # Motion.
    _row("acceleration", DEFAULT_ACCELERATION, 0.5, 50.0, "Greatest acceleration of every joint [rad/s^2]."),
    _row("jerk", DEFAULT_JERK, 1.0, 1000.0, "Greatest jerk of every joint [rad/s^3]."),
    _row("period", DEFAULT_PERIOD, 0.005, 0.1, "Time between two points of a trajectory [s]."),
    _row(
        "least_clearance",
        DEFAULT_CLEARANCE,
        0.0,
        0.1,
        "Distance that parts of the robot keep from each other [m]; a sentence that cannot is refused.",
    ),
    _row("max_duration", DEFAULT_MAX_DURATION, 1.0, 600.0, "Longest sentence that is signed [s]."),
    # Style.
    _row("transition", _STYLE.transition, 0.0, 5.0, "Least time between two signs [s]."),
    _row("letter_hold", _STYLE.letter_hold, 0.0, 5.0, "Time for which a letter or number stands still [s]."),
    _row(
        "last_letter_hold",
        _STYLE.last_letter_hold,
        0.0,
        10.0,
        "Times as long for a word's last letter [1].",
    ),
    _row("word_pause", _STYLE.word_pause, 0.0, 5.0, "Time of standing still after a spelled word [s]."),
    _row("pause", _STYLE.pause, 0.0, 10.0, "Time of a pause token [s]."),
    _row("posture_hold", _STYLE.posture_hold, 0.0, 5.0, "Time for which a sign of one posture is held [s]."),
    _row("final_hold", _STYLE.final_hold, 0.0, 5.0, "Time for which a sentence's last sign is held [s]."),
    _row(
        "question_hold",
        _STYLE.question_hold,
        0.0,
        5.0,
        "Time for which a yes/no question's last sign is held [s].",
    ),
    _row(
        "repeat_angle", _STYLE.repeat_angle, 0.0, 0.5, "Move of the elbow between two equal postures [rad]."
    ),
    _row("repeat_time", _STYLE.repeat_time, 0.0, 2.0, "Least time of each half of that move [s]."),
    _row("arm_rest", _STYLE.arm_rest, 0.0, 60.0, "Least time at rest worth an idle arm's way [s]."),
    _row(
        "head_motion",
        _STYLE.head_motion,
        0.0,
        1.0,
        "Size of the head gestures of questions, negation and exclamations; 0 leaves them away [1].",
    ),
    _row(
        "least_size",
        _STYLE.least_size,
        0.1,
        1.0,
        "Smallest size of a word that is too slow as large as in the table; 1 keeps all as large [1].",
    ),
    # Queue.
    ParameterRow(
        name="capacity",
        default=_QUEUE.capacity,
        low=1,
        high=10_000,
        description="Most sentences that wait; more are refused.",
    ),
    _row(
        "joint_state_timeout",
        _QUEUE.joint_state_timeout,
        0.05,
        10.0,
        "Oldest joint states from which a sentence may start [s].",
    ),
    _row("goal_tolerance", _QUEUE.goal_tolerance, 0.001, 0.2, "How near to rest a sentence has ended [rad]."),
    _row("goal_time", _QUEUE.goal_time, 0.0, 30.0, "Time after its planned end to be that near [s]."),
    _row("path_tolerance", _QUEUE.path_tolerance, 0.02, 3.0, "How far a joint may be from the plan [rad]."),
    _row("path_time", _QUEUE.path_time, 0.0, 10.0, "For how long it may be farther [s]."),
)


def limits_from(values: Mapping[str, Value]) -> MotionLimits:
    """Limits of the joints.

    Raises:
        PlanError: See `MotionLimits`.
    """
    return MotionLimits.of_robot(acceleration=float(values["acceleration"]), jerk=float(values["jerk"]))


def standing_from(values: Mapping[str, Value]) -> Standing:
    """Lowest standing of a sign.

    Raises:
        PlanError: It is none ("bad_standing").
    """
    for standing in STANDINGS:
        if values["least_standing"] == standing:
            return standing
    got = values["least_standing"]
    raise PlanError("bad_standing", f"least_standing: expected one of {', '.join(STANDINGS)}, got {got!r}")


def left_handed_from(values: Mapping[str, Value]) -> bool:
    """Whether signs are mirrored for a left-handed signer.

    Raises:
        PlanError: The dominant hand is neither ("bad_hand").
    """
    hand = values["dominant_hand"]
    if hand not in ("right", "left"):
        raise PlanError("bad_hand", f"dominant_hand: expected right or left, got {hand!r}")
    return hand == "left"


def style_from(values: Mapping[str, Value]) -> SigningStyle:
    """Times of holds and pauses."""
    return SigningStyle(**{field.name: float(values[field.name]) for field in fields(SigningStyle)})


def queue_settings_from(values: Mapping[str, Value]) -> QueueSettings:
    """How patient the queue is."""
    names = [field.name for field in fields(QueueSettings) if field.name != "capacity"]
    times = {name: float(values[name]) for name in names}
    return QueueSettings(capacity=int(values["capacity"]), **times)
