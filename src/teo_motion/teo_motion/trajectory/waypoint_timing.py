# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""When the robot can be at each waypoint, and how its joints move from one to the next.

Each joint goes from one waypoint at which it is fixed to the next by a segment of Ruckig, and need not stop
where it goes on. Where a joint needs longer than recorded, all joints take longer: a stroke of a sign is
slowed evenly, so that its rhythm stays, while holds and other strokes keep their time.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from teo_common.arrays import Array
from teo_motion.trajectory.joint_motion import JointMotion, JointMotionBuilder, take
from teo_motion.trajectory.ruckig_segment import FITS, Bounds, RuckigSegment, State
from teo_motion.trajectory.waypoint_chain import WaypointChain, waypoint_chains
from teo_signs.errors import PlanError

# No two waypoints are closer than this [s]: a twentieth of the time between two set-points of TEO's drives.
LEAST_STEP = 1e-3

# Most by which a stroke is stretched in one round of the search [1]: how the knots are passed is found anew
# before it is stretched further, so that a first guess that passes them badly does not make it too slow.
_PATIENT_STRETCH = 1.15

# How fast the stretch of a step fades in the steps beside it [s]: a fraction of a stroke of a hand.
# Without it a sign would change pace from knot to knot; an even stretch would slow it all for one instant.
_NEAR = 0.1

# Factor on the time that a segment asks for [1]: the states at its ends change with the times, and it would
# ask again in every round without it.
_SPARE = 1.01

# After so many rounds, whatever still does not fit is passed at a standstill, which always ends the search.
_PATIENT_ROUNDS = 25
_ROUNDS = 60


