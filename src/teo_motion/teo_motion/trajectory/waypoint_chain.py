# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Joints that go from waypoint to waypoint together."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from teo_common.arrays import Array
from teo_motion.trajectory.ruckig_segment import (
    ROUNDING,
    Bounds,
    RuckigSegment,
    RuckigSolver,
    State,
    relaxed_bounds,
)
from teo_motion.trajectory.waypoint_states import waypoint_states

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
        moving[0] |= bool(start.velocity.any() or start.acceleration.any())
        self.moving = np.flatnonzero(moving)
        self._durations = np.zeros(len(waypoints) - 1)
        self._velocities = np.zeros_like(positions)
        self._accelerations = np.zeros_like(positions)
        # What each segment was when it fitted: state at its begin and end as shares of the limits, duration.
        self._fitted = np.full((len(waypoints) - 1, 4, len(columns)), np.inf)
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

    def to_try(self, *, exact: bool) -> list[int]:
        """Indices of segments that changed since they fitted: by `_CHANGE` or, if `exact`, by anything."""
        change = 0.0 if exact else _CHANGE
        shares = np.abs(self._shares() - self._fitted).max(axis=(1, 2))
        longer = self._durations / np.maximum(self._fitted_durations, 1e-300) - 1.0
        known = (shares <= change) & (np.abs(longer) <= change)
        return [index for index in self.moving.tolist() if not known[index]]

    def fits(self, index: int) -> None:
        """Record the states and duration with which a segment fits, for `to_try`."""
        self._fitted[index] = self._shares()[index]
        self._fitted_durations[index] = self._durations[index]

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

    def duration(self, index: int) -> float:
        """Time that a segment is given [s]."""
        return float(self._durations[index])

    def segment(self, index: int, ease: float | None = None) -> RuckigSegment | None:
        """The segment from a waypoint to the next in its duration, or in the shortest possible above it.

        Args:
            index: The waypoint from which it goes to the next.
            ease: None for the limits themselves, else see `relaxed_bounds`.

        Returns:
            None where the solver finds none.
        """
        begin, end = (
            State(
                position=self.positions[at],
                velocity=self._velocities[at],
                acceleration=self._accelerations[at],
            )
            for at in (index, index + 1)
        )
        bounds = self.bounds
        if ease is not None:
            bounds = relaxed_bounds(begin, end, self.duration(index), bounds, ease=ease)
        return self._solver.segment(begin, end, bounds, duration=self.duration(index))

    def beyond(self, index: int, segment: RuckigSegment) -> NDArray[np.bool_]:
        """Which joints leave the interval between two waypoints by more than `OVERSHOOT`. Shape (m,).

        A joint that leaves its limits is always among them.
        """
        ends = self.positions[index : index + 2]
        lowest = np.maximum(ends.min(axis=0) - OVERSHOOT, self.bounds.lower - ROUNDING)
        highest = np.minimum(ends.max(axis=0) + OVERSHOOT, self.bounds.upper + ROUNDING)
        least, greatest = segment.pieces.range()
        beyond: NDArray[np.bool_] = (least < lowest) | (greatest > highest)
        if index == 0:
            beyond &= self._start.velocity == 0.0  # a joint that moves at the start needs room to turn
        return beyond

    def is_too_fast(self, index: int, segment: RuckigSegment) -> bool:
        """Whether a segment goes beyond the greatest velocity; from the start it may, if the robot does."""
        if index == 0:
            return False
        pieces = segment.pieces
        with np.errstate(divide="ignore", invalid="ignore"):
            peak = -pieces.accelerations / pieces.jerks
        inside = np.isfinite(peak) & (peak > 0.0) & (peak < pieces.lengths)
        times = np.where(inside, peak, 0.0)
        lasting = pieces.lengths > 0.0
        speeds = np.abs(pieces.velocities + times * (pieces.accelerations + times * pieces.jerks / 2.0))
        top = self.bounds.velocity[:, None] * (1.0 + ROUNDING)
        return bool(((speeds > top) & lasting).any())

    def _shares(self) -> Array:
        """Velocities and accelerations at the ends of each segment, over the limits. Shape (n - 1, 4, m)."""
        velocities = self._velocities / self.bounds.velocity
        accelerations = self._accelerations / self.bounds.acceleration
        return np.stack([velocities[:-1], accelerations[:-1], velocities[1:], accelerations[1:]], axis=1)


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
