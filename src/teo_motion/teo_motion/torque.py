# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What torque the joints of body and arms need for a plan."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from teo_description.robot import Robot
from teo_motion.sentence.plan import Plan


@dataclass(frozen=True, kw_only=True)
class PeakTorque:
    """The greatest torque of a joint in a plan.

    Attributes:
        joint: Its name.
        torque: Amount of the torque [N m].
        share: Torque over the joint's effort limit [1].
        time: When [s].
    """

    joint: str
    torque: float
    share: float
    time: float


def peak_torques(plan: Plan, robot: Robot) -> tuple[PeakTorque, ...]:
    """Peak torque of each joint of head, trunk and arms, the largest share of its limit first.

    The hands are left out: their masses are placeholders, and tendons bear their load.
    """
    needed = np.abs(robot.torques(plan.positions, plan.velocities, plan.accelerations))
    peaks = []
    joints = robot.humanoid.body_joints
    for joint, effort in zip(joints, robot.humanoid.effort_limits(joints).tolist(), strict=True):
        column = needed[:, plan.names.index(joint)]
        row = int(column.argmax())
        torque = float(column[row])
        peaks.append(
            PeakTorque(joint=joint, torque=torque, share=torque / effort, time=float(plan.times[row]))
        )
    return tuple(sorted(peaks, key=lambda peak: peak.share, reverse=True))
