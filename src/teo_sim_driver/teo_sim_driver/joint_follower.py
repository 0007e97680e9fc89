# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the joints do: follow a trajectory, hold, or stop."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from teo_description import JointLimits
from teo_sim_driver.bezier import FloatArray
from teo_sim_driver.errors import DriverError, Refusal, TrajectoryError
from teo_sim_driver.message import TrajectoryLike
from teo_sim_driver.path_time import PathClock, PathStop
from teo_sim_driver.rules import Rules
from teo_sim_driver.step_guard import StepGuard
from teo_sim_driver.trajectory import MotionState, Trajectory
from teo_sim_driver.validation import validate

# Deceleration of a stop [rad/s^2], 300 deg/s^2: about that of signs. No limit of the real joints is public;
# from 50 deg/s it takes 0.25 s and at most 0.11 rad.
DEFAULT_STOP_DECELERATION = 5.2


class Activity(StrEnum):
    """What the follower is doing."""

    HOLDING = "holding"
    FOLLOWING = "following"
    STOPPING = "stopping"


@dataclass(frozen=True, kw_only=True)
class FollowerReport:
    """What has happened since the start."""

    activity: Activity
    elapsed: float
    """Trajectory time that has been executed [s]; 0 when holding."""
    duration: float
    """Duration of the trajectory that is being executed [s]; 0 when holding."""
    accepted: int
    refused: dict[str, int]
    """Refusal code to number of messages."""
    last_refusal: TrajectoryError | None
    limited_steps: int
    """Steps that the guard changed. Anything but 0 is a fault of this driver."""
    limited_joints: tuple[str, ...]
    """Joints that the guard held back last."""
    clock_jumps: int


class JointFollower:
    """Executes trajectories, one at a time. Owns no clock: every call says what time it is [ns]."""

    def __init__(
        self,
        *,
        limits: JointLimits,
        start: FloatArray,
        period: float,
        held: Collection[str] = (),
        rules: Rules | None = None,
        stop_deceleration: float = DEFAULT_STOP_DECELERATION,
    ) -> None:
        """Stand still.

        Args:
            limits: Of the joints that are commanded.
            start: Their positions now [rad]. Shape (joints,).
            period: Usual time between two steps [s].
            held: Names of joints that the robot has and that are never moved.
            rules: Limits on messages; may be exchanged later.
            stop_deceleration: Of `stop` [rad/s^2]; may be exchanged later.

        Raises:
            DriverError: ``start_outside_limits``.
        """
        outside = [
            n
            for n, p, a, b in zip(limits.names, start, limits.lower, limits.upper, strict=True)
            if not a <= p <= b
        ]
        if outside:
            raise DriverError(
                "start_outside_limits", f"expected a start within the joint limits; not so: {outside}"
            )
        self.rules = rules or Rules()
        self.stop_deceleration = stop_deceleration
        self._limits = limits
        self._held = held
        self._guard = StepGuard(limits)
        self._clock = PathClock(period)
        self._sent = MotionState.at_rest(np.array(start, dtype=np.float64))
        self._stop: PathStop | None = None
        self._stopping_for = 0.0  # [s]
        self._hold(self._sent.positions)
        self._accepted = 0
        self._refused: Counter[str] = Counter()
        self._last_refusal: TrajectoryError | None = None
        self._limited_steps = 0
        self._limited_joints: tuple[str, ...] = ()

    def step(self, now: int) -> MotionState:
        """Move on to this time and return what is sent to the joints."""
        duration = self._clock.advance(now)
        asked = self._advance(duration)
        if asked.positions is self._sent.positions:  # holding still
            return self._sent
        guarded = self._guard.limit(asked.positions, self._sent.positions, duration)
        if guarded.limited:
            self._limited_steps += 1
            self._limited_joints = guarded.limited
            moved = guarded.positions - self._sent.positions
            velocities = moved / duration if duration > 0.0 else np.zeros_like(moved)
            asked = MotionState(guarded.positions, velocities, np.zeros_like(moved))
        self._sent = asked
        return asked

    def accept(self, message: TrajectoryLike, now: int) -> Trajectory:
        """Take a trajectory in place of the present one, from its start time on.

        Raises:
            TrajectoryError: refused; whatever was going on goes on.
        """
        try:
            trajectory = self._validated(message, now)
        except TrajectoryError as refusal:
            self.count_refusal(refusal)
            raise
        self._accepted += 1
        self._trajectory, self._time, self._activity = trajectory, 0.0, Activity.FOLLOWING
        return trajectory

    def count_refusal(self, refusal: TrajectoryError) -> None:
        """Enter a refusal into the report."""
        self._refused[refusal.code] += 1
        self._last_refusal = refusal

    def stop(self, now: int) -> float:
        """Slow down on the path until the robot stands still, and hold there.

        Returns:
            Time until it stands still [s]; 0 when it holds already.
        """
        self.step(now)
        if self._activity is Activity.FOLLOWING:
            self._stop = PathStop(self._trajectory, self._time, self._limits.velocity, self.stop_deceleration)
            self._stopping_for = 0.0
            self._activity = Activity.STOPPING
        if self._stop is None:
            return 0.0
        return self._stop.duration - self._stopping_for

    def report(self) -> FollowerReport:
        """What has happened, and what goes on."""
        holding = self._activity is Activity.HOLDING
        return FollowerReport(
            activity=self._activity,
            elapsed=0.0 if holding else self._time,
            duration=0.0 if holding else self._trajectory.duration,
            accepted=self._accepted,
            refused=dict(self._refused),
            last_refusal=self._last_refusal,
            limited_steps=self._limited_steps,
            limited_joints=self._limited_joints,
            clock_jumps=self._clock.jumps,
        )

    def _validated(self, message: TrajectoryLike, now: int) -> Trajectory:
        self.step(now)
        if self._activity is Activity.STOPPING:
            raise TrajectoryError(
                Refusal.STOPPING,
                "the robot was told to stop and is not at rest yet: send it again when it is",
            )
        delay, trajectory = validate(
            message,
            limits=self._limits,
            rules=self.rules,
            now=now,
            state_in=self._state_in,
            held=self._held,
        )
        if delay == 0.0:
            return trajectory
        return self._trajectory.cut(self._time, self._time + delay).then(trajectory)

    def _state_in(self, delay: float) -> MotionState:
        if delay == 0.0:
            return self._sent
        return self._trajectory.sample(self._time + delay)

    def _advance(self, duration: float) -> MotionState:
        """Let time pass and return where the joints should be."""
        if self._activity is Activity.HOLDING:
            return self._rest
        if self._stop is not None:
            self._stopping_for += duration
            self._time, rate = self._stop.at(self._stopping_for)
            state = self._trajectory.sample(self._time)
            if rate > 0.0 and self._time < self._trajectory.duration:
                # The path's own acceleration does not matter here: nothing is planned from a stopping robot.
                return MotionState(state.positions, rate * state.velocities, np.zeros_like(state.velocities))
        else:
            self._time += duration
            state = self._trajectory.sample(self._time)
            if self._time < self._trajectory.duration:
                return state
        self._hold(state.positions)
        return self._rest

    def _hold(self, positions: FloatArray) -> None:
        self._rest = MotionState.at_rest(positions)
        self._trajectory, self._time = Trajectory.hold(positions), 0.0
        self._stop = None
        self._activity = Activity.HOLDING
