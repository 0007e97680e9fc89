# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Joints that go from waypoint to waypoint together, and how fast they pass each."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from teo_common.arrays import Array
from teo_motion.trajectory.joint_motion import Pieces
from teo_motion.trajectory.ruckig_segment import (
    ROUNDING,
    Bounds,
    RuckigSegment,
    RuckigSolver,
    State,
)

# While times are looked for, a segment that fitted is tried again only when the velocity or acceleration at
# its ends has changed by more than this share of their limits, or its duration by more than this share [1].
_CHANGE = 1e-3

# A joint may leave the interval between two knots by this much where it turns [rad]: about 1 deg, 3 mm at the
# hand of a bent arm. Where it would go further, the knots are passed more slowly.
OVERSHOOT = 0.02

# A knot this near to a limit is on it [rad]: entries of the look-up table keep six decimals.
_ON_LIMIT = 1e-6


class WaypointChain:
    """Joints that are fixed at the same waypoints.

    Attributes:
        columns: Which joints.
        waypoints: Where they are fixed. Shape (n,).
        positions: Positions there [rad]. Shape (n, m).
        bounds: Limits of the joints.
        moving: Indices of the waypoints from which any of the joints moves to the next.
    """

    def __init__(
        self, columns: list[int], waypoints: NDArray[np.intp], positions: Array, start: State, bounds: Bounds
    ) -> None:
        """Describe a chain; `start` is the state at the first waypoint."""
        self.columns = columns
        self.waypoints = waypoints
        self.positions = positions
        self.bounds = bounds
        self._start = start
        self._solver = RuckigSolver(len(columns))
        # Factor on the velocity at each waypoint. A joint on its limit can only stand there.
        inside = (positions > bounds.lower + _ON_LIMIT) & (positions < bounds.upper - _ON_LIMIT)
        self._brake = inside.astype(np.float64)
        moving = (np.diff(positions, axis=0) != 0.0).any(axis=1)
        moving[0] |= not start.is_still
        self.moving = np.flatnonzero(moving)
        self._durations = np.zeros(len(waypoints) - 1)
        self._velocities = np.zeros_like(positions)
        self._accelerations = np.zeros_like(positions)
        # What each segment was when it fitted: state at its begin and end as shares of the limits, duration.
        self._fitted = np.full((len(waypoints) - 1, 4, len(columns)), np.inf)
        self._shares = np.zeros_like(self._fitted)
        self._fitted_durations = np.zeros(len(waypoints) - 1)

    def pass_at(self, times: Array) -> None:
        """Find how the joints pass their waypoints, if these are reached at the given times [s]."""
        when = times[self.waypoints]
        self._durations = np.diff(when)
        velocities, accelerations = waypoint_states(when, self.positions, self._brake, swing=OVERSHOOT)
        velocities[0], accelerations[0] = self._start.velocity, self._start.acceleration
        top = self.bounds.velocity
        velocities = np.clip(velocities, -top, top)
        # A joint that passes near its greatest velocity must have room to stop accelerating: v + a^2 / 2 j.
        room = np.sqrt(2.0 * self.bounds.jerk * np.maximum(top - np.abs(velocities), 0.0))
        most = np.minimum(0.99 * room, self.bounds.acceleration)
        accelerations[1:] = np.clip(accelerations, -most, most)[1:]
        self._velocities, self._accelerations = velocities, accelerations
        # The same at both ends of each segment, over the limits.
        fast, hard = velocities / top, accelerations / self.bounds.acceleration
        self._shares = np.stack([fast[:-1], hard[:-1], fast[1:], hard[1:]], axis=1)

    def to_try(self, *, exact: bool) -> list[int]:
        """Indices of segments that changed since they fitted: by `_CHANGE` or, if `exact`, by anything."""
        change = 0.0 if exact else _CHANGE
        shares = np.abs(self._shares - self._fitted).max(axis=(1, 2))
        longer = self._durations / np.maximum(self._fitted_durations, 1e-300) - 1.0
        known = (shares <= change) & (np.abs(longer) <= change)
        return [index for index in self.moving.tolist() if not known[index]]

    def fit(self, indices: list[int]) -> None:
        """Record the states and durations with which segments fit, for `to_try`."""
        self._fitted[indices] = self._shares[indices]
        self._fitted_durations[indices] = self._durations[indices]

    def slow(self, index: int, joints: NDArray[np.bool_] | slice, factor: float) -> None:
        """Pass both ends of a segment more slowly, by a factor."""
        self._brake[index, joints] *= factor
        self._brake[index + 1, joints] *= factor

    def is_single(self, index: int) -> bool:
        """Whether a segment passes no waypoint of other joints."""
        return bool(self.waypoints[index + 1] - self.waypoints[index] == 1)

    def is_rest_to_rest(self, index: int) -> bool:
        """Whether a segment begins and ends at a standstill."""
        return not self._velocities[index : index + 2].any()

    def segment(self, index: int) -> RuckigSegment | None:
        """The segment from a waypoint to the next in its duration, or in the shortest possible above it.

        Returns:
            None where the solver finds none.
        """
        return self._solver.segment(*self._ends(index), self.bounds, duration=float(self._durations[index]))

    def smooth_segments(self, index: int) -> Iterator[RuckigSegment]:
        """Segments from a waypoint to the next in its duration: see `RuckigSolver.smooth_segments`."""
        return self._solver.smooth_segments(
            *self._ends(index), self.bounds, duration=float(self._durations[index])
        )

    def _ends(self, index: int) -> tuple[State, State]:
        """States at a waypoint and at the next."""
        begin, end = (
            State(self.positions[at], self._velocities[at], self._accelerations[at])
            for at in (index, index + 1)
        )
        return begin, end

    def to_slow(self, indices: list[int], pieces: Pieces) -> NDArray[np.bool_]:
        """Which joints have to pass the waypoints of segments more slowly. Shape (n, m).

        Those that leave the interval between the two by more than `OVERSHOOT`, or their limits; all of a
        segment that goes beyond the greatest velocity. From the start a joint may do both: one that moves
        there needs room to turn, and may be too fast already.

        Args:
            indices: Of the waypoints from which the segments leave. Length n.
            pieces: Of the segments. Shape (n, m, k).
        """
        ends = np.stack((self.positions[:-1], self.positions[1:]))[:, indices]
        lowest = np.maximum(ends.min(axis=0) - OVERSHOOT, self.bounds.lower - ROUNDING)
        highest = np.minimum(ends.max(axis=0) + OVERSHOOT, self.bounds.upper + ROUNDING)
        least, greatest = pieces.range()
        slow: NDArray[np.bool_] = (least < lowest) | (greatest > highest)
        speeds = np.abs(pieces.after(pieces.peaks())[1])
        top = self.bounds.velocity[:, None] * (1.0 + ROUNDING)
        too_fast = ((speeds > top) & (pieces.lengths > 0.0)).any(axis=(1, 2))
        starting = np.array(indices) == 0
        slow[starting] &= self._start.velocity == 0.0
        slow[too_fast & ~starting] = True
        return slow


