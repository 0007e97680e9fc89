# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The node's parameters, in one table."""

from __future__ import annotations

from teo_common.parameters import ROBOT, ParameterRow
from teo_sim_driver.motion.path_time import DEFAULT_STOP_DECELERATION, DEFAULT_STOP_JERK
from teo_sim_driver.plants.plant import Faults
from teo_sim_driver.rules import Rules

# Which joints the driver drives.
IDEAL, MUJOCO = "ideal", "mujoco"

_RULES = Rules()
_FAULTS = Faults()

# How far a joint may be from where it was told to be before it counts as not following [rad], 5.7 deg: a
# drive that is 0.11 s late at the greatest speed; what lags less is slow, not broken.
DEFAULT_FOLLOWING_ERROR = 0.1

RULE_PARAMETERS = (
    ParameterRow(
        name="start_tolerance",
        default=_RULES.start_tolerance,
        description="How far each joint may be from a first point that is due at the start [rad].",
        low=0.0001,
        high=0.1,
    ),
    ParameterRow(
        name="max_duration",
        default=_RULES.max_duration,
        description="Longest trajectory that is accepted [s].",
        low=1.0,
        high=3600.0,
    ),
    ParameterRow(
        name="max_points",
        default=_RULES.max_points,
        description="Most points that a trajectory may have.",
        low=1,
        high=100_000,
    ),
    ParameterRow(
        name="max_start_delay",
        default=_RULES.max_start_delay,
        description="How far ahead a trajectory's stamp may schedule its start [s].",
        low=0.0,
        high=3600.0,
    ),
    ParameterRow(
        name="allow_partial_joints_goal",
        default=_RULES.allow_partial_joints_goal,
        description="Whether a trajectory may leave joints out, which then hold their position.",
    ),
)

FAULT_PARAMETERS = (
    ParameterRow(
        name="fault_frozen",
        default=",".join(_FAULTS.frozen),
        description="Injected: joints that do not move, by name, with commas between.",
    ),
    ParameterRow(
        name="fault_limit_switches",
        default=",".join(_FAULTS.limit_switches),
        description="Injected: joints whose limit switch is pressed, by name, with commas between.",
    ),
    ParameterRow(
        name="fault_lag",
        default=_FAULTS.lag,
        description="Injected: time constant of a first-order lag of every joint [s].",
        low=0.0,
        high=2.0,
    ),
    ParameterRow(
        name="fault_tracking_error",
        default=_FAULTS.tracking_error,
        description="Injected: how far every joint is beyond where it was told to be [rad].",
        low=-0.5,
        high=0.5,
    ),
    ParameterRow(
        name="fault_encoder_step",
        default=_FAULTS.encoder_step,
        description="Injected: positions are measured in steps of this size [rad].",
        low=0.0,
        high=0.1,
    ),
    ParameterRow(
        name="fault_state_delay",
        default=_FAULTS.state_delay,
        description="Injected: joint states are published this much late, with their own stamps [s].",
        low=0.0,
        high=5.0,
    ),
    ParameterRow(
        name="fault_state_loss",
        default=_FAULTS.state_loss,
        description="Injected: part of the joint states that is lost; 1 for all.",
        low=0.0,
        high=1.0,
    ),
)

PARAMETERS = (
    ROBOT,
    ParameterRow(
        name="update_rate",
        default=100,
        description="Steps and joint states per second [Hz]; TEO's own state is published at 100 Hz.",
        low=10,
        high=500,
        read_only=True,
    ),
    ParameterRow(
        name="autostart",
        default=True,
        description=(
            "Whether the node configures and activates itself, so that it works without a lifecycle manager."
        ),
        read_only=True,
    ),
    ParameterRow(
        name="plant",
        default=IDEAL,
        description=(
            "The joints: `ideal` ones are where they are told to be; with `mujoco` they have mass, servos, "
            "gravity and contact."
        ),
        choices=(IDEAL, MUJOCO),
        read_only=True,
    ),
    ParameterRow(
        name="hand_drive",
        default="",
        description="Gearmotors of the hands, which limit the speed of their axes: one of the robot's "
        "`hand_drives`, where it has several; empty for its default.",
        read_only=True,
    ),
    *RULE_PARAMETERS,
    ParameterRow(
        name="stop_deceleration",
        default=DEFAULT_STOP_DECELERATION,
        description="Greatest that stopping, pausing and scaling add to the fastest joint's [rad/s^2].",
        low=0.2,
        high=50.0,
    ),
    ParameterRow(
        name="stop_jerk",
        default=DEFAULT_STOP_JERK,
        description="Greatest jerk that stopping, pausing and scaling give the fastest joint [rad/s^3].",
        low=1.0,
        high=2000.0,
    ),
    ParameterRow(
        name="following_error",
        default=DEFAULT_FOLLOWING_ERROR,
        description="How far a joint may be from where it was told to be before it is a fault [rad].",
        low=0.001,
        high=1.0,
    ),
    *FAULT_PARAMETERS,
)
