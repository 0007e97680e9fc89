# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Keeps a sentence clear of the robot's own body: idle arms go to rest first, transitions are led around."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain, pairwise

import numpy as np

from teo_common.arrays import Array
from teo_description.hand_geometry import HandTable
from teo_motion.collision.detours import aside, detours, with_clear_thumbs, with_detour, with_thumbs_led
from teo_motion.collision.motion_clearance import MotionClearance
from teo_motion.sentence.composition import ARMS, Composition, Route
from teo_motion.sentence.idle_limb_policy import settle_idle_limbs
from teo_motion.sentence.plan import Plan, sample_at
from teo_motion.sentence.timing import SentenceTiming, TimedRoute
from teo_motion.trajectory.limits import MotionLimits
from teo_signs.errors import PlanError

# A sentence may be led around the robot's body by so many postures for each of its signs.
_DETOURS_PER_TOKEN = 2

# A way of a hand is halved so many times for its thumb [1]: a finger then folds by 10 deg between two points.
_THUMB_ROUNDS = 3

# [m] What all but touches is taken so far off the body before it goes on: a finger's breadth and a half.
_OFF_BODY = 0.03
# [rad] A joint turns by so much at most at once meanwhile, and so many times: 3 deg, 40 deg in all.
_OFF_STEP, _OFF_STEPS = 0.05, 14

# Postures that are looked at on a straight line between two others, before its motion is timed [1].
_LINE_SAMPLES = 9


class SelfCollisionError(PlanError):
    """The robot touches itself where no detour helps ("self_collision").

    Attributes:
        token: Index of the token that is signed there, or is signed next; their number after the last.
    """

    def __init__(self, message: str, token: int) -> None:
        """Say where, and how near what comes."""
        super().__init__(code="self_collision", message=message)
        self.token = token

    def __reduce__(self) -> tuple[type[SelfCollisionError], tuple[str, int]]:
        """Its arguments, so that the error can pass from one process to another."""
        return SelfCollisionError, (str(self), self.token)


