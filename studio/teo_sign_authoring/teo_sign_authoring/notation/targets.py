# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A score as postures in a robot's space: when each hand is where, turned how, in which shape."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from teo_common.arrays import Array
from teo_description.humanoid import Side
from teo_description.robot import Robot
from teo_sign_authoring.notation.score_schema import Circle, HandScore, Part, Score, Step, Wiggle, flattened
from teo_sign_capture.retarget.handshapes import handshape
from teo_sign_capture.signing_space import OTHER_HAND, direction, displacement, find_place, split_place

# [m] A hand that is farther than this from its place on the body is before it, not on it: its orientation
# counts as in the air.
_ON_BODY = 0.10
# Postures on a circle's round: the straight lines between them stay within 8 % of the radius of it.
_PER_TURN = 8


@dataclass(frozen=True, kw_only=True)
class HandTarget:
    """What is wanted of a hand, seen as a right hand.

    Attributes:
        shape: The axes of the hand [rad]. Shape (axes,).
        part: Part of the hand that is at the place.
        other: Name of the place on the other hand that `point` is relative to; empty for `base_link`.
        point: Where the part is [m]. Shape (3,).
        outward: Way out of the body there, unit vector. Shape (3,).
        body: Whether the place is on the body or the other hand.
        palm: Way the palm faces, unit vector. Shape (3,).
        fingers: Way from wrist to knuckles, unit vector. Shape (3,).
    """

    shape: Array
    part: Part
    other: str
    point: Array
    outward: Array
    body: bool
    palm: Array
    fingers: Array

    @property
    def meets(self) -> bool:
        """Whether the hand meets something there: it is on a body, or a part of it is named for the place."""
        return self.body or self.part != "palm"


@dataclass(frozen=True, kw_only=True)
class Posture:
    """A moment of a sign.

    Attributes:
        time: From its beginning [s].
        right: What is wanted of the right hand.
        left: What is wanted of the left hand, as the right hand that it mirrors; None if it takes no part.
        turn: Head towards the right, bow: forward [rad].
        swings: Joint offsets to and fro: name of a wiggle's joint and its offset [rad].
        swinging: The hand whose joints swing; None for all that take part.
    """

    time: float
    right: HandTarget
    left: HandTarget | None
    turn: float
    bow: float
    swings: tuple[tuple[str, float], ...] = ()
    swinging: Side | None = None


def postures(robot: Robot, score: Score) -> list[Posture]:
    """All moments of a score on a robot, in order of time."""
    made: list[Posture] = []
    right = left = None
    turn = bow = time = 0.0
    for step in flattened(score.steps):
        right = _target(robot, right, step.right)
        if score.hands == "both":
            left = _target(robot, left, step.left)
        elif score.hands == "mirrored":
            left = right
        if step.head is not None:
            turn, bow = np.radians(step.head.turn), np.radians(step.head.bow)
        now = Posture(time=0.0, right=right, left=left, turn=float(turn), bow=float(bow))
        if made:
            time += step.time
            if step.arc is not None:
                made.append(_swung_out(made[-1], now, displacement(step.arc) * 0.01, time - step.time / 2.0))
        made.append(replace(now, time=time))
        made += [replace(later, time=time + later.time) for later in _movement(now, step)]
        time = made[-1].time + step.hold
        if step.hold:
            made.append(replace(made[-1], time=time))
    return made


def _target(robot: Robot, before: HandTarget | None, hand: HandScore | None) -> HandTarget:
    """A hand's target from what the score says, and from the step before where it says nothing."""
    if hand is None:
        assert before is not None, "the schema asks for a first step that says everything"
        return before
    fields = {} if before is None else dict(vars(before))
    if hand.shape is not None:
        fields["shape"] = handshape(robot, hand.shape)
    if hand.place is not None:
        name, offset = split_place(hand.place)
        if name in OTHER_HAND:
            fields |= {"other": name, "point": offset, "outward": np.array([1.0, 0.0, 0.0]), "body": True}
        else:
            place = find_place(robot.humanoid, name)
            fields |= {
                "other": "",
                "point": place.point + offset,
                "outward": place.outward,
                "body": place.body and float(np.linalg.norm(offset)) <= _ON_BODY,
            }
    if hand.palm is not None:
        fields["palm"] = direction(hand.palm)
    if hand.fingers is not None:
        fields["fingers"] = direction(hand.fingers)
    if hand.part is not None or before is None:
        fields["part"] = hand.part or "palm"
    fields["fingers"] = fingers_across(fields["palm"], fields["fingers"])
    return HandTarget(**fields)


