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
from teo_motion.trajectory.joint_motion import (
    JointMotion,
    Pieces,
    begins,
    in_a_row,
    in_order,
    standing,
    take,
)
from teo_motion.trajectory.ruckig_segment import FITS, Bounds, RuckigSegment, State, pieces_of
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
        moving = [chain for chain in self._chains if chain.moving.size]
        for round_number in range(_ROUNDS):
            patient = round_number < _PATIENT_ROUNDS
            times = self.times
            changed = False
            for chain in moving:
                chain.pass_at(times)
            to_try = [chain.to_try(exact=exact) for chain in moving]
            for single in (True, False):
                for chain, indices in zip(moving, to_try, strict=True):
                    these = [index for index in indices if chain.is_single(index) == single]
                    changed |= self._try(chain, these, patient=patient)
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
        found: dict[int, JointMotion] = {}
        for chain in self._chains:
            segments = _final_segments(chain)
            # When the joints leave each waypoint, and how.
            leaving = [(0.0, standing(chain.positions[0]))] if begin > 0.0 else []
            for index, time in enumerate(times[chain.waypoints].tolist()):
                if index in segments:
                    leaving.append((time, segments[index]))
                elif index == 0 or index - 1 in segments:  # else the joints stand still already
                    leaving.append((time, standing(chain.positions[index])))
            starts = np.concatenate([begins(time, pieces) for time, pieces in leaving], axis=1)
            pieces = in_a_row([pieces for _, pieces in leaving])
            for row, column in enumerate(chain.columns):
                found[column] = in_order(starts[row], take(pieces, row), end)
        return tuple(found[column] for column in sorted(found))

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

    def _try(self, chain: WaypointChain, indices: list[int], *, patient: bool) -> bool:
        """Try segments; where one does not fit, ask for time or slow its ends down. True if any did not."""
        slower = 0.5 if patient else 0.0
        in_time: dict[int, RuckigSegment] = {}
        for index in indices:
            segment = chain.segment(index)
            if segment is None:
                if chain.is_rest_to_rest(index):
                    raise PlanError("no_timing", "expected a segment from rest to rest, got none")
                chain.slow(index, slice(None), slower)
            elif self._want(chain, index, segment.duration, most=_PATIENT_STRETCH if patient else math.inf):
                if not patient:
                    chain.slow(index, slice(None), slower)
            else:
                in_time[index] = segment
        if not in_time:
            return bool(indices)
        fitting = []
        for index, joints in zip(
            in_time, chain.to_slow(list(in_time), pieces_of(list(in_time.values()))), strict=True
        ):
            if joints.any():
                chain.slow(index, joints, slower)
            else:
                fitting.append(index)
        chain.fit(fitting)
        return len(fitting) < len(indices)


def _final_segments(chain: WaypointChain) -> dict[int, Pieces]:
    """The segments with the least acceleration and jerk that still take their time. Shape (m, k) each."""
    found: dict[int, Pieces] = {}
    waiting = {index: chain.smooth_segments(index) for index in chain.moving.tolist()}
    while waiting:
        smoothest = [next(segments, None) for segments in waiting.values()]
        segments = [segment for segment in smoothest if segment is not None]
        if len(segments) < len(waiting):
            raise PlanError("no_timing", "expected segments that were found before, got none")
        pieces = pieces_of(segments)
        slow = chain.to_slow(list(waiting), pieces)
        for row, index in enumerate(list(waiting)):
            if not slow[row].any():
                found[index] = take(pieces, row)
                del waiting[index]
    return found