class CollisionAvoidance:
    """Finds motions in which a robot does not touch itself."""

    def __init__(
        self,
        timing: SentenceTiming,
        motion_clearance: MotionClearance | None,
        thumbs: HandTable | None,
        *,
        limits: MotionLimits,
        least_clearance: float,
        arm_rest: float,
    ) -> None:
        """Prepare.

        Args:
            timing: Times the waypoints of a route.
            motion_clearance: Distances between parts of the robot; None looks at none.
            thumbs: Where thumb and fingers of a hand are; None does not look at them.
            limits: Limits of the joints, which detours keep.
            least_clearance: Distance that parts of the robot keep [m].
            arm_rest: Least time at rest for which an idle arm goes there and back [s].
        """
        self._timing = timing
        self._motion_clearance = motion_clearance
        self._thumbs = thumbs
        self._limits = limits
        self._least_clearance = least_clearance
        self._arm_rest = arm_rest
        self._arms = [column for arm in ARMS for column in limits.humanoid.limb_columns[arm]]

    def plan(self, composition: Composition, *, by_rest: bool = False) -> Plan:
        """The motion of a composition, led around the robot's body where it would touch it.

        Args:
            composition: The sentence.
            by_rest: Whether arms may go to rest between two signs where no shorter way is found.

        Raises:
            SelfCollisionError: No such motion is found.
            PlanError: See `SentenceTiming.timed`.
        """
        times = self._timing.estimate(composition)
        cleared: set[tuple[str, int]] = set()
        while True:
            route = settle_idle_limbs(
                composition, times=times, limits=self._limits, arm_rest=self._arm_rest, cleared=cleared
            )
            try:
                return self._led_around(self._measured(self._with_clear_thumbs(route)), by_rest=by_rest)
            except SelfCollisionError as collision:
                more = _idle_arms(composition, collision) - cleared
                if not more:
                    raise
                cleared |= more

    def _with_clear_thumbs(self, route: Route) -> TimedRoute:
        """A route with its motion, in which thumbs keep out of fingers."""
        if self._thumbs is None:
            return self._timing.timed(route)
        return self._with_thumbs_led(self._timing.timed(with_clear_thumbs(route, self._thumbs, self._limits)))

    def _with_thumbs_led(self, timed: TimedRoute) -> TimedRoute:
        """A route with its motion, whose hands pass through more shapes where a thumb is in a finger."""
        if self._thumbs is None:
            return timed
        for _ in range(_THUMB_ROUNDS):
            led = with_thumbs_led(timed, self._thumbs, self._limits)
            if led is timed.route:
                break
            timed = self._timing.timed(led)
        return timed

    def _measured(self, timed: TimedRoute) -> TimedRoute:
        """A route with its motion, in which the nearest approach of parts is measured."""
        if self._motion_clearance is None:
            return timed
        nearest = self._motion_clearance.nearest(timed.plan.samples)
        return timed._replace(plan=dataclasses.replace(timed.plan, nearest=nearest))

    def _led_around(self, timed: TimedRoute, *, by_rest: bool) -> Plan:
        """The motion of a route, its transitions led around the body.

        Raises:
            SelfCollisionError: It still touches after `_DETOURS_PER_TOKEN` detours a sign.
        """
        for _ in range(_DETOURS_PER_TOKEN * (len(timed.route.spans) + 1)):
            if self._is_clear(timed.plan):
                break
            timed = self._with_worst_avoided(timed, by_rest=by_rest)
        if not self._is_clear(timed.plan):
            raise self._collision(timed)
        # Arms that go round take longer, and fingers and thumb are elsewhere on their way meanwhile.
        led = self._with_thumbs_led(timed)
        if led is timed:
            return timed.plan
        led = self._measured(led)
        return led.plan if self._is_clear(led.plan) else timed.plan

    def _with_worst_avoided(self, timed: TimedRoute, *, by_rest: bool) -> TimedRoute:
        """Lead the transition with the worst collision around the body.

        By way of rest each half has a way of its own, and is led around by itself in a later round.
        """
        route, plan, times = timed
        step = _nearest_step(timed)
        first_step, last_step = self._between_postures(route, step)
        ends = times[[first_step, last_step]]
        if self._is_clear_at(plan, ends):
            begin, end = ends.tolist()
            first, middle, second = (plan.at(moment)[0] for moment in (begin, (begin + end) / 2.0, end))
            rest = self._limits.humanoid.ready
            of_rest = any(np.allclose(row[self._arms], rest[self._arms]) for row in (first, second))
            # A sign that is swung into leaves the straight line to its next knot, where hands may be close:
            # it stands still at the knot first.
            ways: Iterable[Sequence[Array]] = [(first,)]
            if route.token_at(step) is None:
                ways = detours(first, middle, second, self._limits)
                if of_rest:  # between two signs arms may go by way of it
                    ways = chain(ways, self._off_the_body_and_aside(first, second))
            half_way = (first_step + last_step - 1) // 2
            for postures in ways:
                if self._touches([first, *postures, second]):  # which is known before its motion is timed
                    continue
                other = route
                for posture in reversed(postures):
                    other = with_detour(other, half_way, posture, self._arms)
                found = self._measured(self._timing.timed(other))
                round_here = range(first_step, last_step + len(postures))
                if self._is_clear(found.plan) or _nearest_step(found) not in round_here:
                    return found
            if by_rest and not of_rest and route.token_at(step) is None:
                return self._measured(self._timing.timed(with_detour(route, half_way, rest, self._arms)))
        raise self._collision(timed)

    def _off_the_body_and_aside(self, first: Array, second: Array) -> Iterator[tuple[Array, ...]]:
        """Ways between two postures on which hands leave the body first, then go round it."""
        off, later = self._off_the_body(first), self._off_the_body(second)
        yield off, aside(off, self._limits), later
        yield off, aside(off, self._limits), aside(later, self._limits), later

    def _off_the_body(self, posture: Array) -> Array:
        """A posture in which parts that all but touch have moved apart, by the shortest way; or the same."""
        assert self._motion_clearance is not None
        off, near = posture, self._motion_clearance.distance(posture)
        steps = np.zeros((len(self._arms), len(posture)))
        steps[np.arange(len(self._arms)), self._arms] = _OFF_STEP
        for _ in range(_OFF_STEPS):
            if near >= _OFF_BODY:
                break
            gains = np.array([self._motion_clearance.distance(off + step) - near for step in steps])
            if not gains.any():
                break
            off = np.clip(off + gains / np.abs(gains).max() @ steps, self._limits.lower, self._limits.upper)
            near = self._motion_clearance.distance(off)
        return off

    def _between_postures(self, route: Route, step: int) -> tuple[int, int]:
        """The waypoints around a step at which arms have places: between signs some are of hands alone."""
        free = [bool(np.isnan(row[self._arms]).all()) for row in route.targets]
        first, last = step, step + 1
        if route.token_at(step) is None:
            while free[first] and route.token_at(first - 1) is None:
                first -= 1
            while free[last] and route.token_at(last) is None:
                last += 1
        return first, last

    def _collision(self, timed: TimedRoute) -> SelfCollisionError:
        """What touches, and where: in a sign if one of its postures does, else between two waypoints."""
        route, plan, times = timed
        near, step = plan.nearest, _nearest_step(timed)
        assert near is not None
        ends = self._between_postures(route, step)
        guilty = next((end for end in ends if not self._is_clear_at(plan, times[end : end + 1])), None)
        if guilty is None:
            where = f"on the way from {route.name_at(ends[0])} to {route.name_at(ends[1])}"
        else:
            where = f"in {route.name_at(guilty)}"
        message = (
            f"{where}, at {near.time:.2f} s: expected {near.first} and {near.second} to stay "
            f"{self._least_clearance * 1000:.0f} mm apart, got {near.distance * 1000:.1f} mm"
        )
        waypoint = step + 1 if guilty is None else guilty
        token = next(
            (index for index, span in enumerate(route.spans) if waypoint <= span.last), len(route.spans)
        )
        return SelfCollisionError(message, token)

    def _touches(self, postures: Sequence[Array]) -> bool:
        """Whether the robot would touch itself along straight lines from posture to posture."""
        assert self._motion_clearance is not None
        return any(
            self._motion_clearance.is_nearer(begin + share * (end - begin), self._least_clearance)
            for begin, end in pairwise(postures)
            for share in np.linspace(0.0, 1.0, _LINE_SAMPLES)
        )

    def _is_clear(self, plan: Plan) -> bool:
        return plan.nearest is None or plan.nearest.distance >= self._least_clearance

    def _is_clear_at(self, plan: Plan, times: Array) -> bool:
        """Whether the robot keeps clear of itself at some times, whatever it does between them."""
        assert self._motion_clearance is not None
        postures = sample_at(plan.motions, times).positions
        return not any(self._motion_clearance.is_nearer(row, self._least_clearance) for row in postures)


def _nearest_step(timed: TimedRoute) -> int:
    """The waypoint before the place where the robot comes closest to itself."""
    assert timed.plan.nearest is not None
    after = int(np.searchsorted(timed.times, timed.plan.nearest.time, side="right"))
    return min(after - 1, len(timed.times) - 2)


def _idle_arms(composition: Composition, collision: SelfCollisionError) -> set[tuple[str, int]]:
    """Arms that a token does not use, each with the waypoint at which it begins."""
    if collision.token >= len(composition.spans):
        return set()
    first = composition.spans[collision.token].first
    return {
        (span.limb, first)
        for span in composition.idle
        if span.limb in ARMS and span.first < first < span.last
    }
