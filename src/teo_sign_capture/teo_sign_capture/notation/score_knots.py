# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Postures as knots of a sign: the arms that were found, hands as shaped, what wiggles, the head."""

from __future__ import annotations

import numpy as np

from teo_common.arrays import Array
from teo_description import HEAD, LEFT_ARM, LEFT_HAND, RIGHT_ARM, RIGHT_HAND, joint_limits
from teo_sign_capture.notation.arm_solver import ArmCandidate
from teo_sign_capture.notation.score_schema import Score
from teo_sign_capture.notation.targets import HandTarget, Posture
from teo_sign_capture.retarget.arm_bounds import Side, arm_bounds, mirrored

_ARM_SWINGS = {"wrist": 5, "forearm": 4, "elbow": 3}
_HAND_SWINGS = {"thumb": 1, "index": 2, "middle": 3, "ring": 4, "little": 5}


def knots_of(
    score: Score, moments: list[Posture], rights: list[ArmCandidate], lefts: list[ArmCandidate]
) -> tuple[tuple[str, ...], Array]:
    """Joints that take part, and their positions at every moment [rad]. Shape (moments, joints).

    Args:
        score: What is performed.
        moments: Its postures.
        rights: The right arm at each.
        lefts: The left arm at each, seen as a right one; empty where it mirrors the right or takes no part.
    """
    joints = RIGHT_ARM + RIGHT_HAND
    rows = [
        _limb(moment, moment.right, candidate, "right")
        for moment, candidate in zip(moments, rights, strict=True)
    ]
    if score.hands != "right":
        joints += LEFT_ARM + LEFT_HAND
        others = [
            _limb(moment, moment.left, candidate, "left")
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


def _limb(moment: Posture, target: HandTarget | None, candidate: ArmCandidate, side: Side) -> Array:
    """Arm and hand in a moment [rad]. Shape (12,)."""
    assert target is not None
    arm, hand = candidate.positions.copy(), target.shape.copy()
    hand_limits = joint_limits(RIGHT_HAND)
    lower, upper = arm_bounds(side)
    for name, angle in moment.swings if moment.swinging in (None, side) else ():
        if name in _ARM_SWINGS:
            index = _ARM_SWINGS[name]
            arm[index] = _swung(arm[index], angle, lower[index], upper[index])
        else:
            index = _HAND_SWINGS[name]
            hand[index] = _swung(hand[index], angle, hand_limits.lower[index], hand_limits.upper[index])
    return np.concatenate([mirrored(arm) if side == "left" else arm, hand])


def _swung(position: float, angle: float, lower: float, upper: float) -> float:
    """A joint that has swung, to the side where it has more room."""
    room_up, room_down = upper - position, position - lower
    return position + min(angle, room_up) if room_up >= room_down else position - min(angle, room_down)
