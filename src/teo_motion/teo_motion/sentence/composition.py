# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From signs to waypoints: the postures that a sentence passes through, from rest to rest.

Every knot of every sign is a waypoint, and so are the ends of holds and pauses. A waypoint fixes the joints
that the sign at hand uses and leaves the others free; `idle_limb_policy` decides what the free ones do.
Between two signs there is no waypoint, except between equal postures: the hands go straight from the last
knot of one to the first of the next, hand shape and arm together, and need not stop where the motion goes on.

Within a sign, a stroke is a run of knots through which it moves without standing still.

A sign fixes whole limbs: where it moves some joints of a head, trunk, arm or hand, the limb's other joints
are as in the hanging posture. An arm of which the sign moves the hand only stays where it is.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from teo_common.arrays import Array
from teo_motion.sentence.signing_style import SigningStyle
from teo_motion.trajectory.limits import MotionLimits
from teo_motion.trajectory.ruckig_segment import State
from teo_signs.errors import PlanError
from teo_signs.lexicon import SignedToken
from teo_signs.sign import Sign
from teo_signs.sign_file import LIMIT_TOLERANCE
from teo_signs.tokens import Token

# Names of `Humanoid.limbs`.
ARMS, HANDS = ("left_arm", "right_arm"), ("left_hand", "right_hand")
_ARM_OF_HAND = dict(zip(HANDS, ARMS, strict=True))

# Postures closer than this look the same [rad]: 3 deg, 2 cm at the hand.
_SAME_POSTURE = 0.05

# Knots closer than this to the last one are its hold, not movement [rad]: about half a degree.
_STILL = 0.01


@dataclass(frozen=True, kw_only=True)
class TokenSpan:
    """The waypoints between which a token is signed.

    Attributes:
        token: What is signed.
        first: Waypoint at which it begins.
        last: Waypoint at which it ends.
        asked: Time from one to the other as recorded, times the token's scale [s].
    """

    token: Token
    first: int
    last: int
    asked: float


@dataclass(frozen=True, kw_only=True)
class IdleSpan:
    """Waypoints between which a limb is not used: fixed at both, free in between."""

    limb: str
    first: int
    last: int


@dataclass(frozen=True, kw_only=True, eq=False)
class Route:
    """Waypoints, and the signs between them.

    Attributes:
        targets: Positions [rad], NaN where a joint is on its way. Shape (n, joints); the first row is the
            start.
        nominal: Least time from each waypoint to the next, as recorded or by the style [s]. Shape (n - 1,).
        strokes: Number of the stroke to which each step from a waypoint to the next belongs: steps near each
            other in one stroke are stretched together. Shape (n - 1,).
        spans: Where each token is signed, in order.
        start: State of the joints at the first waypoint.
    """

    targets: Array
    nominal: Array
    strokes: NDArray[np.intp]
    spans: tuple[TokenSpan, ...]
    start: State

    def token_at(self, step: int) -> int | None:
        """Index of the token that is signed between a waypoint and the next; None between two signs."""
        for index, span in enumerate(self.spans):
            if span.first <= step < span.last:
                return index
        return None

    def with_waypoint(self, step: int, row: Array) -> Route:
        """Pass through another waypoint half way between two others.

        Args:
            step: The waypoint before it.
            row: Positions to pass through [rad], NaN where a joint goes on freely. Shape (joints,).
        """
        half = self.nominal[step] / 2.0
        return dataclasses.replace(
            self,
            targets=np.insert(self.targets, step + 1, row, axis=0),
            nominal=np.insert(
                np.concatenate((self.nominal[:step], [half], self.nominal[step + 1 :])), step, half
            ),
            strokes=np.insert(self.strokes, step, self.strokes[step]),
            spans=tuple(
                dataclasses.replace(
                    span, first=span.first + (span.first > step), last=span.last + (span.last > step)
                )
                for span in self.spans
            ),
        )

    def name_at(self, waypoint: int) -> str:
        """What the robot does at a waypoint, for people."""
        if waypoint == 0:
            return "the start"
        for span in self.spans:
            if span.first <= waypoint <= span.last:
                return f"the sign {span.token.gloss!r}" if span.token.gloss else "a pause"
        return "rest" if waypoint == len(self.targets) - 1 else "a posture between two signs"


