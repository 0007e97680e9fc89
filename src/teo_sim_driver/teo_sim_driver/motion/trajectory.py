# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A trajectory ready to be executed: points in the driver's joint order, and what lies between them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from teo_sim_driver.motion.bezier import (
    DEGREE,
    LINEAR,
    QUINTIC,
    FloatArray,
    bernstein,
    control_points,
    derivative,
)

# Points that are nearer in time become one [s]: at the greatest speed a joint moves 1e-6 rad meanwhile, far
# below an encoder's count, and shorter segments would lose their curve to rounding.
SAME_TIME = 1e-6


class MotionState(NamedTuple):
    """Where the joints are and how they move. Shape (joints,) each."""

    positions: FloatArray
    """[rad]"""
    velocities: FloatArray
    """[rad/s]"""
    accelerations: FloatArray
    """[rad/s^2]"""

    @staticmethod
    def at_rest(positions: FloatArray) -> MotionState:
        """Stand still at these positions [rad]."""
        still = np.zeros_like(positions)
        still.flags.writeable = False
        return MotionState(positions, still, still)

    def at_pace(self, rate: float, change: float) -> MotionState:
        """The same place on a path whose own time passes otherwise.

        Args:
            rate: Path time per time.
            change: Of the rate [1/s].
        """
        return MotionState(
            self.positions,
            rate * self.velocities,
            rate**2 * self.accelerations + change * self.velocities,
        )

    def of_joints(self, columns: NDArray[np.intp]) -> MotionState:
        """The same for some of the joints."""
        return MotionState(*(values[columns] for values in self))