def waypoint_chains(targets: Array, start: State, bounds: Bounds) -> tuple[WaypointChain, ...]:
    """Group joints by the waypoints at which they are fixed.

    Args:
        targets: Positions [rad], NaN where a joint is free; first and last row without NaN. Shape (n, m).
        start: State of the m joints at the first waypoint.
        bounds: Limits of the m joints.
    """
    fixed = ~np.isnan(targets)
    never_moves = (fixed & (targets != targets[0])).sum(axis=0) == 0
    never_moves &= (start.velocity == 0.0) & (start.acceleration == 0.0)
    patterns: dict[bytes, list[int]] = {}
    for column in range(targets.shape[1]):
        # Joints that stand still throughout cost nothing in a chain of their own.
        pattern = b"" if never_moves[column] else fixed[:, column].tobytes()
        patterns.setdefault(pattern, []).append(column)
    chains = []
    for columns in patterns.values():
        waypoints = np.flatnonzero(fixed[:, columns].all(axis=1))
        positions = targets[waypoints][:, columns]
        chains.append(WaypointChain(columns, waypoints, positions, start.of(columns), bounds.of(columns)))
    return tuple(chains)


# A cubic between two knots is monotone if its end slopes are at most three times the chord's: C. de Boor and
# B. Swartz, "Piecewise monotone interpolation" (J. Approx. Theory 21, 1977).
_MONOTONE = 3.0

