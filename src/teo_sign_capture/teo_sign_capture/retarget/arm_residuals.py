# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How far arms are from what is wanted of their hands, and how that changes with the joints.

A sum of squares for each frame. What is traded against what follows what carries meaning in a sign: the place
of the hand, at the body and at the other hand above all; then the way the palm faces; then the way the
fingers point. The elbow where a person has it and an easy arm choose among what is equal in these.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from teo_common.arrays import Array
from teo_sign_capture.retarget.arm_kinematics import ArmKinematics, ArmPoses, easy_arm
from teo_sign_capture.retarget.hand_goals import HandGoals, PairGoals
from teo_sign_capture.signing_space import MIRROR

Goals = TypeVar("Goals", HandGoals, PairGoals)

# By how much more the place of a hand in the air counts at the face, forwards, left, up: nose, mouth and chin
# are 3 cm apart, where places before the chest are 10. By more, what TEO has done itself would come back over
# 2 cm off.
_AT_FACE = np.array([0.0, 0.6, 0.6])
# [rad/m] Weight of the way from hand to hand: a contact is kept to a centimetre or two.
_TOGETHER = 20.0


@dataclass(frozen=True, kw_only=True, eq=False)
class ArmWeights:
    """What counts how much, beside an angle of one radian.

    Attributes:
        in_air: Weight of the place of a hand that meets nothing: forwards, left, up [rad/m]. Shape (3,).
        on_body: The same where it meets something [rad/m].
        palm: Weight of the direction that the palm faces.
        fingers: Weight of the direction from wrist to knuckles.
        upper_arm: Weight of the direction from shoulder to elbow.
        fore_arm: Weight of the direction from elbow to wrist.
        strayed: [m] A hand in the air that is so far from its place counts twice as much as by `in_air`
            alone, nearer hardly more; infinite if every centimetre counts the same.
        raised: Weight of how far the elbow is above `ELBOW_UP` [rad/m]; 0 of an arm that may be lifted.
        easy: Pull of each joint towards an arm at ease.
        sideways: The same of joints that bend the hand sideways.
    """

    in_air: Array
    on_body: float
    palm: float
    fingers: float
    upper_arm: float = 0.0
    fore_arm: float = 0.0
    strayed: float = np.inf
    raised: float = 0.0
    easy: float
    sideways: float


# [m] An elbow is about so thick: where it hangs, it is no higher above the shoulder.
ELBOW_UP = 0.05

# Weights for a motion captured from a person.
CAPTURED = ArmWeights(
    # What a signer reads first is where a sign is made. 10 cm beside its place in the air count as much as a
    # palm turned by 20 deg, but 12 cm, which may be another place, as much as one turned by 30 deg; forwards,
    # along the line of sight of whom is signed to, half of it. TEO's elbow keeps its hand 46 cm off its
    # shoulder, where a person signs at 30: what is too near goes forwards rather than aside or turned.
    in_air=np.array([1.5, 3.0, 3.0]),
    strayed=0.12,
    # A contact is kept to a centimetre or two before the palm is.
    on_body=30.0,
    palm=1.4,
    # 28 deg of the fingers count as much as 20 deg of the palm.
    fingers=1.0,
    # An arm that goes where a person's does: a forearm that lies across where a person's stands up costs as
    # much as a palm turned by 20 deg.
    upper_arm=0.15,
    fore_arm=0.35,
    # The pull moves a reachable hand by less than 1 deg. The wrist bends to the side, which a person's hardly
    # does.
    easy=0.03,
    sideways=0.1,
)


class Quadratic(NamedTuple):
    """A sum of squares about the positions at which it was worked out, n frames of m joints.

    Attributes:
        cost: Half the sum. Shape (n,).
        gradient: Shape (n, m).
        curvature: Gauss and Newton's. Shape (n, m, m).
        coupling: The same of each frame's joints with the next frame's, shape (n, m, m), the last of no
            meaning; None if frames have nothing to do with each other.
    """

    cost: Array
    gradient: Array
    curvature: Array
    coupling: Array | None = None


