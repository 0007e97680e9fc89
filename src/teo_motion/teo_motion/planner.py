# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Plans sentences: tokens in, motion out.

One walk: `Lexicon` finds the signs, `choose_postures` takes those of their postures that are the shortest way
apart, `SignSize` makes those smaller that are too slow, `compose` lays them out as waypoints,
`CollisionAvoidance` settles idle limbs, has the waypoints timed (`SentenceTiming`) and leads the motion
around the robot's body, `HeadOverlay` lays the head's gestures over it. What travels: `SignedToken`,
`Composition`, `Route`, `Plan`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import pairwise

import numpy as np

from teo_common.arrays import Array
from teo_description.hand_geometry import hand_table
from teo_description.robot import Robot
from teo_motion.collision.collision_avoidance import CollisionAvoidance, SelfCollisionError
from teo_motion.collision.motion_clearance import RESOLUTION, MotionClearance
from teo_motion.collision.opening import opening
from teo_motion.head_overlay import HeadOverlay
from teo_motion.sentence.composition import compose
from teo_motion.sentence.plan import Plan, sample_at
from teo_motion.sentence.posture_choice import choose_postures
from teo_motion.sentence.sentence_form import STATEMENT, SentenceForm, check_form, head_gestures
from teo_motion.sentence.sign_size import SignSize
from teo_motion.sentence.signing_style import DEFAULT_REST, RestPosture, SigningStyle
from teo_motion.sentence.timing import SentenceTiming
from teo_motion.trajectory.limits import MotionLimits
from teo_motion.trajectory.ruckig_segment import State
from teo_sign_languages import Language
from teo_signs.errors import LutError, PlanError
from teo_signs.export import SignMotion
from teo_signs.lexicon import DEFAULT_STANDING, Lexicon, SignedToken
from teo_signs.sign import Sign
from teo_signs.sign_schema import Standing
from teo_signs.tokens import Kind, Token

# Time between two samples of a plan [s]: TEO's drives take a set-point with every CAN SYNC, 0.02 s
# apart, and more points would not reach them.
DEFAULT_PERIOD = 0.02

# Longest sentence [s]: some 150 letters. What is longer was not split into sentences, and 15,000 points of
# 28 joints fill a message of 10 MB.
DEFAULT_MAX_DURATION = 300.0

# Parts of the robot keep this far apart [m]: what is found to within so much overlaps nowhere. Signs touch,
# but the shapes of the collision model are larger than the parts: no entry of the table comes nearer than
# 6 mm.
DEFAULT_CLEARANCE = RESOLUTION

# A start this far outside the limits is taken to be on the limit [rad]: encoders of 0.0015 rad and a control
# error are no reason to refuse, and MoveIt allows the same (allowed_start_tolerance).
START_TOLERANCE = 0.01

# Shares of the time asked for that are tried for the opening of a sentence [1]: where the way to the first
# sign leads past the body, its first part is free.
_OPENING_SHARES = (1.0, 0.5)

# Between two rows of a lone sign [s]: drives take no more than 50 set-points a second, and straight lines
# over more than 0.1 s cut the corners of a sign by more than 2 deg.
_PERIOD_RANGE = (0.001, 0.1)