def fingers_across(palm: Array, fingers: Array) -> Array:
    """The way at right angles with the palm's that is nearest to the fingers', unit vector. Shape (3,).

    Words are rough: the palm is as said, the fingers as near to what is said as a hand allows.
    """
    along = fingers - (fingers @ palm) * palm
    return along / np.linalg.norm(along)


def _swung_out(first: Posture, second: Posture, swing: Array, time: float) -> Posture:
    def between(one: HandTarget, other: HandTarget) -> HandTarget:
        if one.other != other.other:
            return other
        return replace(
            other,
            point=(one.point + other.point) / 2.0 + swing,
            palm=_middle(one.palm, other.palm),
            fingers=_middle(one.fingers, other.fingers),
            shape=(one.shape + other.shape) / 2.0,
        )

    left = None if first.left is None or second.left is None else between(first.left, second.left)
    return replace(second, time=time, right=between(first.right, second.right), left=left)


def _middle(one: Array, other: Array) -> Array:
    total = one + other
    length = float(np.linalg.norm(total))
    return other if length < 0.2 else np.asarray(total / length)


def _movement(posture: Posture, step: Step) -> Iterator[Posture]:
    """What follows the posture of a step: a circle, a wiggle; times from the posture on."""
    start = 0.0
    if step.circle is not None:
        count = round(_PER_TURN * step.circle.turns)
        for index, offset in enumerate(circle_offsets(step.circle, count), start=1):
            moved = [
                # On a circle the place counts as on the body: its shape is what is read.
                hand
                if hand is None or step.circle.hand not in (None, side)
                else replace(hand, point=hand.point + offset, body=True)
                for side, hand in (("right", posture.right), ("left", posture.left))
            ]
            assert moved[0] is not None
            yield replace(posture, time=step.circle.time * index / count, right=moved[0], left=moved[1])
        start = step.circle.time
    if step.wiggle is not None:
        for time, swings in _wiggle(step.wiggle):
            yield replace(posture, time=start + time, swings=swings, swinging=step.wiggle.hand)


def circle_offsets(circle: Circle, count: int) -> Array:
    """Ways from where a circle begins, evenly in time, the last at its end [m]. Shape (count, 3)."""
    axes = {"front": ("up", "out"), "side": ("up", "front"), "top": ("front", "out")}[circle.plane]
    first, second = (direction(word) for word in axes)
    begin = direction(circle.start)
    angle = float(np.arctan2(begin @ second, begin @ first))
    turn = 1.0 if circle.clockwise else -1.0
    now = angle + turn * 2.0 * np.pi * circle.turns * np.arange(1, count + 1)[:, None] / count
    around = np.cos(now) * first + np.sin(now) * second - np.cos(angle) * first - np.sin(angle) * second
    offsets: Array = 0.01 * circle.radius * around
    return offsets


_FINGER_NAMES = ("index", "middle", "ring", "little")


def _wiggle(wiggle: Wiggle) -> Iterator[tuple[float, tuple[tuple[str, float], ...]]]:
    angle, count = np.radians(wiggle.angle), 2 * wiggle.times
    for index in range(1, count + 1):
        bent = index % 2 == 1
        if wiggle.joint == "fingers":
            # Every other finger, so that they flutter.
            swings = tuple(
                (name, angle if bent == (place % 2 == 0) else 0.0) for place, name in enumerate(_FINGER_NAMES)
            )
        else:
            swings = ((wiggle.joint, angle if bent else 0.0),)
        yield wiggle.time * index / count, swings
