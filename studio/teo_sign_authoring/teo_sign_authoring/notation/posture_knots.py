# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Postures as knots of a sign: arms that bring hands where they are wanted, hands as shaped, the head.

What is traded against what follows what carries meaning in a sign: the place first, on the body above all;
then the way the palm faces; then the way the fingers point. TEO's wrist, for one, bends sideways only: not
every hand that a person can hold is within reach; what is left over is measured and reported with the sign.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from teo_common.arrays import Array
from teo_common.dynamic_programming import cheapest_path
from teo_description.hand_geometry import TOUCH, HandGeometry, hand_table, thumb_gaps, with_clear_thumb
from teo_description.humanoid import Side
from teo_description.robot import Robot
from teo_sign_authoring.notation.score_schema import Hands
from teo_sign_authoring.notation.targets import HandTarget, Posture
from teo_sign_capture.retarget.arm_kinematics import (
    ArmKinematics,
    Bounds,
    angles_between,
    arm_bounds,
    mirrored,
    mirrored_hand,
    search_starts,
    with_elbow_out,
)
from teo_sign_capture.retarget.arm_residuals import ArmProblem, ArmWeights
from teo_sign_capture.retarget.arm_trajectory import search_arms
from teo_sign_capture.retarget.hand_goals import HandGoals
from teo_sign_capture.retarget.hand_motion import axis_shares
from teo_sign_capture.signing_space import finger_rows

_WEIGHTS = ArmWeights(
    # 10 cm beside a place count as much as 80 deg of orientation where a hand meets something, as 29 deg in
    # the air. TEO's mouth and chin are 28 mm apart: with 14 the hands of the table's signs come within 11 mm
    # of their places on the mean, with 8 within 26 mm, for 2 deg of the palm and 4 deg of the fingers.
    in_air=np.full(3, 5.0),
    on_body=14.0,
    palm=1.0,
    fingers=0.7,
    # Chooses among equals, moves a reachable hand by less than 1 deg.
    easy=0.03,
    sideways=0.03,
)
# What a radian of way from one posture to the next costs [1/rad^2]: of two arms that do as well, the one that
# need not swing about.
_NEARNESS = 0.08
# Arms that differ by less in every joint are the same [rad].
_SAME = np.radians(2.0)


@dataclass(frozen=True, kw_only=True)
class ArmCandidate:
    """An arm for a target, seen as a right arm.

    Attributes:
        positions: The joints of the arm [rad]. Shape (j,).
        palm_error: Angle between the ways the palm faces and should face [rad].
        finger_error: The same of the way the fingers point [rad].
        cost: What the search made small.
    """

    positions: Array
    palm_error: float
    finger_error: float
    cost: float