class WaypointTiming:
    """Times the waypoints of one motion."""

    def __init__(
        self, targets: Array, nominal: Array, strokes: NDArray[np.intp], start: State, bounds: Bounds
    ) -> None:
        """Prepare a motion.

        Args:
            targets: Positions [rad], NaN where a joint is free; first and last row without NaN. Shape (n, m).
            nominal: Least time from each waypoint to the next [s]. Shape (n - 1,).
            strokes: Number of the stroke of each step from waypoint to waypoint, ascending. Shape (n - 1,).
            start: State at the first waypoint; its position is the first row of `targets`.
            bounds: Limits of the m joints.
        """
        self._joints = targets.shape[1]
        self._durations = np.maximum(nominal, LEAST_STEP)
        self._strokes = strokes
        self._chains = waypoint_chains(targets, start, bounds)
        self._wanted = np.zeros(len(nominal))  # logarithm of the factor for each step
        # Segments to the very next waypoint first: one that passes waypoints may have time enough then.
        for single in (True, False):
            for chain in self._chains:
                least = np.abs(np.diff(chain.positions, axis=0)) / chain.bounds.velocity
                for index, needed in enumerate(least.max(axis=1).tolist()):
                    if chain.is_single(index) == single:
                        self._want(chain, index, needed)
            self._durations *= np.exp(self._wanted)
            self._wanted[:] = 0.0

    @property
    def times(self) -> Array:
        """When each waypoint is reached, as far as known [s]. Shape (n,)."""
        return np.concatenate(([0.0], np.cumsum(self._durations)))

    def solve(self) -> None:
        """Find times at which every segment is possible within its bounds.

        Raises:
            PlanError: No times are found ("no_timing"); no input is known for which this happens.
        """
        exact = False
        for round_number in range(_ROUNDS):
            patient = round_number < _PATIENT_ROUNDS
            times = self.times
            changed = False
            for chain in self._chains:
                chain.pass_at(times)
            for single in (True, False):
                for chain in self._chains:
                    for index in chain.to_try(exact=exact):
                        if chain.is_single(index) == single:
                            changed |= self._try(chain, index, patient=patient)
                if self._wanted.any():
                    break  # segments that pass waypoints may fit once these have more time
            changed |= self._stretch()
            if exact and not changed:
                return
            exact = not changed
        raise PlanError("no_timing", f"expected times that fit within {_ROUNDS} rounds, got none")

    def motions(self, *, begin: float, end: float) -> tuple[JointMotion, ...]:
        """The motion of every joint, in the order of the columns; after `solve`.

        Args:
            begin: When to leave the first waypoint [s]; before, the joints stand there.
            end: When the motions end [s], at or after the last waypoint, where the joints stay.
        """
        times = self.times + begin
        builders = [JointMotionBuilder() for _ in range(self._joints)]
        for chain in self._chains:
            if begin > 0.0:
                for column, position in zip(chain.columns, chain.positions[0].tolist(), strict=True):
                    builders[column].hold(0.0, position)
            moving = set(chain.moving.tolist())
            for index in range(len(chain.waypoints) - 1):
                leave = float(times[chain.waypoints[index]])
                if index in moving:
                    pieces = self._final_segment(chain, index).pieces
                    for row, column in enumerate(chain.columns):
                        builders[column].add(leave, take(pieces, row))
                elif index == 0 or index - 1 in moving:  # else the joints stand still already
                    for column, position in zip(chain.columns, chain.positions[index].tolist(), strict=True):
                        builders[column].hold(leave, position)
            for column, position in zip(chain.columns, chain.positions[-1].tolist(), strict=True):
                builders[column].hold(float(times[-1]), position)
        return tuple(builder.build(end) for builder in builders)

    def _want(self, chain: WaypointChain, index: int, needed: float, *, most: float = math.inf) -> bool:
        """Ask for the time that a segment needs, at most by a factor at once; whether it has too little."""
        under = slice(chain.waypoints[index], chain.waypoints[index + 1])
        given = float(self._durations[under].sum())
        if needed <= given + FITS:
            return False
        spare = 1.0 if chain.is_rest_to_rest(index) else _SPARE
        self._wanted[under] = np.maximum(self._wanted[under], math.log(min(spare * needed / given, most)))
        return True

    def _stretch(self) -> bool:
        """Give the steps what their segments asked for, and part of it to the steps near them in a stroke."""
        wanted = self._wanted
        if not wanted.any():
            return False
        apart = (self._durations[:-1] + self._durations[1:]) / 2.0
        fading = np.exp(-apart / _NEAR) * (self._strokes[1:] == self._strokes[:-1])
        for index in range(1, len(wanted)):
            wanted[index] = max(wanted[index], wanted[index - 1] * fading[index - 1])
        for index in range(len(wanted) - 2, -1, -1):
            wanted[index] = max(wanted[index], wanted[index + 1] * fading[index])
        self._durations *= np.exp(wanted)
        wanted[:] = 0.0
        return True

    def _try(self, chain: WaypointChain, index: int, *, patient: bool) -> bool:
        """Try a segment; if it does not fit, ask for time or slow its ends down. True if anything changed."""
        slower = 0.5 if patient else 0.0
        segment = chain.segment(index)
        if segment is None:
            if chain.is_rest_to_rest(index):
                raise PlanError("no_timing", "expected a segment from rest to rest, got none")
            chain.slow(index, slice(None), slower)
            return True
        if self._want(chain, index, segment.duration, most=_PATIENT_STRETCH if patient else math.inf):
            if not patient:
                chain.slow(index, slice(None), slower)
            return True
        beyond = chain.beyond(index, segment)
        if chain.is_too_fast(index, segment):
            beyond[:] = True
        if beyond.any():
            chain.slow(index, beyond, slower)
            return True
        chain.fits(index)
        return False

    def _final_segment(self, chain: WaypointChain, index: int) -> RuckigSegment:
        """The segment with the least acceleration and jerk that still takes its time."""
        for segment in chain.smooth_segments(index):
            if not chain.beyond(index, segment).any() and not chain.is_too_fast(index, segment):
                return segment
        raise PlanError("no_timing", "expected a segment that was found before, got none")
