# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Segments from one state of some joints to another, by Ruckig, behind checks that it lacks.

The community build of Ruckig reads beyond lists that are too short, ignores position limits, and sends
intermediate positions to a web service: this is the only module that calls it, with neither of the two. Its
`position_extrema` (of 0.19.4) misses a joint that turns while its acceleration is constant, so that extremes
are taken from the pieces of the segment here.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
import ruckig

from teo_common.arrays import Array
from teo_motion.trajectory.joint_motion import Extremes, Pieces, take
from teo_signs.errors import PlanError

# A motion may be beyond a position limit by this much, from the rounding of its sums [rad].
ROUNDING = 1e-8

# A segment fits its time when it needs no more than this beyond it [s]: rounding of sums of times.
FITS = 1e-9

# Factors on the least-jerk quintic's acceleration and jerk, the smoothest first [1]; None is the limits.
_EASES = (1.3, 2.0, 4.0, None)

# Least share of the limits that a segment is given: a joint that hardly moves would otherwise get none.
_LEAST_SHARE = 0.02

# A little more jerk than exactly enough [1]: rounding must not make it too little.
_SPARE = 1.01

_SAMPLES = np.linspace(0.0, 1.0, 9)[:, None]


class Bounds(NamedTuple):
    """Limits of one segment: position [rad], velocity [rad/s], acceleration [rad/s^2], jerk [rad/s^3].

    Ruckig keeps the last three. Positions are for whoever calls it to check. Shape (m,) each.
    """

    lower: Array
    upper: Array
    velocity: Array
    acceleration: Array
    jerk: Array

    def allow(self, reached: Extremes) -> bool:
        """Whether motions stay within the limits, up to `ROUNDING`."""
        more = 1.0 + ROUNDING
        return bool(
            np.all(reached.least >= self.lower - ROUNDING)
            and np.all(reached.greatest <= self.upper + ROUNDING)
            and np.all(reached.velocity <= self.velocity * more)
            and np.all(reached.acceleration <= self.acceleration * more)
            and np.all(reached.jerk <= self.jerk * more)
        )

    def of(self, columns: list[int]) -> Bounds:
        """The limits of some of the joints."""
        return Bounds(*(values[columns] for values in self))


class State(NamedTuple):
    """Position [rad], velocity [rad/s] and acceleration [rad/s^2] of joints. Shape (m,) each."""

    position: Array
    velocity: Array
    acceleration: Array

    @classmethod
    def still(cls, position: Array) -> State:
        """A standstill at a position [rad]."""
        zero = np.zeros_like(position)
        return cls(position, zero, zero)

    @property
    def is_still(self) -> bool:
        """Whether no joint moves or begins to."""
        return not (self.velocity.any() or self.acceleration.any())

    def of(self, columns: list[int]) -> State:
        """The state of some of the joints."""
        return State(*(values[columns] for values in self))


class RuckigSegment:
    """A motion of some joints from one state to another, as Ruckig calculated it.

    Attributes:
        trajectory: What it calculated.
        start: State at which it starts.
    """

    def __init__(self, trajectory: ruckig.Trajectory, start: State) -> None:
        """Keep Ruckig's trajectory and the state at which it starts."""
        self.trajectory = trajectory
        self.start = start

    @property
    def duration(self) -> float:
        """How long the segment takes [s]."""
        return float(self.trajectory.duration)

    @property
    def pieces(self) -> Pieces:
        """Row for row the pieces of each joint, in order; some have no length. Shape (m, k)."""
        return take(pieces_of([self]), 0)


