# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From a route to a plan: when each waypoint is passed, how every joint moves, checked against its limits."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from teo_common.arrays import Array
from teo_motion.sentence.composition import Composition, Route
from teo_motion.sentence.plan import Plan, TokenTiming
from teo_motion.trajectory.driver_points import Samples, driver_points, point_times
from teo_motion.trajectory.joint_motion import JointMotion
from teo_motion.trajectory.limits import MotionLimits
from teo_motion.trajectory.ruckig_segment import ROUNDING
from teo_motion.trajectory.waypoint_timing import LEAST_STEP, WaypointTiming
from teo_signs.errors import PlanError


class TimedRoute(NamedTuple):
    """A route and its motion.

    Attributes:
        route: The waypoints.
        plan: The motion through them; distances between parts of the robot are not looked at yet.
        times: When each waypoint is passed [s]. Shape (n,).
    """

    route: Route
    plan: Plan
    times: Array


class SentenceTiming:
    """Times sentences within the limits of the joints."""

    def __init__(self, *, limits: MotionLimits, period: float, max_duration: float) -> None:
        """Prepare.

        Args:
            limits: Limits of the commanded joints.
            period: Time between two samples of a plan [s].
            max_duration: A longer motion is refused [s].
        """
        self._limits = limits
        self._bounds = limits.bounds
        self._period = period
        self._max_duration = max_duration

    def estimate(self, composition: Composition) -> Array:
        """When about each waypoint is passed, idle limbs aside [s]. Shape (n,)."""
        return self._timing(composition).times

    def _timing(self, route: Route) -> WaypointTiming:
        return WaypointTiming(route.targets, route.nominal, route.strokes, route.start, self._bounds)

    def timed(self, route: Route) -> TimedRoute:
        """Time a route.

        Raises:
            PlanError: It takes too long ("too_long"), no times are found ("no_timing"), or a joint cannot
                stay within its limits ("outside_limits").
        """
        timing = self._timing(route)
        timing.solve()
        # A robot that stands still does so for a period more: see `driver_points`.
        times = timing.times + (self._period if route.start.is_still else 0.0)
        if times[-1] > self._max_duration:
            raise PlanError(
                "too_long",
                f"expected a sentence of at most {self._max_duration:.0f} s, got one of {times[-1]:.0f} s: "
                "send it in parts",
            )
        sampled = point_times(float(times[-1]), self._period)
        motions = timing.motions(begin=float(times[0]), end=float(sampled[-1]))
        self._check(motions)
        durations = [float(times[span.last] - times[span.first]) for span in route.spans]
        timings = tuple(
            TokenTiming(
                token=span.token,
                start=float(times[span.first]),
                duration=duration,
                stretch=_stretch(duration, span.asked),
            )
            for span, duration in zip(route.spans, durations, strict=True)
        )
        plan = Plan(
            names=self._limits.names,
            motions=motions,
            samples=self._sample(motions, sampled, route.targets[-1]),
            timings=timings,
            stretch=_stretch(sum(durations), sum(span.asked for span in route.spans)),
        )
        return TimedRoute(route, plan, times)

    def _check(self, motions: tuple[JointMotion, ...]) -> None:
        """Look at the extremes of the motion itself, whatever is known of how it was made."""
        limits = self._limits
        for joint, (name, motion) in enumerate(zip(limits.names, motions, strict=True)):
            reached = motion.extremes()
            lower, upper = float(limits.lower[joint]), float(limits.upper[joint])
            if reached.least < lower - ROUNDING or reached.greatest > upper + ROUNDING:
                raise PlanError(
                    "outside_limits",
                    f"expected {name} within {lower:.4f} .. {upper:.4f} rad, got {reached.least:.4f} .. "
                    f"{reached.greatest:.4f} rad: the joint is too fast at the start to turn back in time",
                )
            for what, value, limit in (
                ("velocity [rad/s]", reached.velocity, limits.velocity[joint]),
                ("acceleration [rad/s^2]", reached.acceleration, limits.acceleration[joint]),
                ("jerk [rad/s^3]", reached.jerk, limits.jerk[joint]),
            ):
                if value > limit * (1.0 + ROUNDING):
                    raise PlanError(
                        "outside_limits", f"{name}: expected at most {limit:.4f} of {what}, got {value:.4f}"
                    )

    def _sample(self, motions: tuple[JointMotion, ...], times: Array, end: Array) -> Samples:
        found = driver_points(motions, times)
        # No further than the rounding that `_check` allows; controllers want the end to the digit.
        positions = np.clip(found.positions, self._limits.lower, self._limits.upper)
        positions[-1], found.velocities[-1], found.accelerations[-1] = end, 0.0, 0.0
        return found._replace(positions=positions).frozen()


def _stretch(duration: float, asked: float) -> float:
    """Time taken over the time asked for [1]; 1 where none was asked for, as of a pause of 0 s."""
    return duration / asked if asked > LEAST_STEP else 1.0
