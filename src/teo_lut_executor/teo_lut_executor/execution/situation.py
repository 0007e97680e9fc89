# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What is known at the moment: the time, where the robot is, what its driver said; may a motion begin?"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from teo_lut_executor.execution.interface import DriverMode, DriverReport, QueueSettings
from teo_motion.trajectory.limits import MotionLimits
from teo_motion.trajectory.ruckig_segment import State

# Below this a joint counts as standing still [rad/s]: TEO's drives estimate speed from encoder counts.
_STILL = 0.01


class RobotState:
    """Keeps the latest position and velocity of each joint, from one publisher of joint states or several."""

    def __init__(self, names: tuple[str, ...]) -> None:
        """Follow some joints; others in the joint states are passed over."""
        self._column = {name: column for column, name in enumerate(names)}
        self._positions = np.full(len(names), np.nan)
        self._velocities = np.zeros(len(names))
        self._seen = np.full(len(names), -np.inf)
        self._still_since = np.inf

    def update(
        self, names: Sequence[str], positions: Sequence[float], velocities: Sequence[float], then: float
    ) -> str:
        """Take a joint state.

        Args:
            names: Its joints.
            positions: [rad], one for each.
            velocities: [rad/s], one for each, or empty: then the joints count as standing still.
            then: When the robot was there [s].

        Returns:
            Why it was not taken; empty if it was.
        """
        if len(positions) != len(names) or len(velocities) not in (0, len(names)):
            return (
                f"expected {len(names)} positions and as many velocities or none, got {len(positions)} and "
                f"{len(velocities)}"
            )
        moves = velocities if len(velocities) else [0.0] * len(names)
        given = [
            (self._column[name], position, velocity)
            for name, position, velocity in zip(names, positions, moves, strict=True)
            if name in self._column
        ]
        if not given:
            return ""
        columns, position, velocity = (np.array(values) for values in zip(*given, strict=True))
        if not (np.isfinite(position).all() and np.isfinite(velocity).all()):
            return "expected finite positions and velocities, got others"
        self._positions[columns] = position
        self._velocities[columns] = np.where(np.abs(velocity) < _STILL, 0.0, velocity)
        self._seen[columns] = then
        if self._velocities.any():
            self._still_since = np.inf
        elif self._still_since == np.inf:
            self._still_since = then
        return ""

    @property
    def complete(self) -> bool:
        """Whether every joint has been heard of."""
        return bool(np.isfinite(self._positions).all())

    @property
    def missing(self) -> tuple[str, ...]:
        """Joints not heard of yet."""
        return tuple(name for name, column in self._column.items() if np.isnan(self._positions[column]))

    @property
    def oldest(self) -> float:
        """When the joint was heard of that has been silent longest [s]; minus infinity if one never was."""
        return float(self._seen.min())

    @property
    def is_still(self) -> bool:
        """Whether no joint moves."""
        return not self._velocities.any()

    def still_since(self, then: float) -> float:
        """How long no joint was seen to move from a time on [s]; less than nothing if one was seen since."""
        return self.oldest - max(self._still_since, then)

    def shift_clock(self, by: float) -> None:
        """Follow a clock that was set by so much [s]."""
        self._seen += by
        self._still_since += by

    def state(self) -> State:
        """Positions and velocities, no acceleration; NaN for joints not heard of."""
        return State.still(self._positions.copy())._replace(velocity=self._velocities.copy())

    def farthest(self, positions: NDArray[np.float64]) -> tuple[float, str]:
        """The greatest distance of a joint from given positions [rad], and which joint."""
        distances = np.abs(self._positions - positions)
        column = int(np.argmax(distances))
        return float(distances[column]), list(self._column)[column]


# A step of the clock larger than this between two calls is a clock that was set, or a process that was not
# running [s]: joint states that came meanwhile have not been read yet, and do not count as stale.
_CLOCK_STEP = 0.2

# A robot's pace counts as steady when the driver has told no other for this long [s]: two of its reports.
_STEADY = 0.2

