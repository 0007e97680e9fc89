# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the joints are to do, and who commands which of them: the newest wins, joint by joint."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from teo_sim_driver.follower_report import Source
from teo_sim_driver.motion.bezier import LINEAR, FloatArray
from teo_sim_driver.motion.path_time import Braking, PathPace, fastest_ahead
from teo_sim_driver.motion.trajectory import SAME_TIME, MotionState, Trajectory

# Time between the points of a stop [s]: a step of the driver.
_STEP = 0.01


class _Part(NamedTuple):
    """What some of the joints do."""

    columns: NDArray[np.intp]
    """Which joints. Shape (m,)."""
    trajectory: Trajectory
    """Of these joints, from the same moment on as the other parts; afterwards they stand still."""


def _side_by_side(parts: Sequence[_Part]) -> Trajectory:
    """Bring parts together, each of which goes on exactly as it would alone.

    A polynomial that is split at a point remains the same polynomial, so that points of one part are put into
    the others without changing them.

    Args:
        parts: Their columns are all the joints, each once.
    """
    if len(parts) == 1:
        return parts[0].trajectory
    times = np.unique(np.concatenate([part.trajectory.times for part in parts]))
    times = times[np.concatenate([[True], np.diff(times) > SAME_TIME])]
    joints = sum(len(part.columns) for part in parts)
    positions, velocities, accelerations = np.empty((3, len(times), joints))
    degrees = np.empty((len(times) - 1, joints), np.int8)
    for columns, alone in parts:
        own = np.searchsorted(times, alone.times, side="right") - 1
        segment = np.searchsorted(own, np.arange(len(times)), side="right") - 1
        inside = segment < len(alone.times) - 1
        for table, sampled, given in zip(
            (positions, velocities, accelerations),
            alone.states(times),
            (alone.positions, alone.velocities, alone.accelerations),
            strict=True,
        ):
            sampled[own] = given
            table[:, columns] = sampled
        still = np.full((len(times) - 1, len(columns)), LINEAR, np.int8)
        still[inside[:-1]] = alone.degrees[segment[:-1][inside[:-1]]]
        degrees[:, columns] = still
    return Trajectory(times, positions, velocities, accelerations, degrees)


@dataclass(eq=False)
class Command:
    """A trajectory from its acceptance to its end.

    Attributes:
        columns: Which joints it is about. Shape (m,).
        source: How it came.
        group: Of joints, whose topic or action it came by; empty for the whole body.
        end: When it ends, in path time [s].
        over: Whether it has ended, in one way or the other.
        preempted_by: The command that took joints of it, if one did.
    """

    columns: NDArray[np.intp]
    source: Source
    group: str
    end: float = np.inf
    over: bool = False
    preempted_by: Command | None = None

    @property
    def name(self) -> str:
        """For people, such as ``left_arm action``."""
        return f"{self.group} {self.source}".strip()


class CommandedPath:
    """One trajectory of all joints, made of what the commands ask for, and a place on it."""

    def __init__(self, positions: FloatArray, limits: FloatArray) -> None:
        """Stand still, commanded by nobody.

        Args:
            positions: [rad]. Shape (joints,).
            limits: Velocity limit of each joint [rad/s]. Shape (joints,).
        """
        self._limits = limits
        self.commands: tuple[Command, ...] = ()
        """What is being executed, the oldest first; no joint has more than one."""
        self.hold(positions)

    def hold(self, positions: FloatArray) -> None:
        """Stand still here [rad], and end every command."""
        self.trajectory, self.time = Trajectory.hold(positions), 0.0
        self._end_until(np.inf)

    def sample(self, ahead: float) -> MotionState:
        """Where the joints are to be so much path time from now [s]."""
        return self.trajectory.sample(self.time + ahead)

    def advance(self, passed: float) -> MotionState:
        """Let path time pass [s], and return where the joints are to be."""
        self.time += passed
        state = self.sample(0.0)
        self._end_until(self.time)
        return state

    def take(self, trajectory: Trajectory, command: Command, ahead: float, braking: Braking) -> None:
        """Let a command's joints do this instead of what they do at present.

        A command that loses joints to it is over: the joints that it keeps slow down on their path and hold.

        Args:
            trajectory: Of the command's joints, from where they are to be when it begins.
            command: Begins now; its end is set.
            ahead: Path time from now until the trajectory begins [s].
            braking: What slowing down may add.
        """
        start = self.time + ahead
        parts = [self._until(start, command.columns, trajectory)]
        for old in self.commands:
            left = np.setdiff1d(old.columns, command.columns)
            if len(left) == len(old.columns):
                continue
            old.over, old.preempted_by = True, command
            if len(left):
                parts.append(self._until(start, left, self._slowed_down(left, start, braking)))
        command.end = start + trajectory.duration
        self.commands = (*(old for old in self.commands if not old.over), command)
        self._replace(parts)

    def slow_down(self, command: Command, braking: Braking | None) -> float:
        """Let a command's joints stop on their path while others go on.

        Args:
            command: Is over when they stand still.
            braking: What slowing down may add; None if they stand still already.

        Returns:
            Path time until they stand still [s].
        """
        if braking is None:
            slower = Trajectory.hold(self.sample(0.0).positions[command.columns])
        else:
            slower = self._slowed_down(command.columns, self.time, braking)
        command.end = self.time + slower.duration
        self._replace([_Part(command.columns, slower)])
        return slower.duration

    def _until(self, start: float, columns: NDArray[np.intp], following: Trajectory) -> _Part:
        """What some joints do at present until a moment on the path [s], and a trajectory after it."""
        if start - self.time > SAME_TIME:
            following = self.trajectory.of_joints(columns).cut(self.time, start).then(following)
        return _Part(columns, following)

    def _slowed_down(self, columns: NDArray[np.intp], start: float, braking: Braking) -> Trajectory:
        """What some joints do from a moment on the path [s] until they stand still on it."""
        trajectory = self.trajectory.of_joints(columns)
        pace = PathPace()
        pace.turn(0.0, fastest_ahead(trajectory, start, self._limits[columns], braking), braking)
        steps = math.ceil(pace.remaining / _STEP)
        here = trajectory.sample(start)
        if steps == 0:
            return Trajectory.hold(here.positions)
        times = np.linspace(0.0, pace.remaining, steps + 1)
        place = start
        rows = [here]
        for duration in np.diff(times):
            place += pace.advance(float(duration))
            rows.append(trajectory.sample(place).at_pace(pace.rate, pace.acceleration))
        positions, velocities, accelerations = (np.array(values) for values in zip(*rows, strict=True))
        velocities[-1] = accelerations[-1] = 0.0
        return Trajectory.quintic(times, positions, velocities, accelerations)

    def _replace(self, parts: list[_Part]) -> None:
        """Go on with these, and beside them with what the other joints do at present."""
        others = np.setdiff1d(np.arange(len(self._limits)), np.concatenate([part.columns for part in parts]))
        if len(others):
            present, end = self.trajectory.of_joints(others), self.trajectory.duration
            rest = (
                present.cut(self.time, end)
                if end - self.time > SAME_TIME
                else Trajectory.hold(present.positions[-1])
            )
            parts = [*parts, _Part(others, rest)]
        self.trajectory = _side_by_side(parts)
        for command in self.commands:
            command.end -= self.time
        self.time = 0.0

    def _end_until(self, time: float) -> None:
        for command in self.commands:
            command.over = command.end <= time
        self.commands = tuple(command for command in self.commands if not command.over)