# Greatest motion of a joint that counts as standing still [rad]: the last digit of an entry.
_STILL = 1e-6


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
        rest_posture: RestPosture = DEFAULT_REST,
        language: Language | None = None,
    ) -> None:
        """Prepare.

        Args:
            signs: The table.
            limits: Limits of the commanded joints; None: of `robot` with the default acceleration and jerk.
            style: Times of holds and pauses; None for the defaults.
            robot: For distances between parts of it; None plans without looking at them. Without `limits`,
                too, it is the default one's.
            least_clearance: Distance that parts of the robot keep [m].
            period: Time between two samples of a plan [s].
            max_duration: A longer motion is refused [s].
            least_standing: Signs of a lower standing are spelled.
            rest_posture: Where sentences end, and begin if nothing else is said.
            language: The table's: how numbers are put together, what the head says; None for the default one.

        Raises:
            PlanError: The period or the duration is not above 0 ("bad_period").
        """
        for name, value in (("period", period), ("max_duration", max_duration)):
            if not value > 0.0:
                raise PlanError("bad_period", f"{name}: expected a time above 0 s, got {value}")
        if limits is None:
            limits = MotionLimits.of_robot(None if robot is None else robot.humanoid)
        self.limits = limits
        self.style = SigningStyle() if style is None else style
        self._lexicon = Lexicon(signs, least_standing, None if language is None else language.numbers)
        motion_clearance = None if robot is None else MotionClearance(robot)
        self._motion_clearance = motion_clearance
        self._least_clearance = least_clearance
        self._rest = rest_posture.of(self.limits.humanoid)
        self._period = period
        self._max_duration = max_duration
        self._size = (
            None if robot is None else SignSize(robot, limits=self.limits, least=self.style.least_size)
        )
        self._avoidance = CollisionAvoidance(
            SentenceTiming(limits=self.limits, period=period, max_duration=max_duration),
            motion_clearance,
            None if robot is None else hand_table(robot),
            limits=self.limits,
            least_clearance=least_clearance,
            arm_rest=self.style.arm_rest,
        )
        self._grammar = None if language is None else language.head
        self._head = HeadOverlay(
            motion_clearance,
            limits=self.limits,
            least_clearance=least_clearance,
            strength=self.style.head_motion,
        )

    def makes(self, sign: Sign) -> bool:
        """Whether a sign of the table is made, and not spelled for its low standing."""
        return self._lexicon.makes(sign)

    def check(self, tokens: Sequence[Token], *, form: SentenceForm = STATEMENT) -> None:
        """Refuse what is known to be no sentence without planning it.

        Raises:
            PlanError: The sentence cannot be signed; the code says why.
        """
        check_form(form)
        style, least = self.style, 0.0
        for item in self._lexicon.resolve(tokens):
            spelled = style.letter_hold if item.token.spelled else 0.0
            still = style.pause if item.sign is None else spelled
            least += style.transition + still * item.token.duration_scale
        if least > self._max_duration:
            raise PlanError(
                "too_long",
                f"expected a sentence of at most {self._max_duration:.0f} s, got one that takes more than "
                f"{least:.0f} s: send it in parts",
            )

    def plan(
        self,
        tokens: Sequence[Token],
        start: State | None = None,
        *,
        form: SentenceForm = STATEMENT,
        hold: float = 0.0,
    ) -> Plan:
        """Plan a sentence.

        Args:
            tokens: What to sign, in order.
            start: State of the commanded joints, which may be in motion; None for rest.
            form: Type and negation, which the head shows.
            hold: Time for which limbs that stand still at the start stay there first [s].

        Raises:
            PlanError: The sentence cannot be signed; the code says why.
        """
        check_form(form)
        begin = self._checked(start)
        style = self.style.for_form(form)
        captured = self._lexicon.resolve(tokens)
        chosen = choose_postures(captured, start=begin.position, end=self._rest, limits=self.limits)
        smaller = chosen if self._size is None else self._size.fitted(chosen, captured)

        def planned(signed: Sequence[SignedToken]) -> Plan:
            composition = compose(
                signed, start=begin, limits=self.limits, style=style, rest=self._rest, hold=hold
            )
            plan = self._avoidance.plan(composition)
            gestures = head_gestures([item.token for item in signed], form, self._grammar)
            return self._head.overlaid(plan, signed, gestures)

        # Signs in other postures and sizes may touch on their way where their entries keep apart: those
        # beside the place go back to them.
        ways = [_distinct(*forms) for forms in zip(captured, chosen, smaller, strict=True)]
        while True:
            try:
                return planned([forms[-1] for forms in ways])
            except SelfCollisionError as collision:
                near = ways[max(collision.token - 1, 0) : collision.token + 1]
                beside = [forms for forms in near if len(forms) > 1]
                if not beside:
                    raise
                for forms in beside:
                    forms.pop()

    def plan_opening(
        self, tokens: Sequence[Token], start: State, *, lasting: float
    ) -> tuple[Plan, float] | None:
        """The first motion of a sentence, in a small part of the time that planning it takes.

        Args:
            tokens: What is to be signed.
            start: State of the commanded joints, at a standstill.
            lasting: Time after which the plan of the whole sentence will take over [s].

        Returns:
            A motion towards the first sign that ends at a standstill, and the time at which the plan of the
            whole sentence is to take over [s]: `lasting`, or less where the first sign is near. None if there
            is no such motion that is known to be safe, or it is not worth while.

        Raises:
            PlanError: The sentence cannot be signed; the code says why.
        """
        begin = self._checked(start)
        captured = self._lexicon.resolve(tokens)
        signed = choose_postures(captured, start=begin.position, end=self._rest, limits=self.limits)
        composition = compose(signed[:1], start=begin, limits=self.limits, style=self.style, rest=self._rest)
        for share in _OPENING_SHARES:
            found = opening(
                composition,
                limits=self.limits,
                period=self._period,
                lasting=share * lasting,
                motion_clearance=self._motion_clearance,
                least_clearance=self._least_clearance,
            )
            if found is not None:
                return found
        return None

    def plan_to_rest(self, start: State) -> Plan:
        """Plan the way to rest from any state, moving ones included.

        Raises:
            PlanError: There is no way that keeps the limits and the clearance; the code says why.
        """
        begin = self._checked(start)
        return self._avoidance.plan(
            compose((), start=begin, limits=self.limits, style=self.style, rest=self._rest)
        )

    def _checked(self, start: State | None) -> State:
        """The state to plan from, moved onto the limits where it is a little beyond them."""
        joints = len(self.limits.names)
        if start is None:
            return State.still(self._rest)
        for name, values in start._asdict().items():
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
        bounds = self.limits
        return State(
            position=position,
            velocity=np.clip(start.velocity, -bounds.velocity, bounds.velocity),
            acceleration=np.clip(start.acceleration, -bounds.acceleration, bounds.acceleration),
        )


