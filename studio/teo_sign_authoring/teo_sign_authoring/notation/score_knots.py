# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Postures as knots of a sign: the arms that were found, hands as shaped, what wiggles, the head."""

from __future__ import annotations

import numpy as np

from teo_common.arrays import Array
from teo_description.hand_contact import TOUCH, thumb_gaps, with_clear_thumb
from teo_description.hand_geometry import hand_table
from teo_description.humanoid import Side
from teo_description.robot import Robot
from teo_sign_authoring.notation.arm_solver import ArmCandidate
from teo_sign_authoring.notation.score_schema import Hands
from teo_sign_authoring.notation.targets import HandTarget, Posture
from teo_sign_capture.retarget.arm_kinematics import (
    ArmKinematics,
    Bounds,
    arm_bounds,
    mirrored,
    mirrored_hand,
)
from teo_sign_capture.retarget.hand_motion import axis_shares
from teo_sign_capture.signing_space import finger_rows

# Fingers that swing, index 0.
_FINGERS = ("index", "middle", "ring", "little")


class ScoreKnots:
    """Makes knots on one robot."""

    def __init__(self, robot: Robot, chain: ArmKinematics) -> None:
        """Prepare.

        Args:
            robot: The robot.
            chain: Its arm.
        """
        self._humanoid, self._table = robot.humanoid, hand_table(robot)
        self._bounds: dict[Side, Bounds] = {
            "right": arm_bounds(robot.humanoid, "right"),
            "left": arm_bounds(robot.humanoid, "left"),
        }
        bending = np.flatnonzero(chain.sideways)
        self._arm_swings = {
            "wrist": int(bending[0]) if bending.size else chain.wrist,
            "forearm": chain.turn,
            "elbow": chain.elbow,
        }
        rows = finger_rows(self._table.hand)
        self._hand_swings = {"thumb": 1} | {_FINGERS[row]: 2 + at for at, row in enumerate(rows)}
        self._swing_sizes = np.concatenate([np.ones(2), axis_shares(self._table)])

    def of(
        self,
        hands: Hands,
        moments: list[Posture],
        rights: list[ArmCandidate],
        lefts: list[ArmCandidate],
    ) -> tuple[tuple[str, ...], Array]:
        """Joints that take part, and their positions at every moment [rad]. Shape (moments, joints).

        Args:
            hands: Which take part.
            moments: The postures.
            rights: The right arm at each.
            lefts: The left arm at each, seen as a right one; empty where it mirrors the right or takes no
                part.
        """
        humanoid = self._humanoid
        joints = humanoid.arm("right") + humanoid.hand("right")
        rows = [
            self._limb(moment, moment.right, candidate, "right")
            for moment, candidate in zip(moments, rights, strict=True)
        ]
        if hands != "right":
            joints += humanoid.arm("left") + humanoid.hand("left")
            others = [
                self._limb(moment, moment.left, candidate, "left")
                for moment, candidate in zip(moments, lefts or rights, strict=True)
            ]
            rows = [np.concatenate([row, other]) for row, other in zip(rows, others, strict=True)]
        if any(moment.turn or moment.bow for moment in moments):
            joints += humanoid.head
            rows = [
                np.concatenate([row, self._head(moment)]) for row, moment in zip(rows, moments, strict=True)
            ]
        return joints, np.array(rows)

    def with_clear_thumbs(self, joints: tuple[str, ...], knot: Array) -> Array:
        """A knot [rad] whose thumbs keep out of the fingers. Shape (joints,)."""
        clear = knot.copy()
        right, left = (self._humanoid.hand(side) for side in ("right", "left"))
        if right[0] in joints:
            columns = [joints.index(name) for name in right]
            clear[columns] = with_clear_thumb(self._table, knot[columns])
        if left[0] in joints:
            columns = [joints.index(name) for name in left]
            hand = with_clear_thumb(self._table, mirrored_hand(self._humanoid, knot[columns]))
            clear[columns] = mirrored_hand(self._humanoid, hand)
        return clear

    def _head(self, moment: Posture) -> list[float]:
        """Joints of the head [rad]; towards the right is a negative turn about the upward axis."""
        ways = {"yaw": -moment.turn, "pitch": moment.bow, "roll": 0.0}
        return [ways[way] for way in self._humanoid.file.groups.head]

    def _limb(self, moment: Posture, target: HandTarget | None, candidate: ArmCandidate, side: Side) -> Array:
        """Arm and hand in a moment [rad]. Shape (arm's and hand's joints,)."""
        assert target is not None
        arm, hand = candidate.positions.copy(), target.shape.copy()
        limits = self._table.hand.limits
        lower, upper = self._bounds[side]
        for name, angle in moment.swings if moment.swinging in (None, side) else ():
            if name in self._arm_swings:
                index = self._arm_swings[name]
                arm[index] = _swings(arm[index], angle, lower[index], upper[index])[0]
            elif name in self._hand_swings:
                index = self._hand_swings[name]
                size = angle * self._swing_sizes[index]
                hand = self._with_swing(
                    hand, index, _swings(hand[index], size, limits.lower[index], limits.upper[index])
                )
        hand = with_clear_thumb(self._table, hand)
        if side == "left":
            arm, hand = mirrored(self._humanoid, arm), mirrored_hand(self._humanoid, hand)
        return np.concatenate([arm, hand])

    def _with_swing(self, hand: Array, index: int, swings: tuple[float, float]) -> Array:
        """A hand of which one axis has swung; the other way if only on this one thumb and fingers meet."""
        hands = np.tile(hand, (2, 1))
        hands[:, index] = swings
        this_way, other_way = thumb_gaps(self._table, hands) >= -TOUCH
        back: Array = hands[1 if other_way and not this_way and swings[1] != hand[index] else 0]
        return back


def _swings(position: float, angle: float, lower: float, upper: float) -> tuple[float, float]:
    """Where a joint is that has swung: to the side where it has more room, and to the other."""
    up, down = position + min(angle, upper - position), position - min(angle, position - lower)
    return (up, down) if upper - position >= position - lower else (down, up)