class RuckigSolver:
    """Calculates segments of a fixed number of joints that start and end together."""

    def __init__(self, joints: int) -> None:
        """Prepare for segments of so many joints."""
        self._joints = joints
        self._generator = ruckig.Ruckig(joints)
        self._input = ruckig.InputParameter(joints)
        self._bounds: Bounds | None = None  # as given last

    def segment(self, start: State, end: State, bounds: Bounds, *, duration: float) -> RuckigSegment | None:
        """The segment from one state to another in a given duration, or in the shortest possible above it.

        Args:
            start: Where the joints are.
            end: Where they go.
            bounds: Limits, all above 0.
            duration: Least duration [s].

        Returns:
            The segment, or None where the solver finds none.

        Raises:
            PlanError: An array is of the wrong length or holds a number that is not finite ("bad_state").
        """
        given = self._input
        self._begin_at(start, given)
        given.target_position = self._list("end position", end.position)
        given.target_velocity = self._list("end velocity", end.velocity)
        given.target_acceleration = self._list("end acceleration", end.acceleration)
        if bounds is not self._bounds:
            self._keep_to(bounds, given)
            self._bounds = bounds
        given.minimum_duration = duration
        trajectory = ruckig.Trajectory(self._joints)
        try:
            result = self._generator.calculate(given, trajectory)
        except ruckig.RuckigError:
            return None
        found = result in (ruckig.Result.Working, ruckig.Result.Finished)
        return RuckigSegment(trajectory, start) if found else None

    def brake(self, start: State, bounds: Bounds) -> Pieces:
        """How each joint comes to a standstill by itself, as soon as it can.

        Args:
            start: Where the joints are.
            bounds: Limits, all above 0; those of position are not looked at.

        Returns:
            Row for row the pieces of each joint, in order; some have no length. Shape (m, k).

        Raises:
            PlanError: An array is of the wrong length or holds a number that is not finite ("bad_state").
        """
        given = ruckig.InputParameter(self._joints)
        given.control_interface = ruckig.ControlInterface.Velocity
        given.synchronization = ruckig.Synchronization.No
        self._begin_at(start, given)
        self._keep_to(bounds, given)
        trajectory = ruckig.Trajectory(self._joints)
        # To a standstill there is a way from every state: it raises nothing and always finds one.
        self._generator.calculate(given, trajectory)
        return RuckigSegment(trajectory, start).pieces

    def smooth_segments(
        self, begin: State, end: State, bounds: Bounds, *, duration: float
    ) -> Iterator[RuckigSegment]:
        """Segments that take no longer than a duration [s], those of least acceleration and jerk first.

        The last may need all of the bounds.
        """
        for ease in _EASES:
            within = bounds if ease is None else _relaxed_bounds(begin, end, duration, bounds, ease=ease)
            segment = self.segment(begin, end, within, duration=duration)
            if segment is not None and segment.duration <= duration + FITS:
                yield segment

    def _begin_at(self, start: State, given: ruckig.InputParameter) -> None:
        given.current_position = self._list("start position", start.position)
        given.current_velocity = self._list("start velocity", start.velocity)
        given.current_acceleration = self._list("start acceleration", start.acceleration)

    def _keep_to(self, bounds: Bounds, given: ruckig.InputParameter) -> None:
        given.max_velocity = self._list("velocity limit", bounds.velocity, positive=True)
        given.max_acceleration = self._list("acceleration limit", bounds.acceleration, positive=True)
        given.max_jerk = self._list("jerk limit", bounds.jerk, positive=True)

    def _list(self, name: str, values: Array, *, positive: bool = False) -> list[float]:
        if values.shape != (self._joints,):
            raise PlanError("bad_state", f"{name}: expected {self._joints} numbers, got shape {values.shape}")
        numbers: list[float] = values.tolist()
        if not all(map(math.isfinite, numbers)) or (positive and min(numbers) <= 0.0):
            kind = "finite numbers above 0" if positive else "finite numbers"
            raise PlanError("bad_state", f"{name}: expected {kind}, got {numbers}")
        return numbers


def pieces_of(segments: Sequence[RuckigSegment]) -> Pieces:
    """The pieces of each joint of segments of the same joints; some have no length. Shape (n, m, k)."""
    # The brake comes first: what brings a joint that starts beyond its limits back within them.
    numbers: list[float] = []  # in one list, which becomes an array sooner than lists of lists
    for segment in segments:
        for item in segment.trajectory.profiles[0]:
            brake = item.brake
            numbers += brake.t + item.t + brake.p + item.p[:-1] + brake.v + item.v[:-1]
            numbers += brake.a + item.a[:-1] + brake.j + item.j
    begins = np.array([segment.start.position for segment in segments])
    table = np.array(numbers).reshape(*begins.shape, 5, -1)
    lengths, positions, velocities, accelerations, jerks = np.moveaxis(table, 2, 0)
    return Pieces(
        lengths=lengths,
        positions=np.where(lengths > 0.0, positions, begins[..., None]),
        velocities=velocities,
        accelerations=accelerations,
        jerks=jerks,
    )


def _relaxed_bounds(begin: State, end: State, duration: float, bounds: Bounds, *, ease: float) -> Bounds:
    """Bounds a little above what a smooth segment in this time reaches.

    A segment with time to spare would otherwise jump to a low speed, keep it and stop as hard as the limits
    allow. People's hands speed up and slow down over the whole way: the least-jerk quintic of T. Flash and
    N. Hogan (J. Neurosci. 5, 1985) is the measure here.

    Args:
        begin: State at the beginning.
        end: State at the end.
        duration: Time that the segment has [s].
        bounds: Limits, which the result keeps.
        ease: Times the quintic's greatest acceleration and jerk [1].
    """
    distance = end.position - begin.position
    # p(s) = p0 + v0 T s + c3 s^3 + c4 s^4 + c5 s^5 with s = t / T; Ruckig sees to the accelerations.
    reach, swing = distance - begin.velocity * duration, (end.velocity - begin.velocity) * duration
    c3, c4, c5 = 10.0 * reach - 4.0 * swing, -15.0 * reach + 7.0 * swing, 6.0 * reach - 3.0 * swing
    s = _SAMPLES
    acceleration = np.abs(6.0 * c3 * s + 12.0 * c4 * s**2 + 20.0 * c5 * s**3).max(axis=0) / duration**2
    jerk = np.abs(6.0 * c3 + 24.0 * c4 * s + 60.0 * c5 * s**2).max(axis=0) / duration**3
    least_acceleration = _LEAST_SHARE * bounds.acceleration
    least_jerk = _LEAST_SHARE * bounds.jerk
    for state in (begin, end):
        # The joint must be able to end its acceleration below its greatest velocity: v + a^2 / 2 j.
        room = np.maximum(bounds.velocity - np.abs(state.velocity), 1e-9)
        least_jerk = np.maximum(least_jerk, _SPARE * state.acceleration**2 / (2.0 * room))
        least_acceleration = np.maximum(least_acceleration, np.abs(state.acceleration))
    return bounds._replace(
        acceleration=np.minimum(np.maximum(ease * acceleration, least_acceleration), bounds.acceleration),
        jerk=np.minimum(np.maximum(ease * jerk, least_jerk), bounds.jerk),
    )