def _distinct(*forms: SignedToken) -> list[SignedToken]:
    """The forms of a token, each but those that are the one before them."""
    return [forms[0], *(form for before, form in pairwise(forms) if form is not before)]


def sign_motion(planner: Planner, sign: Sign, *, period: float = DEFAULT_PERIOD) -> SignMotion:
    """Plan one sign as a robot plays it alone: from rest over the sign, slowed down where need be, to rest.

    Args:
        planner: It must sign entries of any standing, or a word is spelled instead.
        sign: An entry of the planner's table.
        period: Time between two rows [s].

    Raises:
        LutError: The period is outside `_PERIOD_RANGE` ("bad_period").
        PlanError: The sign cannot be planned.
    """
    least, most = _PERIOD_RANGE
    if not least <= period <= most:
        raise LutError("bad_period", f"period: expected {least:g} to {most:g} s, got {period}")
    plan = planner.plan([Token(gloss=sign.gloss, kind=Kind[sign.kind.upper()])])
    if len(plan.timings) != 1 or plan.timings[0].token.gloss != sign.gloss:
        raise LutError(
            "not_signed", f"{sign.gloss}: expected a planner that signs every standing, got the word spelled"
        )
    moving = {
        name
        for name, column in zip(plan.names, np.ptp(plan.positions, axis=0).tolist(), strict=True)
        if column > _STILL
    }
    humanoid = planner.limits.humanoid
    limbs = {limb: joints for limb, joints in humanoid.limbs.items() if not moving.isdisjoint(joints)}
    columns = humanoid.columns(joint for joints in limbs.values() for joint in joints)
    rows = math.ceil(plan.duration / period - 1e-9) + 1
    times: Array = np.arange(rows, dtype=np.float64) * period
    positions = sample_at(plan.motions, times).positions[:, columns].copy()
    positions[-1] = plan.positions[-1, columns]
    for array in (times, positions):
        array.setflags(write=False)
    timing = plan.timings[0]
    return SignMotion(
        sign=sign,
        limbs=limbs,
        times=times,
        positions=positions,
        start=timing.start,
        duration=timing.duration,
        stretch=timing.stretch,
    )
