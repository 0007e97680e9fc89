"""Plans sentences: tokens in, motion out. See `composer`, `idle_rule` and `station_timing` for how."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from teo_description.robot import Robot
from teo_lut_executor.composer import ARMS, REST, Composition, compose
from teo_lut_executor.detour import Route, detours, with_detour
from teo_lut_executor.idle_rule import settle_idle_limbs
from teo_lut_executor.joint_motion import JointMotion
from teo_lut_executor.lexicon import DEFAULT_STANDING, Lexicon
from teo_lut_executor.motion_limits import MotionLimits
from teo_lut_executor.plan import Plan, Samples, TokenTiming, sample_at, sample_times
from teo_lut_executor.plan_error import PlanError
from teo_lut_executor.self_collision import SelfCollision
from teo_lut_executor.sign import Sign
from teo_lut_executor.sign_schema import Standing
from teo_lut_executor.signing_style import SigningStyle
from teo_lut_executor.state_to_state import ROUNDING, State
from teo_lut_executor.station_timing import StationTiming
from teo_lut_executor.tokens import Token

Array = NDArray[np.float64]

# TEO's drives take a set-point with every CAN SYNC, 0.02 s apart: more points would not reach them.
DEFAULT_PERIOD = 0.02  # [s]

# Longest sentence [s]: some 150 letters. What is longer was not split into sentences, and 15,000 points of
# 28 joints fill a message of 10 MB.
DEFAULT_MAX_DURATION = 300.0

# Parts of the robot keep this far apart [m]: signs touch, and the shapes of the collision model are larger
# than the parts, so it is overlap that is refused.
DEFAULT_CLEARANCE = 0.0

# A start this far outside the limits is taken to be on the limit [rad]: encoders of 0.0015 rad and a control
# error are no reason to refuse, and MoveIt allows the same (allowed_start_tolerance).
START_TOLERANCE = 0.01

# A sentence may be led around the robot's body by so many postures for each of its signs.
_DETOURS_PER_TOKEN = 2


# Looks at a straight way between two postures before its motion is timed.
_LOOKS = 9


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


class Planner:
    """Plans sentences of one look-up table for one robot."""

    def __init__(
        self,
        signs: Mapping[str, Sign],
        *,
        limits: MotionLimits | None = None,
        style: SigningStyle | None = None,
        robot: Robot | None = None,
        least_clearance: float = DEFAULT_CLEARANCE,
        period: float = DEFAULT_PERIOD,
        max_duration: float = DEFAULT_MAX_DURATION,
        least_standing: Standing = DEFAULT_STANDING,
    ) -> None:
        """Prepare.

        Args:
            signs: The table.
            limits: Limits of the 28 commanded joints; None for TEO's with the default acceleration and jerk.
            style: Times of holds and pauses; None for the defaults.
            robot: For distances between parts of the robot; None plans without looking at them.
            least_clearance: Distance that parts of the robot keep [m].
            period: Most time between two samples of a plan [s].
            max_duration: A longer motion is refused [s].
            least_standing: Signs of a lower standing are spelled.

        Raises:
            PlanError: The period or the duration is not above 0 ("bad_period"), or the limits leave no room
                for interpolation between points that far apart ("bad_limits").
        """
        for name, value in (("period", period), ("max_duration", max_duration)):
            if not value > 0.0:
                raise PlanError("bad_period", f"{name}: expected a time above 0 s, got {value}")
        self.limits = MotionLimits.of_robot() if limits is None else limits
        self.style = SigningStyle() if style is None else style
        self._bounds = self.limits.for_points(period)
        self._lexicon = Lexicon(signs, least_standing)
        self._collision_model = None if robot is None else SelfCollision(robot)
        self._least_clearance = least_clearance
        self._period = period
        self._max_duration = max_duration

    def plan(self, tokens: Sequence[Token], start: State | None = None) -> Plan:
        """Plan a sentence.

        Args:
            tokens: What to sign, in order.
            start: State of the 28 commanded joints; None for rest.

        Raises:
            PlanError: The sentence cannot be signed; the code says why.
        """
        signed = self._lexicon.resolve(tokens)
        begin = self._checked(start)
        composition = compose(signed, start=begin.position, limits=self.limits, style=self.style)
        return self._route(composition, begin)

    def plan_to_rest(self, start: State) -> Plan:
        """Plan the way to rest from any state, moving ones included.

        Raises:
            PlanError: There is no way that keeps the limits and the clearance; the code says why.
        """
        begin = self._checked(start)
        composition = compose((), start=begin.position, limits=self.limits, style=self.style)
        return self._route(composition, begin)

    def _checked(self, start: State | None) -> State:
        """The state to plan from, moved onto the limits where it is a little beyond them."""
        joints = len(self.limits.names)
        still = np.zeros(joints)
        if start is None:
            return State(position=REST, velocity=still, acceleration=still)
        for name, values in (
            ("position", start.position),
            ("velocity", start.velocity),
            ("acceleration", start.acceleration),
        ):
            if values.shape != (joints,):
                message = f"start {name}: expected {joints} numbers, got shape {values.shape}"
                raise PlanError("bad_start", message)
            if not np.isfinite(values).all():
                bad = self.limits.names[int(np.flatnonzero(~np.isfinite(values))[0])]
                raise PlanError("bad_start", f"start {name}: expected finite numbers, got none for {bad}")
        position = np.clip(start.position, self.limits.lower, self.limits.upper)
        beyond = np.abs(position - start.position)
        if (beyond > START_TOLERANCE).any():
            worst = int(np.argmax(beyond))
            raise PlanError(
                "start_outside_limits",
                f"expected {self.limits.names[worst]} within {self.limits.lower[worst]:.4f} .. "
                f"{self.limits.upper[worst]:.4f} rad, got {start.position[worst]:.4f} rad; "
                "move the robot back by other means",
            )
        bounds = self._bounds
        return State(
            position=position,
            velocity=np.clip(start.velocity, -bounds.velocity, bounds.velocity),
            acceleration=np.clip(start.acceleration, -bounds.acceleration, bounds.acceleration),
        )

    def _route(self, composition: Composition, start: State) -> Plan:
        """Time a composition, and lead its transitions around the robot's body where they would touch it."""
        first_look = StationTiming(
            composition.targets, composition.nominal, composition.strokes, start, self._bounds
        )
        cleared: set[tuple[int, int]] = set()
        while True:
            targets = settle_idle_limbs(
                composition,
                times=first_look.times,
                limits=self.limits,
                arm_rest=self.style.arm_rest,
                cleared=cleared,
            )
            route = Route(
                targets=targets,
                nominal=composition.nominal,
                strokes=composition.strokes,
                spans=composition.spans,
            )
            try:
                return self._clear(route, start)
            except _InTheWayError as collision:
                more = _idle_arms(composition, collision) - cleared
                if not more:
                    raise collision.error from None
                cleared |= more

    def _clear(self, route: Route, start: State) -> Plan:
        """Time a route, and lead its transitions around the robot's body where they would touch it.

        Raises:
            _InTheWayError: That is not enough.
        """
        plan, times = self._solve(route, start)
        for _ in range(_DETOURS_PER_TOKEN * (len(route.spans) + 1)):
            if self._is_clear(plan):
                return plan
            route, plan, times = self._avoid(route, plan, times, start)
        if self._is_clear(plan):
            return plan
        raise self._in_the_way(plan, route, times)

    def _avoid(self, route: Route, plan: Plan, times: Array, start: State) -> tuple[Route, Plan, Array]:
        """Lead the transition with the worst collision around the body."""
        step = _step(plan, times)
        if route.token_at(step) is None and self._is_clear_at(plan, times[step : step + 2]):
            begin, end = float(times[step]), float(times[step + 1])
            first, middle, second = (plan.at(moment)[0] for moment in (begin, (begin + end) / 2.0, end))
            ways = detours(first, middle, second, self.limits)
            # First those that are free in straight lines, which is seen in a hundredth of a motion's time.
            for postures in sorted(ways, key=lambda way: self._touches([first, *way, second])):
                other = route
                for posture in reversed(postures):
                    other = with_detour(other, step, posture)
                other_plan, other_times = self._solve(other, start)
                round_here = range(step, step + len(postures) + 1)
                if self._is_clear(other_plan) or _step(other_plan, other_times) not in round_here:
                    return other, other_plan, other_times
        raise self._in_the_way(plan, route, times)

    def _in_the_way(self, plan: Plan, route: Route, times: Array) -> _InTheWayError:
        """What touches, and where: in a sign if one of its postures does, else on the way between two."""
        near, step = plan.nearest, _step(plan, times)
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

    def _solve(self, route: Route, start: State) -> tuple[Plan, Array]:
        timing = StationTiming(route.targets, route.nominal, route.strokes, start, self._bounds)
        timing.solve()
        times = timing.times
        if times[-1] > self._max_duration:
            raise PlanError(
                "too_long",
                f"expected a sentence of at most {self._max_duration:.0f} s, got one of {times[-1]:.0f} s: "
                "send it in parts",
            )
        motions = timing.motions()
        self._check(motions)
        timings = tuple(
            TokenTiming(
                token=span.token,
                start=float(times[span.first]),
                duration=float(times[span.last] - times[span.first]),
                stretch=float(times[span.last] - times[span.first]) / span.asked,
            )
            for span in route.spans
        )
        asked = sum(span.asked for span in route.spans)
        samples = self._sample(motions, times)
        plan = Plan(
            names=self.limits.names,
            motions=motions,
            samples=samples,
            timings=timings,
            stretch=sum(timing.duration for timing in timings) / asked if asked > 0.0 else 1.0,
            nearest=None if self._collision_model is None else self._collision_model.nearest(samples),
        )
        return plan, times

    def _check(self, motions: tuple[JointMotion, ...]) -> None:
        """Look at the extremes of the motion itself, whatever is known of how it was made."""
        limits = self.limits
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

    def _sample(self, motions: tuple[JointMotion, ...], times: Array) -> Samples:
        found = sample_at(motions, sample_times(times, self._period))
        # No further than the rounding that `_check` allows; controllers want the end at rest to the digit.
        positions = np.clip(found.positions, self.limits.lower, self.limits.upper)
        velocities, accelerations = found.velocities.copy(), found.accelerations.copy()
        positions[-1], velocities[-1], accelerations[-1] = REST, 0.0, 0.0
        for array in (positions, velocities, accelerations):
            array.setflags(write=False)
        return Samples(
            times=found.times, positions=positions, velocities=velocities, accelerations=accelerations
        )

    def _touches(self, postures: Sequence[Array]) -> bool:
        """Whether the robot would touch itself on straight ways from posture to posture."""
        assert self._collision_model is not None
        return any(
            self._collision_model.distance(begin + share * (end - begin)) < self._least_clearance
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


def _step(plan: Plan, times: Array) -> int:
    """The station before the place where the robot comes closest to itself."""
    assert plan.nearest is not None
    return min(int(np.searchsorted(times, plan.nearest.time, side="right")) - 1, len(times) - 2)


def plan(
    tokens: Sequence[Token],
    signs: Mapping[str, Sign],
    limits: MotionLimits | None = None,
    start: State | None = None,
) -> Plan:
    """Plan one sentence with the defaults, self-collision included; see `Planner` for more than one."""
    return Planner(signs, limits=limits, robot=Robot.load()).plan(tokens, start)
