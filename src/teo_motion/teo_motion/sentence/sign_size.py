# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Makes signs smaller for which a robot is too slow, and repeats them less often.

A sign keeps its shape when it is made smaller, as people do who sign fast or to someone near; made slowly it
falls apart into postures. A sign that would take longer than asked for is therefore drawn together around
its centre: arms, trunk, and fingers that come back to where they were, as in a wiggle. A handshape that opens
once is kept: half open it is another one. So are places and palms that differ: no hand moves or turns further
than what a reader takes for the same. A sign that touches is drawn together around the contact, one that
touches in several postures is left as large as it is. Fingers that come back keep their size where half of
their way would have the thumb in a finger. What is repeated more than twice is repeated twice:
that it repeats is told by the second time. Where that is not enough, fingers begin a way before a knot and
end it after.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from itertools import pairwise
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from teo_common.arrays import Array
from teo_description.hand_geometry import TOUCH, hand_table, thumb_gaps
from teo_description.robot import Robot
from teo_motion.trajectory.limits import MotionLimits
from teo_signs.lexicon import SignedToken
from teo_signs.sign import Sign
from teo_signs.tokens import Kind

# A hand and what is nearer to it than this touch, or are meant to [m]: those that touch stand off by up to 22
# mm, as the shapes that must not overlap are larger than the parts.
_CONTACT = 0.025

# Parts whose fingers flow stay so far apart [m]: as near as entries come, less what a motion swings out.
_CLEAR = 0.005

# Postures that are looked at from a knot to the next, both included [1].
_BETWEEN = 5

# Postures closer than this are the same [rad]: 3 deg, 2 cm at the hand.
_SAME = 0.05

# A repetition goes at least this far away before it comes back [rad]: twice of what is the same.
_AWAY = 0.1

# How often a sign does what it repeats [1].
_REPETITIONS = 2

# Mean speed of a stroke over its joint's greatest [1]: a joint that speeds up and slows down over the whole
# stroke, as the least-jerk motion does, is at 8/15 of its peak on average; strokes that go on stop less.
_MEAN_SPEED = 0.7

# How far a hand may be from where the entry has it [m], and how far its palm may be turned [rad]: what
# letters are allowed in their easy postures. 15 deg are just seen.
_SHIFT, _TURN = 0.08, np.radians(15.0)

# Steps in which signs are made smaller [1].
_STEP = 0.1