class ArmSolver:
    """Finds arms for targets on one robot."""

    def __init__(self, robot: Robot, chain: ArmKinematics) -> None:
        self._chain = chain
        self._hand = HandGeometry(robot)

    def candidates(self, targets: Sequence[HandTarget], bounds: Bounds) -> list[list[ArmCandidate]]:
        """The arms for each target at which the search ends, one for each valley, the best first."""
        goals = _goals(targets, np.array([self.part(target) for target in targets]))
        problem = ArmProblem(self._chain, (goals,), weights=_WEIGHTS)
        starts, frames = search_starts(self._chain.humanoid), np.arange(len(targets))
        found, costs = search_arms(problem, 0, frames, bounds, starts=starts)
        out = with_elbow_out(self._chain.humanoid, bounds)
        if out is not None:
            others, prices = search_arms(problem, 0, frames, out, starts=starts)
            found, costs = np.concatenate([found, others], axis=1), np.concatenate([costs, prices], axis=1)
        return [self._distinct(*of_target) for of_target in zip(targets, found, costs, strict=True)]

    def _distinct(self, target: HandTarget, found: Array, costs: Array) -> list[ArmCandidate]:
        poses = self._chain.poses(found)
        palms = angles_between(poses.rotation[:, :, 2], target.palm)
        fingers = angles_between(poses.rotation[:, :, 0], target.fingers)
        candidates: list[ArmCandidate] = []
        for index in np.argsort(costs, kind="stable").tolist():
            if all(np.abs(found[index] - other.positions).max() > _SAME for other in candidates):
                candidates.append(
                    ArmCandidate(
                        positions=found[index],
                        palm_error=float(palms[index]),
                        finger_error=float(fingers[index]),
                        cost=float(costs[index]),
                    )
                )
        return candidates

    def part(self, target: HandTarget) -> Array:
        """Where the part of the hand that meets the place is, in the axes of the palm [m]. Shape (3,)."""
        points = self._hand.points(target.shape)
        tips = points.fingers[:, -1]
        shown = {
            "palm": np.zeros(3),
            "back": np.array([0.0, 0.0, -0.03]),
            "wrist": np.array([-0.09, 0.0, 0.0]),
            "index": tips[0],
            "thumb": points.thumb[-1],
            "fingertips": tips[target.shape[2:] <= target.shape[2:].min() + np.radians(15.0)].mean(axis=0),
            "index_side": points.fingers[0, 0] + np.array([0.0, -0.015, 0.0]),
            "little_side": points.fingers[-1, 0] + np.array([-0.02, 0.015, 0.0]),
        }
        return np.asarray(shown[target.part])

    def palm(self, positions: Array) -> tuple[Array, Array]:
        """Rotation and place of the right palm in ``base_link`` with an arm. Shapes (3, 3) and (3,) [m]."""
        poses = self._chain.poses(positions[None])
        return poses.rotation[0], poses.place[0]

    def distance(self, target: HandTarget, positions: Array) -> float:
        """How far the part of the hand is from its place [m]."""
        rotation, place = self.palm(positions)
        return float(np.linalg.norm(rotation @ self.part(target) + place - target.point))

    def hand_point(self, positions: Array, target: HandTarget, name: str) -> Array:
        """A point of a placed hand in ``base_link``, seen as a right hand [m]. Shape (3,)."""
        points = self._hand.points(target.shape)
        local = {
            "other_palm": np.array([0.0, 0.0, 0.012]),
            "other_back": np.array([0.0, 0.0, -0.035]),
            "other_fingertips": points.fingers[:, -1].mean(axis=0),
            "other_index_side": points.fingers[0, 0] + np.array([0.0, -0.02, 0.0]),
            "other_wrist": np.array([-0.10, 0.0, -0.02]),
        }[name]
        rotation, place = self.palm(positions)
        return np.asarray(rotation @ local + place)


def _goals(targets: Sequence[HandTarget], parts: Array) -> HandGoals:
    """The targets as what is wanted of a hand, one a frame; parts of the hand as `ArmSolver.part`. (n, 3)."""
    return HandGoals.without_arm(
        local=parts,
        place=np.array([target.point for target in targets]),
        contact=np.array([float(target.meets) for target in targets]),
        palm=np.array([target.palm for target in targets]),
        fingers=np.array([target.fingers for target in targets]),
    )


def cheapest_sequence(choices: list[list[ArmCandidate]]) -> list[ArmCandidate]:
    """One arm a posture, such that their costs and the ways between them are least together."""
    costs = [np.array([candidate.cost for candidate in candidates]) for candidates in choices]
    arms = [np.array([candidate.positions for candidate in candidates]) for candidates in choices]
    path = cheapest_path(costs, arms, _NEARNESS)
    return [candidates[index] for candidates, index in zip(choices, path.tolist(), strict=True)]


# Fingers that swing, index 0.
_FINGERS = ("index", "middle", "ring", "little")


class ScoreKnots:
    """Makes knots on one robot."""

    def __init__(self, robot: Robot, chain: ArmKinematics) -> None:
        """Prepare for a robot and its arm."""
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
        self._clear: dict[bytes, Array] = {}
        self._swing_sizes = np.concatenate([np.ones(2), axis_shares(self._table)])

    def of(
        self, hands: Hands, moments: list[Posture], rights: list[ArmCandidate], lefts: list[ArmCandidate]
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
            clear[columns] = self._with_clear_thumb(knot[columns])
        if left[0] in joints:
            columns = [joints.index(name) for name in left]
            hand = self._with_clear_thumb(mirrored_hand(self._humanoid, knot[columns]))
            clear[columns] = mirrored_hand(self._humanoid, hand)
        return clear

    def _with_clear_thumb(self, hand: Array) -> Array:
        """A handshape whose thumb keeps out of the fingers; a sign has few, and asks often. Shape (axes,)."""
        key = hand.tobytes()
        if key not in self._clear:
            self._clear[key] = with_clear_thumb(self._table, hand)
        return self._clear[key]

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
        hand = self._with_clear_thumb(hand)
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