# Where a joint turns back, its velocity at the knot is at most the slower chord's: it turns a little before
# or after the knot, as hands do, instead of stopping dead in it.
_TURNING = 1.0

# A cubic between two equal knots that begins with velocity v swings out by at most v h / 4 with the step h.
_SWING = 4.0


def waypoint_states(times: Array, positions: Array, brake: Array, *, swing: float) -> tuple[Array, Array]:
    """How joints pass their knots: as a smooth spline does that hardly leaves their interval.

    Velocities are those of the cubic spline with continuous acceleration, which follows densely recorded
    motion with the least jerk; where that spline would swing out far between two knots, its velocity is
    limited there, and a joint that stands still before or after a knot has none.

    Args:
        times: Times of the knots [s], strictly increasing. Shape (n,), n >= 2.
        positions: Positions [rad]. Shape (n, m).
        brake: Factor on the velocity of each knot, 0 to 1. Shape (n, m).
        swing: How far a joint may leave the interval between two knots [rad].

    Returns:
        Velocities [rad/s] and accelerations [rad/s^2]; zero at the first and last knot. Shape (n, m) each.
    """
    steps = np.diff(times)[:, None]
    chords = np.diff(positions, axis=0) / steps
    bound = np.zeros_like(positions)
    before, after = chords[:-1], chords[1:]
    slower = np.minimum(np.abs(before), np.abs(after))
    bound[1:-1] = np.where(before * after > 0.0, _MONOTONE, _TURNING) * slower
    # Among dense knots the spline is to be trusted: it cannot swing out far.
    bound[1:-1] = np.maximum(bound[1:-1], _SWING * swing / np.maximum(steps[:-1], steps[1:]))
    bound[1:-1] *= (before != 0.0) & (after != 0.0)
    bound *= brake

    fixed = bound == 0.0
    velocities = _spline(steps, chords, fixed, np.zeros_like(positions))
    limited = np.abs(velocities) > bound
    if (limited & ~fixed).any():
        # A second spline through the limited knots: their neighbours must know how they are passed.
        velocities = _spline(steps, chords, fixed | limited, np.clip(velocities, -bound, bound))
        velocities = np.clip(velocities, -bound, bound)

    from_left = np.zeros_like(positions)
    from_right = np.zeros_like(positions)
    from_left[1:] = (2.0 * velocities[:-1] + 4.0 * velocities[1:] - 6.0 * chords) / steps
    from_right[:-1] = (6.0 * chords - 4.0 * velocities[:-1] - 2.0 * velocities[1:]) / steps
    # The two sides agree where the spline is free; elsewhere the lesser one is safe for both, if they agree
    # on the direction.
    lesser = np.where(np.abs(from_left) < np.abs(from_right), from_left, from_right)
    accelerations = np.where((from_left * from_right > 0.0) & (bound > 0.0), lesser, 0.0)
    return velocities, accelerations


def _spline(steps: Array, chords: Array, fixed: NDArray[np.bool_], values: Array) -> Array:
    """Knot velocities of a cubic spline with continuous acceleration, some of them given.

    Solves, for each free knot i, v[i-1]/h[i-1] + 2 (1/h[i-1] + 1/h[i]) v[i] + v[i+1]/h[i] =
    3 (c[i-1]/h[i-1] + c[i]/h[i]) with steps h and chords c, by elimination (L. H. Thomas) for all joints at
    once. The first and the last knot must be fixed.
    """
    count = len(values)
    inverse = 1.0 / steps
    below = np.zeros_like(values)
    above = np.zeros_like(values)
    below[1:-1] = inverse[:-1]
    above[1:-1] = inverse[1:]
    middle = 2.0 * (below + above)
    right = np.zeros_like(values)
    right[1:-1] = 3.0 * (chords[:-1] * inverse[:-1] + chords[1:] * inverse[1:])
    below[fixed] = 0.0
    above[fixed] = 0.0
    middle[fixed] = 1.0
    right[fixed] = values[fixed]
    for index in range(1, count):
        factor = below[index] / middle[index - 1]
        middle[index] -= factor * above[index - 1]
        right[index] -= factor * right[index - 1]
    found = np.empty_like(values)
    found[-1] = right[-1] / middle[-1]
    for index in range(count - 2, -1, -1):
        found[index] = (right[index] - above[index] * found[index + 1]) / middle[index]
    return found
