# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The node's parameters, in one table."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import fields
from pathlib import Path
from typing import cast

from teo_common.parameters import AUTOSTART, ROBOT, ParameterRow
from teo_lut_executor.execution.interface import Preemption, QueueSettings
from teo_lut_executor.planning_worker import PlannerSettings
from teo_motion.sentence.signing_style import RestPosture, SigningStyle
from teo_signs.errors import PlanError
from teo_signs.sign_schema import STANDINGS, Standing

Value = str | int | float

# Values of `trajectory_interface`.
TOPIC, ACTION = "topic", "action"

# Defaults of what is set by the parameter of the same name.
_DEFAULTS = vars(PlannerSettings()) | vars(SigningStyle()) | vars(QueueSettings())


def _row(name: str, low: float, high: float, description: str) -> ParameterRow:
    """A number of the settings."""
    return ParameterRow(name=name, default=_DEFAULTS[name], low=low, high=high, description=description)


PARAMETERS = (
    ROBOT,
    ParameterRow(
        name="language",
        default=_DEFAULTS["language"],
        description="Sign language, by its ISO 639-3 code. Sentences of another are refused; those taken "
        "before a change are signed in their own.",
    ),
    ParameterRow(
        name="lut_directory",
        default="",
        description="Directory of the look-up table; empty for the user's own, then the language's.",
        read_only=True,
    ),
    ParameterRow(
        name="least_standing",
        default=_DEFAULTS["least_standing"],
        description=f"Lowest standing of signs ({', '.join(STANDINGS)}); words of a lower one are spelled.",
    ),
    ParameterRow(
        name="dominant_hand",
        default="right",
        description="Hand that makes one-handed signs (right, left); left mirrors every sign.",
    ),
    AUTOSTART,
    ParameterRow(
        name="journal",
        default="~/.ros/teo_lut_executor",  # where ROS keeps its logs
        description="Folder of the journal, by which sentences survive a killed process; empty for none.",
        read_only=True,
    ),
    ParameterRow(
        name="journal_age",
        default=60.0,  # later nobody waits for them, and a robot that signs out of the blue frightens people
        low=0.0,
        high=86_400.0,
        description="Age up to which sentences from before the executor began are signed; older ones are "
        "named only [s].",
        read_only=True,
    ),
    ParameterRow(
        name="trajectory_interface",
        default=TOPIC,  # to be seen and recorded by whoever listens
        choices=(TOPIC, ACTION),
        description="How motions reach the driver: on joint_trajectory, or as goals of "
        "follow_joint_trajectory where a driver serves it (else on the topic).",
        read_only=True,
    ),
    # Motion.
    ParameterRow(
        name="hand_drive",
        default=_DEFAULTS["hand_drive"],
        description="Gearmotors of the hands, which limit the speed of their axes: one of the robot's "
        "`hand_drives`, where it has several; empty for its default. The driver's parameter of that name "
        "must not name slower ones.",
    ),
    _row(
        "acceleration",
        0.5,
        50.0,
        "Greatest acceleration of the body's joints [rad/s^2]; hands: times their drive's `quickness`.",
    ),
    _row("jerk", 1.0, 1000.0, "Greatest jerk of the body's joints [rad/s^3]; hands likewise."),
    _row("period", 0.005, 0.1, "Time between two points of a trajectory [s]."),
    _row(
        "least_clearance",
        0.0,
        0.1,
        "Distance that parts of the robot keep from each other [m]; a sentence that cannot is refused.",
    ),
    _row("max_duration", 1.0, 600.0, "Longest sentence that is signed [s]."),
    ParameterRow(
        name="rest_posture",
        default=str(_DEFAULTS["rest_posture"]),
        choices=tuple(str(posture) for posture in RestPosture),
        description="Where the robot waits: with hanging arms, or ready, hands low before the body. A robot "
        "that stands in either is at rest.",
    ),
    # Style.
    _row("transition", 0.0, 5.0, "Least time between two signs [s]."),
    _row("letter_hold", 0.0, 5.0, "Time for which a letter or number stands still [s]."),
    _row("last_letter_hold", 0.0, 10.0, "Times as long for a word's last letter [1]."),
    _row("word_pause", 0.0, 5.0, "Time of standing still after a spelled word [s]."),
    _row("pause", 0.0, 10.0, "Time of a pause token [s]."),
    _row("posture_hold", 0.0, 5.0, "Time for which a sign of one posture is held [s]."),
    _row("final_hold", 0.0, 5.0, "Time for which a sentence's last sign is held [s]."),
    _row("question_hold", 0.0, 5.0, "Time for which a yes/no question's last sign is held [s]."),
    _row("repeat_angle", 0.0, 0.5, "Move of the elbow between two equal postures [rad]."),
    _row("repeat_time", 0.0, 2.0, "Least time of each half of that move [s]."),
    _row("arm_rest", 0.0, 60.0, "Least time at rest worth an idle arm's way [s]."),
    _row(
        "head_motion",
        0.0,
        1.0,
        "Size of the head gestures of questions, negation and exclamations; 0 leaves them away [1].",
    ),
    _row(
        "least_size",
        0.1,
        1.0,
        "Smallest size of a word that is too slow as large as in the table; 1 keeps all as large [1].",
    ),
    # Queue.
    _row("capacity", 1, 10_000, "Most sentences that wait; more are refused."),
    _row("joint_state_timeout", 0.05, 10.0, "Oldest joint states from which a sentence may start [s]."),
    _row("goal_tolerance", 0.001, 0.2, "How near to rest a sentence has ended [rad]."),
    _row("goal_time", 0.0, 30.0, "Time after its planned end to be that near [s]."),
    _row("path_tolerance", 0.02, 3.0, "How far a joint may be from the plan [rad]."),
    _row(
        "sentence_pause",
        0.0,
        10.0,
        "Time of standing still between sentences that follow one another, beyond the last sign's hold [s].",
    ),
    _row(
        "attempts",
        1,
        5,
        "How often a sentence that the robot does not follow is begun before it is given up [1].",
    ),
    ParameterRow(
        name="preempt_policy",
        default=str(_DEFAULTS["preemption"]),
        choices=tuple(Preemption),
        description="What a new text does: wait in the queue, or replace every earlier one.",
    ),
    _row("path_time", 0.0, 10.0, "For how long it may be farther, and how late on its path it may be [s]."),
)