class ArmProblem:
    """One arm, or two, over a motion; a left arm is seen as a right one in a mirror."""

    def __init__(
        self,
        chain: ArmKinematics,
        hands: tuple[HandGoals, ...],
        pair: PairGoals | None = None,
        weights: ArmWeights = CAPTURED,
        easy: Array | None = None,
    ) -> None:
        """State it.

        Args:
            chain: The arm.
            hands: What is wanted of each hand; the right one first if there are two.
            pair: What is wanted of two hands together; None if one takes part, or nothing is.
            weights: What counts how much.
            easy: The arm at ease [rad], shape (j,); the robot's without it.
        """
        self._chain = chain
        self._easy = easy_arm(chain.humanoid) if easy is None else easy
        self._pulls = np.where(chain.sideways, weights.sideways, weights.easy)
        self._hands = hands
        self._pair = pair
        self._weights = weights

    def between(self, part: slice) -> ArmProblem:
        """What is wanted in some frames one after the other."""
        pair = None if self._pair is None else _cut(self._pair, part)
        hands = tuple(_cut(goals, part) for goals in self._hands)
        return ArmProblem(self._chain, hands, pair, self._weights, self._easy)

    def spread_apart(self, amount: Array) -> ArmProblem:
        """The same with hands away from everything, each on the side of the other on which it belongs.

        Hands that are near each other go apart along the way on which the person's are, the one in front
        forwards; others go forwards, off the body.

        Args:
            amount: How far from each other, or from the body, in each frame [m]. Shape (T,).
        """
        order = np.zeros((len(amount), 3)) if self._pair is None else self._pair.order
        ahead = 1.0 - np.linalg.norm(order, axis=1) + 0.5 * np.abs(order[:, 0])
        forwards = amount[:, None] * ahead[:, None] * (1.0, 0.0, 0.0)
        aside = 0.5 * amount[:, None] * order
        shifts = (forwards + aside, (forwards - aside) * MIRROR)
        hands = tuple(
            replace(goals, place=goals.place + shift)
            for goals, shift in zip(self._hands, shifts, strict=False)
        )
        return ArmProblem(self._chain, hands, None, self._weights, self._easy)

    def of_hand(self, hand: int, positions: Array, frames: NDArray[np.intp]) -> Quadratic:
        """One arm by itself, at any positions [rad], shape (n, j), each for one of the frames, shape (n,)."""
        poses = self._chain.poses(positions)
        return self._single(self._hands[hand], frames, poses, positions)

    def whole(self, positions: Array) -> Quadratic:
        """All arms over all frames, one after the other. Shape (T, j or 2 j) [rad]."""
        frames = np.arange(len(positions))
        joints = self._chain.count
        arms = [positions[:, at : at + joints] for at in range(0, positions.shape[1], joints)]
        poses = [self._chain.poses(arm) for arm in arms]
        singles = [
            self._single(goals, frames, pose, arm)
            for goals, pose, arm in zip(self._hands, poses, arms, strict=True)
        ]
        if len(singles) == 1:
            return singles[0]
        count, size = positions.shape
        gradient, curvature = np.zeros((count, size)), np.zeros((count, size, size))
        for at, single in enumerate(singles):
            own = slice(joints * at, joints * (at + 1))
            gradient[:, own], curvature[:, own, own] = single.gradient, single.curvature
        cost = singles[0].cost + singles[1].cost
        if self._pair is None:
            return Quadratic(cost, gradient, curvature)
        right, left = poses[0].points(self._pair.right), poses[1].points(self._pair.left)
        weight = _TOGETHER * self._pair.nearness[:, None]
        away = weight * (right - left * MIRROR - self._pair.way)
        slope = np.concatenate(
            [poses[0].point_jacobian(right), -MIRROR[:, None] * poses[1].point_jacobian(left)], axis=2
        )
        slope *= weight[..., None]
        turned = slope.transpose(0, 2, 1)
        return Quadratic(
            cost + 0.5 * (away**2).sum(axis=1),
            gradient + (turned @ away[..., None])[..., 0],
            curvature + turned @ slope,
        )

    def _single(
        self, goals: HandGoals, frames: NDArray[np.intp], poses: ArmPoses, positions: Array
    ) -> Quadratic:
        weights, chain = self._weights, self._chain
        points = poses.points(goals.local[frames])
        elbow = poses.origins[:, chain.elbow]
        # Directions: weight, how it is, how it should be, how many joints move it.
        aims = [
            (weights.palm, poses.rotation[:, :, 2], goals.palm, chain.count),
            (weights.fingers, poses.rotation[:, :, 0], goals.fingers, chain.count),
        ]
        if weights.upper_arm:  # scores leave the arm free, and need not pay for it
            aims.append((weights.upper_arm, _unit(elbow - chain.shoulder), goals.upper_arm, chain.elbow))
        if weights.fore_arm:
            fore_arm = _unit(poses.origins[:, chain.wrist] - elbow)
            aims.append((weights.fore_arm, fore_arm, goals.fore_arm, chain.elbow + 1))
        joints = np.arange(chain.count)
        risen, rising = np.zeros((len(positions), 0)), np.zeros((len(positions), 0, chain.count))
        if weights.raised:
            above = elbow[:, 2] - chain.shoulder[2] - ELBOW_UP
            risen = weights.raised * np.maximum(above, 0.0)[:, None]
            way = poses.point_jacobian(elbow)[:, 2:] * (joints < chain.elbow)
            rising = weights.raised * (above > 0.0)[:, None, None] * way
        in_air = weights.in_air * (1.0 + _AT_FACE * goals.at_face[frames, None])
        at_place = in_air + (weights.on_body - in_air) * goals.contact[frames, None]
        off = points - goals.place[frames]
        away, astray = self._astray(off, at_place, goals.contact[frames])
        residuals = np.concatenate(
            [
                away,
                *(weight * (aim - wanted[frames]) for weight, aim, wanted, _ in aims),
                risen,
                self._pulls * (positions - self._easy),
            ],
            axis=1,
        )
        slopes = np.concatenate(
            [
                astray @ poses.point_jacobian(points),
                *(weight * poses.direction_jacobian(aim) * (joints < end) for weight, aim, _, end in aims),
                rising,
                np.broadcast_to(np.diag(self._pulls), (len(positions), chain.count, chain.count)),
            ],
            axis=1,
        )
        turned = slopes.transpose(0, 2, 1)
        return Quadratic(
            0.5 * (residuals**2).sum(axis=1), (turned @ residuals[..., None])[..., 0], turned @ slopes
        )

    def _astray(self, off: Array, at_place: Array, contact: Array) -> tuple[Array, Array]:
        """What a hand off its place costs, and how that changes with the place. Shapes (n, 3), (n, 3, 3)."""
        slope = at_place[..., None] * np.eye(3)
        if np.isinf(self._weights.strayed):
            return at_place * off, slope
        share = (1.0 - contact[:, None]) / self._weights.strayed**2
        more = 1.0 + share * (off**2).sum(axis=1, keepdims=True)
        outer = 2.0 * share[..., None] * at_place[..., None] * off[:, :, None] * off[:, None]
        return at_place * more * off, more[..., None] * slope + outer


def _cut(goals: Goals, part: slice) -> Goals:
    return replace(goals, **{field.name: getattr(goals, field.name)[part] for field in fields(goals)})


def _unit(vectors: Array) -> Array:
    units: Array = vectors / np.linalg.norm(vectors, axis=1, keepdims=True)
    return units