@dataclass(frozen=True, kw_only=True, eq=False)
class Composition(Route):
    """A sentence as waypoints, at which the joints of limbs that are not used are free.

    Attributes:
        idle: Where limbs are not used.
        rest: Where idle limbs go, and all limbs at the end [rad]. Shape (joints,).
    """

    idle: tuple[IdleSpan, ...]
    rest: Array


def compose(
    signed: Sequence[SignedToken],
    *,
    start: State,
    limits: MotionLimits,
    style: SigningStyle,
    rest: Array,
    hold: float = 0.0,
) -> Composition:
    """Lay a sentence out, from a start to rest.

    Args:
        signed: Signs and pauses, in order; none for the way to rest alone.
        start: State of the commanded joints at the beginning.
        limits: Limits of the joints, which every waypoint keeps.
        style: Times of holds and pauses.
        rest: Where it ends [rad]. Shape (joints,).
        hold: Time for which limbs that stand still at the start stay there first [s].

    Raises:
        PlanError: A sign has a knot outside the limits ("sign_outside_limits").
    """
    composer = _Composer(start, limits, style, rest)
    composer.hold_start(hold)
    last_sign = max((index for index, item in enumerate(signed) if item.sign is not None), default=-1)
    for index, item in enumerate(signed):
        following = signed[index + 1] if index + 1 < len(signed) else None
        if item.sign is None:
            composer.add_pause(item.token)
        else:
            ends_word = item.token.spelled and not _same_word(item, following)
            composer.add_sign(item.token, item.sign, ends_word=ends_word, ends_sentence=index == last_sign)
            if ends_word and following is not None and following.sign is not None:
                composer.stay(style.word_pause)
    return composer.finish()


def _same_word(item: SignedToken, following: SignedToken | None) -> bool:
    return (
        following is not None
        and following.token.spelled
        and following.token.word_index == item.token.word_index
    )


def _stands_still(sign: Sign) -> float:
    """How long a sign itself holds its last posture [s]."""
    moving = np.flatnonzero(np.abs(sign.knots - sign.knots[-1]).max(axis=1) > _STILL)
    return sign.duration - float(sign.times[moving[-1] + 1]) if moving.size else sign.duration


