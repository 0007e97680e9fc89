# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The node's parameters, in one table."""

from __future__ import annotations

from teo_common.parameters import ParameterRow
from teo_sim_driver.joint_follower import DEFAULT_STOP_DECELERATION
from teo_sim_driver.rules import Rules

_RULES = Rules()

PARAMETERS = (
    ParameterRow(
        name="update_rate",
        default=100,
        description="Steps and joint states per second [Hz]; TEO's own state is published at 100 Hz.",
        low=10,
        high=500,
        read_only=True,
    ),
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
    ParameterRow(
        name="stop_deceleration",
        default=DEFAULT_STOP_DECELERATION,
        description="Deceleration of the fastest joint when told to stop [rad/s^2].",
        low=0.2,
        high=50.0,
    ),
)
