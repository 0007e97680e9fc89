# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The arms and hands of a word: their different postures, and how what they carry moves with them.

Arms are seen as right arms throughout (`mirrored`): a left one in the mirror.
"""

from __future__ import annotations

from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from teo_common.arrays import Array
from teo_description.humanoid import Side
from teo_description.robot import Robot
from teo_sign_capture.retarget.arm_kinematics import ArmKinematics, ArmPoses, mirrored, mirrored_hand
from teo_signs.sign import Sign

_SIDES: tuple[Side, Side] = ("right", "left")
_MIRROR = np.array([1.0, -1.0, 1.0])
# Share of a tolerance that is used along each of the directions below [1]: between them it is 1.13 times
# as much.
ALONG = 0.88
# Directions in which a turn or shift is bounded: the faces, edges and corners of a cube.
DIRECTIONS = np.array([row for row in product((-1.0, 0.0, 1.0), repeat=3) if any(row)])
DIRECTIONS /= np.linalg.norm(DIRECTIONS, axis=1, keepdims=True)


class Rows(NamedTuple):
    """Inequalities about one posture, or about two that follow each other: `matrix @ change <= bound`.

    Attributes:
        postures: Which postures.
        matrix: For the joints of those postures, one after the other. Shape (r, joints x postures).
        bound: Shape (r,).
        scale: Size of the quantity: being beyond by this is as bad as in any other rows.
    """

    postures: tuple[int, ...]
    matrix: Array
    bound: Array
    scale: float


class WordArms:
    """The arms and hands that a word moves.

    Attributes:
        sign: The word as captured.
        sides: Sides whose arm and hand it moves.
        columns: Columns of the sign's knots that hold their joints, side after side. Shape (m,).
        postures: The different postures of those joints, as of right arms [rad]. Shape (p, m).
        at: Which posture each knot has. Shape (n,).
        of_hands: Which of the joints are of hands. Shape (m,).
        arm, hand: How many joints an arm has, and a hand.
    """

    def __init__(self, robot: Robot, sign: Sign) -> None:
        """Find them.

        Args:
            robot: Not shared with another thread.
            sign: The word as captured.
        """
        self.sign = sign
        self._robot, self._chain, self._humanoid = robot, ArmKinematics(robot), robot.humanoid
        self.arm, self.hand = (len(self._humanoid.arm("right")), len(self._humanoid.hand("right")))
        joints = {side: self._humanoid.arm(side) + self._humanoid.hand(side) for side in _SIDES}
        self.sides: tuple[Side, ...] = tuple(side for side in _SIDES if set(joints[side]) <= set(sign.joints))
        names = [joint for side in self.sides for joint in joints[side]]
        self.columns = np.array([sign.joints.index(name) for name in names])
        self.postures, self.at = _different(self.as_right(sign.knots[:, self.columns]))
        self.of_hands = np.arange(len(names)) % (self.arm + self.hand) >= self.arm
        first = [int(np.flatnonzero(self.at == posture)[0]) for posture in range(len(self.postures))]
        self._others = [sign.pose(knot) for knot in first]

    def knots(self, postures: Array) -> Array:
        """The sign's knots with its arms in other postures [rad]. Shapes (p, m) and (n, joints)."""
        knots = self.sign.knots.copy()
        knots[:, self.columns] = self.as_right(postures[self.at])
        return knots

    def as_right(self, arms: Array) -> Array:
        """Arms as right arms, or back. Shape (n, m)."""
        parts = np.split(arms, len(self.sides), axis=1)
        return np.hstack(
            [
                self._swapped(part) if side == "left" else part
                for side, part in zip(self.sides, parts, strict=True)
            ]
        )

    def _swapped(self, limb: Array) -> Array:
        """Arm and hand of the other side that mirror these. Shape (n, arm + hand)."""
        arm, hand = limb[:, : self.arm], limb[:, self.arm :]
        return np.hstack([mirrored(self._humanoid, arm), mirrored_hand(self._humanoid, hand)])

    def of_each_side(self, postures: Array) -> list[Array]:
        """Arm and hand of each side. Shapes (p, m) and (p, arm + hand)."""
        return np.split(postures, len(self.sides), axis=1)

    def palms(self, postures: Array) -> list[ArmPoses]:
        """Where the palm of each side is. Shape (p, m)."""
        return [self._chain.poses(part[:, : self.arm]) for part in self.of_each_side(postures)]

    def configuration(self, posture: int, postures: Array) -> Array:
        """The whole robot in one of the postures, head and trunk as captured. Shape (p, m)."""
        names = [self.sign.joints[column] for column in self.columns]
        arms = self.as_right(postures[posture][None])[0]
        pose = self._others[posture] | dict(zip(names, arms.tolist(), strict=True))
        return self._robot.configuration(pose)

    def of_side(self, number: int, matrix: Array) -> Array:
        """A matrix for one arm's joints, or its hand's as well, as one for all. Shapes (r, j) and (r, m)."""
        size = self.arm + self.hand
        whole = np.zeros((len(matrix), size * len(self.sides)))
        whole[:, size * number : size * number + matrix.shape[1]] = matrix
        return whole

    def moves(self, link: str, point: Array, posture: int, palms: list[ArmPoses]) -> Array:
        """How a point of a link moves with the arms, in the base's axes [m/rad]. Shape (3, m)."""
        for number, side in enumerate(self.sides):
            carried = self._robot.carried_by(link, self._humanoid.arm(side))
            if not carried:
                continue
            mirror = _MIRROR if side == "left" else np.ones(3)
            points = np.tile(point * mirror, (len(palms[number].place), 1))
            moves = palms[number].point_jacobian(points)[posture] * mirror[:, None]
            moves[:, carried:] = 0.0
            return self.of_side(number, moves)
        return np.zeros((3, (self.arm + self.hand) * len(self.sides)))


def _different(arms: Array) -> tuple[Array, NDArray[np.intp]]:
    """The different rows, in the order in which they come, and which each row is."""
    _, first, which = np.unique(np.round(arms, 6), axis=0, return_index=True, return_inverse=True)
    order = np.argsort(first)
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    return arms[first[order]], rank[which.reshape(-1)]