@dataclass(frozen=True, eq=False)
class Trajectory:
    """Points in time and a polynomial between each two; before the first and after the last it stands still.

    Attributes:
        times: Of the points, from the first, which is at 0 [s]. Shape (n,), strictly increasing.
        positions: [rad]. Shape (n, joints).
        velocities: [rad/s]; not read next to a linear segment. Shape (n, joints).
        accelerations: [rad/s^2]; read only next to a quintic segment. Shape (n, joints).
        degrees: Of each joint's polynomial in each segment: 1, 3 or 5. Shape (n - 1, joints).
    """

    times: FloatArray
    positions: FloatArray
    velocities: FloatArray
    accelerations: FloatArray
    degrees: NDArray[np.int8]

    def __post_init__(self) -> None:
        for array in (self.times, self.positions, self.velocities, self.accelerations, self.degrees):
            array.flags.writeable = False

    @property
    def duration(self) -> float:
        """Time of the last point [s]."""
        return float(self.times[-1])

    def sample(self, time: float) -> MotionState:
        """Evaluate the trajectory; outside its duration, its end points at rest.

        Args:
            time: From the first point [s].
        """
        if time >= self.times[-1]:
            return MotionState.at_rest(self.positions[-1])
        if time < 0.0:
            return MotionState.at_rest(self.positions[0])
        i = int(np.searchsorted(self.times, time, side="right")) - 1
        span = slice(i, i + 1)
        control = self.position_control(span)[:, 0]
        duration = float(self.times[i + 1] - self.times[i])
        fraction = (time - float(self.times[i])) / duration
        slopes = control[1:] - control[:-1]
        bends = slopes[1:] - slopes[:-1]
        return MotionState(
            # From the first point on, so that a joint that stands still does so to the last digit.
            control[0] + bernstein(DEGREE, fraction)[1:] @ (control[1:] - control[0]),
            bernstein(DEGREE - 1, fraction) @ slopes * (DEGREE / duration),
            bernstein(DEGREE - 2, fraction) @ bends * (DEGREE * (DEGREE - 1) / duration**2),
        )

    def states(self, times: FloatArray) -> MotionState:
        """Evaluate the trajectory at many times at once.

        Args:
            times: From the first point [s]. Shape (m,).

        Returns:
            Shape (m, joints) each.
        """
        last = len(self.times) - 1
        inside = (times >= 0.0) & (times < self.times[-1])
        ends = np.where((times < 0.0)[:, None], self.positions[0], self.positions[-1])
        positions, velocities, accelerations = ends, np.zeros_like(ends), np.zeros_like(ends)
        i = np.searchsorted(self.times, times[inside], side="right") - 1
        control = self.position_control(slice(0, last))[:, i]
        duration = np.diff(self.times)[i]
        fraction = (times[inside] - self.times[i]) / duration
        for order, values in enumerate((positions, velocities, accelerations)):
            weights = bernstein(DEGREE - order, fraction)
            scale = math.perm(DEGREE, order) / duration**order
            values[inside] = np.einsum("km,kmj->mj", weights * scale, np.diff(control, order, axis=0))
        return MotionState(positions, velocities, accelerations)

    def durations(self, segments: slice) -> FloatArray:
        """Durations of some segments [s]."""
        points = slice(segments.start, segments.stop + 1)
        return np.diff(self.times[points])

    def position_control(self, segments: slice) -> FloatArray:
        """Bezier control points of some segments [rad]. Shape (6, segments, joints)."""
        points = slice(segments.start, segments.stop + 1)
        return control_points(
            self.durations(segments),
            self.degrees[segments],
            self.positions[points],
            self.velocities[points],
            self.accelerations[points],
        )

    def velocity_control(self, segments: slice) -> FloatArray:
        """Bezier control points of the velocity of some segments [rad/s]. Shape (5, segments, joints)."""
        return derivative(self.position_control(segments), self.durations(segments))

    def segments_within(self, start: float, end: float) -> slice:
        """Segments that overlap a span of time [s]; empty after the end of the trajectory."""
        last = len(self.times) - 1
        first = int(np.searchsorted(self.times, start, side="right")) - 1
        stop = int(np.searchsorted(self.times, end, side="left"))
        return slice(min(max(first, 0), last), min(stop, last))

    def of_joints(self, columns: NDArray[np.intp]) -> Trajectory:
        """The same for some of the joints."""
        return Trajectory(
            self.times,
            self.positions[:, columns],
            self.velocities[:, columns],
            self.accelerations[:, columns],
            self.degrees[:, columns],
        )

    def cut(self, start: float, end: float) -> Trajectory:
        """Take the part between two times [s], standing still after the last point.

        Args:
            start: At least 0.
            end: Later than the start, by more than `SAME_TIME`.
        """
        first_inside = int(np.searchsorted(self.times, start + SAME_TIME, side="right"))
        first_after = int(np.searchsorted(self.times, end - SAME_TIME, side="left"))
        inside = slice(first_inside, max(first_inside, first_after))
        first, last = self.sample(start), self.sample(end)
        if self.times[-1] <= end <= self.times[-1] + SAME_TIME:
            # The curve arrives with its own derivatives; at rest it is from then on.
            last = MotionState(self.positions[-1], self.velocities[-1], self.accelerations[-1])
        # Splitting a polynomial leaves it the same polynomial, so the cut segments keep their degrees.
        degrees = self.degrees[max(inside.start - 1, 0) : inside.stop]
        if inside.stop == len(self.times):
            still = np.full((1, degrees.shape[1]), LINEAR, np.int8)
            degrees = np.concatenate([degrees[: inside.stop - inside.start], still])
        return Trajectory(
            np.concatenate([[0.0], self.times[inside] - start, [end - start]]),
            np.concatenate([first.positions[None], self.positions[inside], last.positions[None]]),
            np.concatenate([first.velocities[None], self.velocities[inside], last.velocities[None]]),
            np.concatenate([first.accelerations[None], self.accelerations[inside], last.accelerations[None]]),
            degrees,
        )

    def then(self, following: Trajectory) -> Trajectory:
        """This trajectory and, from its last point on, another one that begins where this one ends."""
        return Trajectory(
            np.concatenate([self.times[:-1], following.times + self.times[-1]]),
            np.concatenate([self.positions[:-1], following.positions]),
            np.concatenate([self.velocities[:-1], following.velocities]),
            np.concatenate([self.accelerations[:-1], following.accelerations]),
            np.concatenate([self.degrees, following.degrees]),
        )

    @staticmethod
    def quintic(
        times: FloatArray, positions: FloatArray, velocities: FloatArray, accelerations: FloatArray
    ) -> Trajectory:
        """A trajectory whose points give everything; arguments as the attributes."""
        degrees = np.full((len(times) - 1, positions.shape[1]), QUINTIC, np.int8)
        return Trajectory(times, positions, velocities, accelerations, degrees)

    @staticmethod
    def hold(positions: FloatArray) -> Trajectory:
        """A trajectory of one point: stand still there [rad]."""
        still = np.zeros((1, len(positions)))
        degrees = np.zeros((0, len(positions)), np.int8)
        return Trajectory(np.zeros(1), np.array(positions)[None], still, still.copy(), degrees)