# What the driver's modes mean for the sentence at hand, by code.
BLOCKED = {
    DriverMode.STOPPED: ("stopped", "the robot was told to stop: re-arm it to go on"),
    DriverMode.INACTIVE: ("driver_inactive", "the driver is not active: activate it to go on"),
    DriverMode.FAULT: ("driver_fault", "the driver reports a fault: mend it and re-arm it to go on"),
}


class Situation:
    """What is known at the moment.

    Attributes:
        limits: Of every joint.
        settings: How patient the executor is.
        now: [s].
        robot: Where it is.
        driver: What it said last, see `hear_driver`; None if nothing yet.
        obstacle: Why no motion may begin, as far as the caller knows; empty if it may.
        clock_set: When the clock was set last [s]; stamps from before it are of another clock.
    """

    def __init__(self, limits: MotionLimits, settings: QueueSettings) -> None:
        """Begin with nothing heard."""
        self.limits = limits
        self.settings = settings
        self.now = -math.inf
        self.robot = RobotState(limits.names)
        self.driver: DriverReport | None = None
        self.obstacle = ""
        self._pace_changed = self.clock_set = -math.inf

    def tick(self, now: float) -> tuple[float, float]:
        """Let time pass; carry on where we are if the clock was set.

        Returns:
            Path time that has passed, or may have if the clock was set, and by how much it was; both [s].
        """
        passed = now - self.now if math.isfinite(self.now) else 0.0
        self.now = now
        is_set = passed < 0.0 or passed > _CLOCK_STEP
        if is_set:
            self.robot.shift_clock(passed)
            self._pace_changed += passed
            self.clock_set = now
        return max(passed, 0.0) * self.pace, passed if is_set else 0.0

    def hear_driver(self, report: DriverReport) -> None:
        """Take what the driver says of itself."""
        before, self.driver = self.pace, report
        if self.pace != before:
            self._pace_changed = self.now

    @property
    def pace(self) -> float:
        """Path time per time [1]."""
        return 1.0 if self.driver is None else self.driver.speed_scaling

    @property
    def mode(self) -> DriverMode | None:
        """What the driver is doing; None if it did not say."""
        return None if self.driver is None else self.driver.mode

    @property
    def block(self) -> tuple[str, str] | None:
        """Code and meaning of the driver's mode if it takes no motion in it."""
        return None if self.mode is None else BLOCKED.get(self.mode)

    @property
    def age(self) -> float:
        """Of the joint state that is oldest [s]."""
        return self.now - self.robot.oldest

    @property
    def is_stale(self) -> bool:
        """Whether nothing is heard any more of a robot that was heard of."""
        return self.robot.complete and self.age > self.settings.joint_state_timeout

    @property
    def at_rest(self) -> bool:
        """Whether every joint is, nearly, as in one of the postures in which a robot waits."""
        humanoid = self.limits.humanoid
        away = min(self.robot.farthest(rest)[0] for rest in (humanoid.hanging, humanoid.ready))
        return away <= self.settings.goal_tolerance

    @property
    def hindrance(self) -> str:
        """What must be there before a motion can begin; empty if all is."""
        if not self.robot.complete:
            names = self.robot.missing
            more = f" and {len(names) - 3} more" if len(names) > 3 else ""
            return f"waiting for joint_states of {', '.join(names[:3])}{more}"
        if self.is_stale:
            return f"the last joint_states came {self.age:.1f} s ago: see that the driver runs"
        if self.mode is DriverMode.PAUSED:
            return "paused"
        if self.block is not None:
            return self.block[1]
        if self.obstacle:
            return self.obstacle
        return "" if self.robot.is_still else "waiting for the robot to stand still"

    @property
    def may_be_told(self) -> bool:
        """Whether the robot is heard, and its driver takes motions."""
        return not self.is_stale and self.block is None and self.mode is not DriverMode.PAUSED

    def clock_time(self, path_time: float) -> float:
        """How long so much path time takes while `may_continue` holds [s]."""
        return path_time / self.pace

    @property
    def may_continue(self) -> bool:
        """Whether it is known when the robot will be where, and the driver would take a motion from there."""
        steady = self.pace > 0.0 and self.now - self._pace_changed >= _STEADY
        return steady and self.may_be_told

    @property
    def may_join(self) -> bool:
        """Whether a sentence may continue another."""
        return self.may_continue and not self.obstacle