class SignSize:
    """Fits the size of signs to the time that they have."""

    def __init__(self, robot: Robot, *, limits: MotionLimits, least: float) -> None:
        """Prepare.

        Args:
            robot: Not shared with another thread.
            limits: Limits of the commanded joints.
            least: The smallest size that a sign is given, 0 to 1; 1 leaves every sign as it is.
        """
        self._robot = robot
        self._table = hand_table(robot)
        self._limits = limits
        humanoid = robot.humanoid
        self._arms_and_trunk = {*humanoid.trunk, *humanoid.arm("left"), *humanoid.arm("right")}
        self._each_hand = humanoid.hand("left"), humanoid.hand("right")
        self._hands = {joint for hand in self._each_hand for joint in hand}
        palm = humanoid.file.hand.palm
        self._palm_frames = humanoid.mirrored_name(palm), palm
        self._sizes = tuple(np.arange(1.0 - _STEP, least - 1e-9, -_STEP).tolist())
        self._touching: WeakKeyDictionary[Sign, NDArray[np.bool_]] = WeakKeyDictionary()

    def fitted(
        self, signed: Sequence[SignedToken], captured: Sequence[SignedToken]
    ) -> tuple[SignedToken, ...]:
        """Words in the largest size that the robot makes in their time, or in the smallest allowed.

        Args:
            signed: Signs and pauses, each sign in the posture that was chosen for it.
            captured: The same as their entries have them, from which a smaller sign is not to differ.
        """
        return tuple(self._fitted(item, entry.sign) for item, entry in zip(signed, captured, strict=True))

    def _fitted(self, item: SignedToken, captured: Sign | None) -> SignedToken:
        sign = item.sign
        if sign is None or captured is None or item.token.kind != Kind.LEXICAL or item.token.spelled:
            return item
        scale = item.token.duration_scale
        if not self._sizes or self._fits(sign, scale):
            return item
        centre = self._centre(sign, captured)
        kept, times = _repeated_twice(captured)
        sign = _with_knots(sign, sign.knots[kept], times)
        if centre is not None:
            palms = self._palms(_with_knots(captured, captured.knots[kept], times))
            sign = self._smaller(sign, palms, centre, scale)
        if not self._fits(sign, scale):
            flowing = self._flowing(sign, 1.0 - self._sizes[-1])
            if not self._touches(_with_between(flowing), _CLEAR).any():
                sign = flowing
        return dataclasses.replace(item, sign=sign)

    def _smaller(self, sign: Sign, palms: Array, centre: Array, scale: float) -> Sign:
        """The largest size that fits, or the smallest that is taken for the same sign as those palms show.

        Where palms may not differ any more, fingers still come down; where a thumb would be in one, arms do.
        """
        found, arms, hands = sign, 1.0, 1.0
        least_gap = min(-TOUCH, self._thumb_gap(sign))
        for size in self._sizes:
            if self._thumb_gap(self._drawn_together(sign, centre, arms=1.0, hands=size)) >= least_gap:
                hands = size
            smaller = self._drawn_together(sign, centre, arms=size, hands=hands)
            if _look_the_same(palms, self._palms(smaller)):
                arms = size
            else:
                smaller = self._drawn_together(sign, centre, arms=arms, hands=hands)
            if self._touches(smaller, 0.0).any():
                break
            found = smaller
            if self._fits(found, scale):
                break
        return found

    def _thumb_gap(self, sign: Sign) -> float:
        """Least distance of a thumb from the fingers of its hand at a knot [m]; negative is overlap."""
        hands = (
            sign.knots[:, [sign.joints.index(name) for name in hand]]
            for hand in self._each_hand
            if set(hand) <= set(sign.joints)
        )
        return min((float(thumb_gaps(self._table, hand).min()) for hand in hands), default=np.inf)

    def _palms(self, sign: Sign) -> Array:
        """Poses of both palms at every knot. Shape (n, 2, 4, 4)."""
        return np.stack(
            [
                self._robot.placements(self._robot.configuration(sign.pose(knot)), self._palm_frames)
                for knot in range(len(sign.knots))
            ]
        )

    def _fits(self, sign: Sign, scale: float) -> bool:
        """Whether the joints are fast enough for a sign, about."""
        speed = _MEAN_SPEED * self._limits.velocity[self._limits.humanoid.columns(sign.joints)]
        needed = (np.abs(np.diff(sign.knots, axis=0)) / speed).max(axis=1)
        asked = np.diff(sign.times) * scale
        return bool(np.maximum(needed, asked).sum() <= asked.sum())

    def _centre(self, sign: Sign, captured: Sign) -> Array | None:
        """The posture around which a sign is drawn together; None where it touches in several.

        It touches where its entry does, in whatever posture.
        """
        touching = self._touching.get(captured)
        if touching is None:
            touching = self._touching.setdefault(captured, self._touches(captured, _CONTACT, meant=True))
        if not touching.any():
            middle: Array = (sign.knots.min(axis=0) + sign.knots.max(axis=0)) / 2.0
            return middle
        contacts = sign.knots[touching]
        return contacts[0] if np.abs(contacts - contacts[0]).max() < _SAME else None

    def _touches(self, sign: Sign, distance: float, *, meant: bool = False) -> NDArray[np.bool_]:
        """Which knots bring parts nearer than a distance [m]: any, or such as may be meant to. Shape (n,)."""
        touching = np.zeros(len(sign.knots), dtype=bool)
        for index, knot in enumerate(sign.knots):
            if index and (knot == sign.knots[index - 1]).all():
                touching[index] = touching[index - 1]
            else:
                q = self._robot.configuration(sign.pose(index))
                near = self._robot.contacts(q, distance)
                touching[index] = any(not meant or item.may_be_meant for item in near)
        return touching

    def _drawn_together(self, sign: Sign, centre: Array, *, arms: float, hands: float) -> Sign:
        """A sign whose arms, with the trunk, and fingers that come back are of some size [1]."""
        knots, sizes = sign.knots, np.ones(len(sign.joints))
        for index, name in enumerate(sign.joints):
            if name in self._arms_and_trunk:
                sizes[index] = arms
            elif name in self._hands and len(_returns(knots[:, [index]], 0)) > 1:
                sizes[index] = hands
        knots = knots + (1.0 - sizes) * (centre - knots)
        return _with_knots(sign, knots, sign.times)

    def _flowing(self, sign: Sign, share: float) -> Sign:
        """A sign whose fingers begin their way before a knot and end it after, by a share of it [1].

        Fingers that fold one after the other then move together for a while, as people's do, and those that
        come back go less far; how the hand begins and ends stays.
        """
        knots = sign.knots.copy()
        columns = [index for index, name in enumerate(sign.joints) if name in self._hands]
        inner = knots[1:-1, columns]
        knots[1:-1, columns] = inner + share * ((knots[:-2, columns] + knots[2:, columns]) / 2.0 - inner)
        return _with_knots(sign, knots, sign.times)


