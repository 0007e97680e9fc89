# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Keeps a sentence clear of the robot's own body: idle arms go to rest first, transitions are led around."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Iterator, Sequence
from functools import partial

import numpy as np

from teo_common.arrays import Array
from teo_description.hand_geometry import HandTable
from teo_motion.collision.arm_detours import arm_detours
from teo_motion.collision.motion_clearance import RESOLUTION, MotionClearance
from teo_motion.collision.thumb_detours import with_clear_thumbs, with_thumbs_led
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

# Detours are sought farther from the body by so much [m], since a motion rounds the corners of its way: by a
# finger's half, or where that did not do, by a finger's breadth.
_MARGINS = (0.005, 0.02)


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

    def plan(self, composition: Composition) -> Plan:
        """The motion of a composition, led around the robot's body where it would touch it.

        Args:
            composition: The sentence.

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
                return self._led_around(self._measured(self._with_clear_thumbs(route)))
            except SelfCollisionError as collision:
                more = _idle_arms(composition, collision) - cleared
                if not more:
                    raise
                cleared |= more

    def _with_clear_thumbs(self, route: Route) -> TimedRoute:
        """A route with its motion, in which thumbs keep out of fingers."""
        if self._thumbs is not None:
            route = with_clear_thumbs(route, self._thumbs, self._limits)
        return self._with_thumbs_led(self._timing.timed(route))

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

    def _led_around(self, timed: TimedRoute) -> Plan:
        """The motion of a route, its transitions led around the body.

        Raises:
            SelfCollisionError: It still touches after `_DETOURS_PER_TOKEN` detours a sign.
        """
        for _ in range(_DETOURS_PER_TOKEN * (len(timed.route.spans) + 1)):
            if self._is_clear(timed.plan):
                break
            timed = self._with_worst_avoided(timed)
        if not self._is_clear(timed.plan):
            raise self._collision(timed)
        # Arms that go round take longer, and fingers and thumb are elsewhere on their way meanwhile.
        led = self._with_thumbs_led(timed)
        if led is timed:
            return timed.plan
        led = self._measured(led)
        return led.plan if self._is_clear(led.plan) else timed.plan

    def _with_worst_avoided(self, timed: TimedRoute) -> TimedRoute:
        """Lead the transition with the worst collision around the body."""
        route, plan, times = timed
        step = _nearest_step(timed)
        first_step, last_step = self._between_postures(route, step)
        ends = times[[first_step, last_step]]
        if self._is_clear_at(plan, ends):
            first, second = (plan.at(moment)[0] for moment in ends.tolist())
            # A sign that is swung into leaves the straight line to its next knot, where hands may be close:
            # it stands still at the knot first.
            within = route.token_at(step) is not None
            ways: Iterable[Sequence[Array]] = [(first,)] if within else self._around(first, second)
            half_way = (first_step + last_step - 1) // 2
            for postures in ways:
                other = route
                for posture in reversed(postures):
                    other = self._with_detour(other, half_way, posture)
                found = self._measured(self._timing.timed(other))
                round_here = range(first_step, last_step + len(postures))
                if self._is_clear(found.plan) or _nearest_step(found) not in round_here:
                    return found
        raise self._collision(timed)

    def _around(self, first: Array, second: Array) -> Iterator[tuple[Array, ...]]:
        """Ways between two postures that lead around the body, the nearest first."""
        assert self._motion_clearance is not None
        looking = self._motion_clearance
        near = min(looking.distance(first), looking.distance(second)) - RESOLUTION / 2.0
        for margin in _MARGINS:
            apart = max(min(self._least_clearance + margin, near), self._least_clearance)
            found = False
            for way in arm_detours(first, second, self._limits, partial(looking.is_nearer, distance=apart)):
                found = True
                yield way
            if not found:  # farther off the body there is none either
                return

    def _with_detour(self, route: Route, step: int, posture: Array) -> Route:
        """Have the arms alone pass through another posture half way between two waypoints."""
        row = np.full(len(posture), np.nan)
        row[self._arms] = posture[self._arms]
        return route.with_waypoint(step, row)

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
