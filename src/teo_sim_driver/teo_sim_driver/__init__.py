# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Simulated joint driver of TEO: executes joint trajectories as the robot would, or says why not."""

from teo_sim_driver.checking.reading import Points
from teo_sim_driver.checking.validation import check
from teo_sim_driver.follower_report import FollowerReport, Mode, Source
from teo_sim_driver.joint_follower import JointFollower
from teo_sim_driver.motion.trajectory import MotionState, Trajectory
from teo_sim_driver.position_direct import PositionDirect, position_direct
from teo_sim_driver.rules import DriverError, Refusal, Rules, TrajectoryError

__all__ = [
    "DriverError",
    "FollowerReport",
    "JointFollower",
    "Mode",
    "MotionState",
    "Points",
    "PositionDirect",
    "Refusal",
    "Rules",
    "Source",
    "Trajectory",
    "TrajectoryError",
    "check",
    "position_direct",
]