def _look_the_same(first: Array, second: Array) -> bool:
    """Whether palms are where and as others are. Shape (n, 2, 4, 4) each."""
    shifts = np.linalg.norm(first[..., :3, 3] - second[..., :3, 3], axis=-1)
    # Trace of the rotation from one to the other: 1 + 2 cos of its angle.
    traces = (first[..., :3, :3] * second[..., :3, :3]).sum(axis=(-2, -1))
    return bool((shifts <= _SHIFT).all() and (traces >= 1.0 + 2.0 * np.cos(_TURN)).all())


def _with_between(sign: Sign) -> Sign:
    """A sign with more knots, on the straight lines between its own."""
    times = np.concatenate([np.linspace(a, b, _BETWEEN) for a, b in pairwise(sign.times.tolist())])
    knots = np.column_stack([np.interp(times, sign.times, column) for column in sign.knots.T])
    return _with_knots(sign, knots, times)


def _with_knots(sign: Sign, knots: Array, times: Array) -> Sign:
    """A sign with other knots, and without alternatives."""
    for array in (knots, times):
        array.setflags(write=False)
    return dataclasses.replace(sign, knots=knots, times=times, alternatives=())


def _repeated_twice(sign: Sign) -> tuple[NDArray[np.intp], Array]:
    """The knots of a sign without what it does a third time and more, and their times [s]."""
    kept, times = np.arange(len(sign.knots)), sign.times
    first = 0
    while first < len(kept):
        returns = _returns(sign.knots[kept], first)
        if len(returns) <= _REPETITIONS + 1:
            first += 1
            continue
        begin, end = returns[_REPETITIONS], returns[-1]
        kept = np.concatenate((kept[: begin + 1], kept[end + 1 :]))
        times = np.concatenate((times[: begin + 1], times[end + 1 :] - (times[end] - times[begin])))
        first = begin + 1
    return kept, times


def _returns(knots: Array, first: int) -> list[int]:
    """Knots at which a sign is where it was at one of them, each time after it had gone away."""
    away = np.abs(knots[first:] - knots[first]).max(axis=1)
    found, gone = [first], False
    for index, distance in enumerate(away.tolist()):
        if gone and distance < _SAME:
            found.append(first + index)
            gone = False
        gone = gone or distance > _AWAY
    return found
