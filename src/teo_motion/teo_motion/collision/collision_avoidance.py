"""Keeps a sentence clear of the robot's own body: idle arms go to rest first, transitions are led around."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from teo_motion.collision.clearance_check import SelfCollision
from teo_motion.collision.detour import Route, detours, with_detour
from teo_motion.collision.idle_limb_policy import settle_idle_limbs
from teo_motion.sentence.composition import ARMS, Composition
from teo_motion.sentence.plan import Plan, sample_at
from teo_motion.trajectory.limits import MotionLimits
from teo_signs.errors import PlanError

Array = NDArray[np.float64]

# A sentence may be led around the robot's body by so many postures for each of its signs.
_DETOURS_PER_TOKEN = 2

# Looks at a straight way between two postures before its motion is timed.
_LOOKS = 9


class TimedRoute(NamedTuple):
    """A route and its motion.

    Attributes:
        route: The stations.
        plan: The motion through them.
        times: When each station is passed [s].
    """

    route: Route
    plan: Plan
    times: Array

    @property
    def nearest_step(self) -> int:
        """The station before the place where the robot comes closest to itself."""
        assert self.plan.nearest is not None
        after = int(np.searchsorted(self.times, self.plan.nearest.time, side="right"))
        return min(after - 1, len(self.times) - 2)


class _InTheWayError(Exception):
    """The robot touches itself where no detour helps.

    Attributes:
        error: What to say if nothing else helps either.
        token: Index of the token that is signed there, or is signed next; their number after the last.
    """

    def __init__(self, error: PlanError, token: int) -> None:
        super().__init__(str(error))
        self.error = error
        self.token = token


class ClearWay:
    """Finds ways on which a robot does not touch itself."""

    def __init__(
        self,
        collision_model: SelfCollision | None,
        *,
        limits: MotionLimits,
        least_clearance: float,
        arm_rest: float,
    ) -> None:
        """Prepare.

        Args:
            collision_model: Distances between parts of the robot; None looks at none.
            limits: Limits of the joints, which detours keep.
            least_clearance: Distance that parts of the robot keep [m].
            arm_rest: Least time at rest worth an idle arm's way [s].
        """
        self._collision_model = collision_model
        self._limits = limits
        self._least_clearance = least_clearance
        self._arm_rest = arm_rest

    def plan(self, composition: Composition, times: Array, solve: Callable[[Route], TimedRoute]) -> Plan:
        """The motion of a composition, led around the robot's body where it would touch it.

        Args:
            composition: What is signed.
            times: When about each of its stations is passed, idle limbs aside [s].
            solve: Times a route.

        Raises:
            PlanError: "self_collision" if no way is found; what ``solve`` raises.
        """
        cleared: set[tuple[int, int]] = set()
        while True:
            targets = settle_idle_limbs(
                composition, times=times, limits=self._limits, arm_rest=self._arm_rest, cleared=cleared
            )
            route = Route(
                targets=targets,
                nominal=composition.nominal,
                strokes=composition.strokes,
                spans=composition.spans,
            )
            try:
                return self._led_around(solve(route), solve)
            except _InTheWayError as collision:
                more = _idle_arms(composition, collision) - cleared
                if not more:
                    raise collision.error from None
                cleared |= more

    def _led_around(self, timed: TimedRoute, solve: Callable[[Route], TimedRoute]) -> Plan:
        """The motion of a route, its transitions led around the body.

        Raises:
            _InTheWayError: That is not enough.
        """
        for _ in range(_DETOURS_PER_TOKEN * (len(timed.route.spans) + 1)):
            if self._is_clear(timed.plan):
                return timed.plan
            timed = self._with_worst_avoided(timed, solve)
        if self._is_clear(timed.plan):
            return timed.plan
        raise self._in_the_way(timed)

    def _with_worst_avoided(self, timed: TimedRoute, solve: Callable[[Route], TimedRoute]) -> TimedRoute:
        """Lead the transition with the worst collision around the body."""
        route, plan, times = timed
        step = timed.nearest_step
        if route.token_at(step) is None and self._is_clear_at(plan, times[step : step + 2]):
            begin, end = float(times[step]), float(times[step + 1])
            first, middle, second = (plan.at(moment)[0] for moment in (begin, (begin + end) / 2.0, end))
            for postures in self._free_first(detours(first, middle, second, self._limits), first, second):
                other = route
                for posture in reversed(postures):
                    other = with_detour(other, step, posture)
                found = solve(other)
                round_here = range(step, step + len(postures) + 1)
                if self._is_clear(found.plan) or found.nearest_step not in round_here:
                    return found
        raise self._in_the_way(timed)

    def _in_the_way(self, timed: TimedRoute) -> _InTheWayError:
        """What touches, and where: in a sign if one of its postures does, else on the way between two."""
        route, plan, times = timed
        near, step = plan.nearest, timed.nearest_step
        assert near is not None
        guilty = next(
            (end for end in (step, step + 1) if not self._is_clear_at(plan, times[end : end + 1])), None
        )
        if guilty is None:
            where = f"on the way from {route.name_at(step)} to {route.name_at(step + 1)}"
        else:
            where = f"in {route.name_at(guilty)}"
        error = PlanError(
            "self_collision",
            f"{where}, at {near.time:.2f} s: expected {near.first} and {near.second} to stay "
            f"{self._least_clearance * 1000:.0f} mm apart, got {near.distance * 1000:.1f} mm",
        )
        station = step + 1 if guilty is None else guilty
        token = next(
            (index for index, span in enumerate(route.spans) if station <= span.last), len(route.spans)
        )
        return _InTheWayError(error, token)

    def _free_first(
        self, ways: Iterable[Sequence[Array]], first: Array, second: Array
    ) -> Iterator[Sequence[Array]]:
        """Ways round, those first that are free in straight lines: that is seen in no time."""
        touching = []
        for way in ways:
            if self._touches([first, *way, second]):
                touching.append(way)
            else:
                yield way
        yield from touching

    def _touches(self, postures: Sequence[Array]) -> bool:
        """Whether the robot would touch itself on straight ways from posture to posture."""
        assert self._collision_model is not None
        return any(
            self._collision_model.is_nearer(begin + share * (end - begin), self._least_clearance)
            for begin, end in pairwise(postures)
            for share in np.linspace(0.0, 1.0, _LOOKS)
        )

    def _is_clear(self, plan: Plan) -> bool:
        return plan.nearest is None or plan.nearest.distance >= self._least_clearance

    def _is_clear_at(self, plan: Plan, times: Array) -> bool:
        assert self._collision_model is not None
        found = self._collision_model.nearest(sample_at(plan.motions, times))
        return found.distance >= self._least_clearance


def _idle_arms(composition: Composition, collision: _InTheWayError) -> set[tuple[int, int]]:
    """Arms that a token does not use, each with the station at which it begins."""
    if collision.token >= len(composition.spans):
        return set()
    first = composition.spans[collision.token].first
    return {
        (span.limb, first)
        for span in composition.idle
        if span.limb in ARMS and span.first < first < span.last
    }