def _one_of(values: Mapping[str, Value], name: str, choices: Iterable[str], *, code: str) -> str:
    """The word of a choice.

    Raises:
        PlanError: It is none of them (the code).
    """
    value, words = values[name], list(choices)
    if value not in words:
        raise PlanError(code, f"{name}: expected one of {', '.join(words)}, got {value!r}")
    return str(value)


# Settings of the planner that are numbers.
_NUMBERS = ("acceleration", "jerk", "least_clearance", "period", "max_duration")


def planner_settings_from(values: Mapping[str, Value]) -> PlannerSettings:
    """What the planner is made of.

    Raises:
        PlanError: A value is none that there is ("bad_standing", "bad_hand", "bad_rest", "bad_style").
    """
    directory = str(values["lut_directory"])
    hand = _one_of(values, "dominant_hand", ("right", "left"), code="bad_hand")
    standing = _one_of(values, "least_standing", STANDINGS, code="bad_standing")
    rest = _one_of(values, "rest_posture", RestPosture, code="bad_rest")
    return PlannerSettings(
        robot=str(values["robot"]),
        language=str(values["language"]),
        lut_directory=Path(directory) if directory else None,
        left_handed=hand == "left",
        least_standing=cast(Standing, standing),
        style=SigningStyle(**{field.name: float(values[field.name]) for field in fields(SigningStyle)}),
        hand_drive=str(values["hand_drive"]),
        rest_posture=RestPosture(rest),
        **{name: float(values[name]) for name in _NUMBERS},
    )


def queue_settings_from(values: Mapping[str, Value]) -> QueueSettings:
    """How patient the queue is.

    Raises:
        PlanError: There is no such policy ("bad_policy").
    """
    policy = _one_of(values, "preempt_policy", Preemption, code="bad_policy")
    apart = ("capacity", "attempts", "preemption")
    names = [field.name for field in fields(QueueSettings) if field.name not in apart]
    return QueueSettings(
        capacity=int(values["capacity"]),
        attempts=int(values["attempts"]),
        preemption=Preemption(policy),
        **{name: float(values[name]) for name in names},
    )
