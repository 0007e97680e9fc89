# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Without ROS: which sentence is signed when, whether the robot follows, and who is told."""

from teo_lut_executor.execution.interface import (
    Activity,
    Effect,
    Finished,
    Outcome,
    PlanWanted,
    Progress,
    QueueSettings,
    ReturnWanted,
    Sentence,
    Status,
    TrajectoryReady,
)
from teo_lut_executor.execution.queue import ExecutionQueue

__all__ = [
    "Activity",
    "Effect",
    "ExecutionQueue",
    "Finished",
    "Outcome",
    "PlanWanted",
    "Progress",
    "QueueSettings",
    "ReturnWanted",
    "Sentence",
    "Status",
    "TrajectoryReady",
]