class _Composer:
    """Adds waypoint after waypoint, and remembers where each limb was last."""

    def __init__(self, start: State, limits: MotionLimits, style: SigningStyle, rest: Array) -> None:
        self._start = start
        self._limits = limits
        self._robot = limits.humanoid
        self._limbs = limits.humanoid.limb_columns
        self._style = style
        self._rest = rest
        self._posture = start.position.copy()
        self._rows: list[Array] = [start.position.copy()]
        self._nominal: list[float] = []
        self._strokes: list[int] = []
        self._spans: list[TokenSpan] = []
        self._idle: list[IdleSpan] = []
        self._fixed_at = dict.fromkeys(self._limbs, 0)  # waypoint at which each limb was fixed last
        self._used: tuple[str, ...] = ()  # limbs of the latest sign
        self._signs = 0

    def add_sign(self, token: Token, sign: Sign, *, ends_word: bool, ends_sentence: bool) -> None:
        rows, limbs = self._rows_of(sign)
        if self._signs and self._looks_the_same(rows[0], limbs):
            self._release(limbs)
        self._fix(self._style.transition, rows[0], limbs)
        first = len(self._rows) - 1
        scale = token.duration_scale
        was_moving = False
        still = _stands_still(sign)
        if token.spelled:  # held by `letter_hold` instead, whatever the recording has
            rows = rows[: int(np.searchsorted(sign.times, sign.duration - still, side="right"))]
        for row, step in zip(rows[1:], np.diff(sign.times), strict=False):
            moves = bool(np.abs(row - self._posture).max() > _STILL)
            self._fix(float(step) * scale, row, limbs, same_stroke=moves and was_moving)
            was_moving = moves
        self._used = limbs
        self._signs += 1
        kept = 0.0 if token.spelled else still
        hold = self._hold(token, sign, ends_word=ends_word, ends_sentence=ends_sentence)
        self.stay(max(0.0, hold - kept) * scale)
        asked = (sign.duration - still + max(hold, kept)) * scale
        self._spans.append(TokenSpan(token=token, first=first, last=len(self._rows) - 1, asked=asked))

    def add_pause(self, token: Token) -> None:
        first = len(self._rows) - 1
        duration = self._style.pause * token.duration_scale
        self._fix(duration, self._posture, self._used)
        self._spans.append(TokenSpan(token=token, first=first, last=first + 1, asked=duration))

    def stay(self, duration: float) -> None:
        """Keep the limbs of the latest sign where they are [s]."""
        if duration > 0.0:
            self._fix(duration, self._posture, self._used)

    def hold_start(self, duration: float) -> None:
        """Keep the limbs that stand still at the start where they are [s]; the others are free."""
        still = tuple(limb for limb, columns in self._limbs.items() if self._start.of(columns).is_still)
        if duration > 0.0 and still:
            self._fix(duration, self._posture, still)

    def finish(self) -> Composition:
        self._fix(self._style.transition, self._rest, tuple(self._limbs))
        return Composition(
            targets=np.array(self._rows),
            nominal=np.array(self._nominal),
            strokes=np.array(self._strokes),
            spans=tuple(self._spans),
            idle=tuple(self._idle),
            start=self._start,
            rest=self._rest,
        )

    def _fix(
        self,
        nominal: float,
        posture: Array,
        limbs: tuple[str, ...],
        *,
        same_stroke: bool = False,
    ) -> None:
        """Add a waypoint at which these limbs are at the posture."""
        row = np.full(self._rest.size, np.nan)
        waypoint = len(self._rows)
        for limb in limbs:
            columns = self._limbs[limb]
            row[columns] = posture[columns]
            self._posture[columns] = posture[columns]
            if waypoint - self._fixed_at[limb] > 1:
                self._idle.append(IdleSpan(limb=limb, first=self._fixed_at[limb], last=waypoint))
            self._fixed_at[limb] = waypoint
        self._rows.append(row)
        self._nominal.append(nominal)
        self._strokes.append(self._strokes[-1] + (not same_stroke) if self._strokes else 0)

    def _rows_of(self, sign: Sign) -> tuple[Array, tuple[str, ...]]:
        """Knots of a sign as whole postures, and the limbs they fix."""
        columns = self._robot.columns(sign.joints)
        moved = {limb for limb, members in self._limbs.items() if not set(members).isdisjoint(columns)}
        held = {_ARM_OF_HAND[limb] for limb in moved & _ARM_OF_HAND.keys()} - moved
        posture = self._robot.hanging.copy()
        for limb in held:
            posture[self._limbs[limb]] = self._posture[self._limbs[limb]]
        rows = np.tile(posture, (len(sign.times), 1))
        lower, upper = self._limits.lower[columns], self._limits.upper[columns]
        # An entry keeps six decimals: half of the last one beyond the limit is the limit.
        rows[:, columns] = np.clip(sign.knots, lower, upper)
        outside = np.argwhere(np.abs(rows[:, columns] - sign.knots) > LIMIT_TOLERANCE)
        if outside.size:
            knot, joint = outside[0].tolist()
            raise PlanError(
                "sign_outside_limits",
                f"{sign.gloss}: knots[{knot}]: expected {sign.joints[joint]} within {lower[joint]:.4f} .. "
                f"{upper[joint]:.4f} rad, got {sign.knots[knot, joint]:.4f} rad",
            )
        return rows, tuple(limb for limb in self._limbs if limb in moved | held)

    def _hold(self, token: Token, sign: Sign, *, ends_word: bool, ends_sentence: bool) -> float:
        """How long the last posture is held in all [s], at a scale of 1."""
        still = _stands_still(sign)
        hold = still
        if token.spelled:
            hold = self._style.letter_hold * (self._style.last_letter_hold if ends_word else 1.0)
        elif still == sign.duration:
            hold = max(still, self._style.posture_hold)
        return max(hold, self._style.final_hold) if ends_sentence else hold

    def _looks_the_same(self, posture: Array, limbs: tuple[str, ...]) -> bool:
        columns = [column for limb in limbs for column in self._limbs[limb]]
        difference = np.abs(posture[columns] - self._posture[columns]).max()
        return set(limbs) == set(self._used) and bool(difference < _SAME_POSTURE)

    def _release(self, limbs: tuple[str, ...]) -> None:
        """Part two equal postures: the elbows in use open a little, where they can, or else close."""
        posture = self._posture.copy()
        used = {column for limb in limbs for column in self._limbs[limb]}
        for elbow in used.intersection(self._robot.columns(self._robot.elbows)):
            angle = self._style.repeat_angle
            # Towards the middle of the elbow's range, which for a raised forearm is opening it.
            middle = (self._limits.lower[elbow] + self._limits.upper[elbow]) / 2.0
            posture[elbow] += angle if posture[elbow] < middle else -angle
        self._fix(self._style.repeat_time, posture, limbs)
