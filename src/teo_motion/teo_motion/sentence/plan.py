# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The result of planning: the motion of a sentence, when each token is signed, what torque it takes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from teo_common.arrays import Array
from teo_description.robot import Robot
from teo_motion.sentence.sentence_form import GestureKind
from teo_motion.trajectory.driver_points import Samples
from teo_motion.trajectory.joint_motion import JointMotion
from teo_motion.trajectory.ruckig_segment import State
from teo_signs.tokens import Token


@dataclass(frozen=True, kw_only=True)
class TokenTiming:
    """When a token is signed.

    Attributes:
        token: What was signed: where the table lacked a sign, each letter that replaced it.
        start: When the sign itself begins, after the transition into it [s].
        duration: How long the sign itself lasts [s].
        stretch: Duration over the duration asked for [1].
    """

    token: Token
    start: float
    duration: float
    stretch: float


@dataclass(frozen=True, kw_only=True)
class NearestApproach:
    """The closest that parts of the robot come to each other.

    Attributes:
        distance: Least distance [m]; negative where they overlap.
        time: When [s].
        first: One part.
        second: The other.
    """

    distance: float
    time: float
    first: str
    second: str


@dataclass(frozen=True, kw_only=True)
class HeadGesture:
    """What the head says beside the hands.

    Attributes:
        kind: What it does.
        start: When it is first where the gesture has it [s].
        end: When it is last there [s].
    """

    kind: GestureKind
    start: float
    end: float


@dataclass(frozen=True, kw_only=True, eq=False)
class Plan:
    """A sentence as motion, from a start to rest.

    Attributes:
        names: Joints, in the order of all columns.
        motions: The motion of each joint, exact at any time.
        samples: What a driver is sent, the planner's period apart: see `driver_points`. Read-only.
        timings: When each token is signed, in order; empty for a way back to rest.
        stretch: Duration of all signs over the duration asked for; 1.0 as recorded.
        nearest: The closest that parts of the robot come to each other; None if it was not looked at.
        head: What the head says beside the hands, in order.
    """

    names: tuple[str, ...]
    motions: tuple[JointMotion, ...]
    samples: Samples
    timings: tuple[TokenTiming, ...]
    stretch: float
    nearest: NearestApproach | None = None
    head: tuple[HeadGesture, ...] = ()

    @property
    def duration(self) -> float:
        """From the start to rest [s]."""
        return self.motions[0].duration

    @property
    def times(self) -> Array:
        """Times of the samples [s]. Shape (n,)."""
        return self.samples.times

    @property
    def positions(self) -> Array:
        """Positions of the samples [rad]. Shape (n, m)."""
        return self.samples.positions

    @property
    def velocities(self) -> Array:
        """Velocities of the samples [rad/s]. Shape (n, m)."""
        return self.samples.velocities

    @property
    def accelerations(self) -> Array:
        """Accelerations of the samples [rad/s^2]. Shape (n, m)."""
        return self.samples.accelerations

    def at(self, time: float) -> State:
        """The state of the joints at a time [s]."""
        return State(*(values[0] for values in sample_at(self.motions, np.array([time]))[1:]))

    def token_at(self, time: float) -> int | None:
        """Index of the token being signed at a time [s]; None on the way between signs."""
        for index, timing in enumerate(self.timings):
            if timing.start <= time <= timing.start + timing.duration:
                return index
        return None


def sample_at(motions: tuple[JointMotion, ...], times: Array) -> Samples:
    """A motion at given times [s], of shape (n,); read-only."""
    positions, velocities, accelerations = (
        np.stack(columns, axis=1) for columns in zip(*(motion.at(times) for motion in motions), strict=True)
    )
    return Samples(times, positions, velocities, accelerations).frozen()


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
