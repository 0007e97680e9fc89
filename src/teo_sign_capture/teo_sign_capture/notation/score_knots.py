# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Postures as knots of a sign: the arms that were found, hands as shaped, what wiggles, the head."""

from __future__ import annotations

import numpy as np

from teo_common.arrays import Array
from teo_description import HEAD, LEFT_ARM, LEFT_HAND, RIGHT_ARM, RIGHT_HAND, joint_limits
from teo_description.hand_contact import TOUCH, thumb_gaps, with_clear_thumb
from teo_description.hand_geometry import DextraTable
from teo_sign_capture.notation.arm_solver import ArmCandidate
from teo_sign_capture.notation.score_schema import Score
from teo_sign_capture.notation.targets import HandTarget, Posture
from teo_sign_capture.retarget.arm_bounds import Side, arm_bounds, mirrored

_ARM_SWINGS = {"wrist": 5, "forearm": 4, "elbow": 3}
_HAND_SWINGS = {"thumb": 1, "index": 2, "middle": 3, "ring": 4, "little": 5}


def knots_of(
    score: Score,
    moments: list[Posture],
    rights: list[ArmCandidate],
    lefts: list[ArmCandidate],
    table: DextraTable,
) -> tuple[tuple[str, ...], Array]:
    """Joints that take part, and their positions at every moment [rad]. Shape (moments, joints).

    Args:
        score: What is performed.
        moments: Its postures.
        rights: The right arm at each.
        lefts: The left arm at each, seen as a right one; empty where it mirrors the right or takes no part.
        table: Where fingers and thumb are, so that thumbs keep out of the fingers.
    """
    joints = RIGHT_ARM + RIGHT_HAND
    rows = [
        _limb(moment, moment.right, candidate, "right", table)
        for moment, candidate in zip(moments, rights, strict=True)
    ]
    if score.hands != "right":
        joints += LEFT_ARM + LEFT_HAND
        others = [
            _limb(moment, moment.left, candidate, "left", table)
            for moment, candidate in zip(moments, lefts or rights, strict=True)
        ]
        rows = [np.concatenate([row, other]) for row, other in zip(rows, others, strict=True)]
    if any(moment.turn or moment.bow for moment in moments):
        joints += HEAD
        # Towards the right is a negative turn about the upward axis.
        rows = [
            np.concatenate([row, [-moment.turn, moment.bow]])
            for row, moment in zip(rows, moments, strict=True)
        ]
    return joints, np.array(rows)


def with_clear_thumbs(joints: tuple[str, ...], knot: Array, table: DextraTable) -> Array:
    """A knot [rad] whose thumbs keep out of the fingers. Shape (joints,)."""
    clear = knot.copy()
    for hand in (LEFT_HAND, RIGHT_HAND):
        if hand[0] in joints:
            columns = [joints.index(name) for name in hand]
            clear[columns] = with_clear_thumb(table, knot[columns])
    return clear


def _limb(
    moment: Posture, target: HandTarget | None, candidate: ArmCandidate, side: Side, table: DextraTable
) -> Array:
    """Arm and hand in a moment [rad]. Shape (12,)."""
    assert target is not None
    arm, hand = candidate.positions.copy(), target.shape.copy()
    hand_limits = joint_limits(RIGHT_HAND)
    lower, upper = arm_bounds(side)
    for name, angle in moment.swings if moment.swinging in (None, side) else ():
        if name in _ARM_SWINGS:
            index = _ARM_SWINGS[name]
            arm[index] = _swings(arm[index], angle, lower[index], upper[index])[0]
        else:
            index = _HAND_SWINGS[name]
            swings = _swings(hand[index], angle, hand_limits.lower[index], hand_limits.upper[index])
            hand = _with_swing(hand, index, swings, table)
    return np.concatenate([mirrored(arm) if side == "left" else arm, with_clear_thumb(table, hand)])


def _with_swing(hand: Array, index: int, swings: tuple[float, float], table: DextraTable) -> Array:
    """A hand of which one axis has swung; the other way if only on this one thumb and fingers meet."""
    hands = np.tile(hand, (2, 1))
    hands[:, index] = swings
    this_way, other_way = thumb_gaps(table, hands) >= -TOUCH
    back: Array = hands[1 if other_way and not this_way and swings[1] != hand[index] else 0]
    return back


def _swings(position: float, angle: float, lower: float, upper: float) -> tuple[float, float]:
    """Where a joint is that has swung: to the side where it has more room, and to the other."""
    up, down = position + min(angle, upper - position), position - min(angle, position - lower)
    return (up, down) if upper - position >= position - lower else (down, up)
