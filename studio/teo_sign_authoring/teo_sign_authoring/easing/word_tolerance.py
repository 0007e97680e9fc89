# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How far the arms and hands of a word may be moved while it still shows the same.

Palms turn and shift, fingers bend by tolerances at every knot. What palms and fingers do from knot to knot
keeps its direction and three quarters of its size; where parts touch they go on touching at the same place.
Head and trunk stay as they are. Equal knots stay equal, so that what is repeated is repeated.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from scipy.spatial.transform import Rotation

from teo_common.arrays import Array
from teo_description.hand_geometry import HandGeometry
from teo_description.robot import Robot
from teo_sign_authoring.easing.letter_tolerance import BEND, FOLDED, FOLDED_BEND, TURN
from teo_sign_authoring.easing.word_arms import ALONG, Rows, WordArms, WordContacts
from teo_sign_authoring.linear_program import DIRECTIONS
from teo_sign_capture.retarget.arm_kinematics import ArmPoses, arm_bounds
from teo_signs.sign import Sign

# [m] A palm shifts by this much along any axis: less than what is just seen of a place (28 mm).
_SHIFT = 0.02
# Share of a palm's way, and of its turn, from knot to knot by which these may change [1], and the least
# change allowed [m], [rad]: a movement made three quarters as large is the same one, and half of a
# tolerance is not seen where nothing moves.
_SHARE = 0.25
_LEAST_WAY, _LEAST_TURN, _LEAST_BEND = 0.01, np.radians(7.5), np.radians(4.0)
# Bends and turns of a hand's joint that are tried [rad].
_TURNS = np.radians(np.arange(1.0, 31.0))


class WordTolerance:
    """The tolerance of one word.

    Attributes:
        arms: Its arms and hands.
        contacts: What they touch and show at the head.
        lower: Least position of each joint in each posture [rad]. Shape (p, m).
        upper: The greatest [rad]. Shape (p, m).
    """

    def __init__(self, robot: Robot, sign: Sign, *, turns: float = 1.0) -> None:
        """Describe it.

        Args:
            robot: Not shared with another thread.
            sign: The word as captured.
            turns: Size of the palms' turns that the tolerance is about, of the captured ones [1]. Below 1 the
                word is made smaller, as people do who sign fast.
        """
        self.arms = WordArms(robot, sign)
        self.contacts = WordContacts(robot, self.arms)
        self._hand, self._humanoid = HandGeometry(robot), robot.humanoid
        self.lower, self.upper = self._room()
        self._captured = [_turned_less(palms, turns) for palms in self.arms.palms(self.arms.postures)]

    def rows(self, postures: Array) -> list[Rows]:
        """The tolerance about some postures, for changes from there. Shape (p, m)."""
        palms = self.arms.palms(postures)
        found = []
        for posture in range(len(postures)):
            found += self._palm_rows(posture, palms)
            found += self.contacts.rows(posture, postures, palms)
        for pair in sorted({pair for pair in pairwise(self.arms.at.tolist()) if pair[0] != pair[1]}):
            found += self._movement_rows(pair, palms)
            found.append(self._bending_rows(pair, postures))
        return found

    def excess(self, postures: Array) -> float:
        """The most that palms are turned or shifted, over the tolerance [1]. Shape (p, m)."""
        worst = float(np.maximum(postures - self.upper, self.lower - postures).max() > 1e-9)
        for now, captured in zip(self.arms.palms(postures), self._captured, strict=True):
            turned = Rotation.from_matrix(now.rotation @ captured.rotation.transpose(0, 2, 1)).magnitude()
            shifted = np.linalg.norm(now.place - captured.place, axis=1)
            worst = max(worst, float(turned.max()) / TURN, float(shifted.max()) / _SHIFT)
        return worst

    def _room(self) -> tuple[Array, Array]:
        """Bounds of the joints in each posture: arms like a person's, ends of fingers near theirs."""
        limits = self._hand.limits
        lower: list[Array] = []
        upper: list[Array] = []
        for side, part in zip(self.arms.sides, self.arms.of_each_side(self.arms.postures), strict=True):
            arm_lower, arm_upper = arm_bounds(self._humanoid, side)
            room = [self._bends(hand) for hand in part[:, self.arms.arm :]]
            for ends, arm, bends, hand, rows in (
                (np.maximum, arm_lower, [one[0] for one in room], limits.lower, lower),
                (np.minimum, arm_upper, [one[1] for one in room], limits.upper, upper),
            ):
                rows.append(np.hstack([np.tile(arm, (len(part), 1)), ends(hand, np.array(bends))]))
        # What is captured is within every tolerance, also where it is a hair outside a bound.
        return np.minimum(np.hstack(lower), self.arms.postures), np.maximum(
            np.hstack(upper), self.arms.postures
        )

    def _bends(self, hand: Array) -> tuple[Array, Array]:
        """Least and greatest position of each joint of a hand with which its ends stay near [rad]."""
        here = self._hand.points(hand)
        least, most = hand.copy(), hand.copy()
        for joint in range(self.arms.hand):
            finger = joint - 2
            near = FOLDED_BEND if finger >= 0 and hand[joint] > FOLDED else BEND
            for way, found in ((-1.0, least), (1.0, most)):
                for turn in _TURNS:
                    moved = hand.copy()
                    moved[joint] += way * turn
                    there = self._hand.points(moved)
                    # The thumb has two joints, each with half of what it may move.
                    away = (
                        float(
                            np.linalg.norm(there.fingers[finger, 2:] - here.fingers[finger, 2:], axis=1).max()
                        )
                        if finger >= 0
                        else 2.0 * float(np.linalg.norm(there.thumb[2] - here.thumb[2]))
                    )
                    if away > near:
                        break
                    found[joint] = moved[joint]
        return least, most

    def _palm_rows(self, posture: int, palms: list[ArmPoses]) -> list[Rows]:
        found = []
        for number, (now, captured) in enumerate(zip(palms, self._captured, strict=True)):
            turned = Rotation.from_matrix(now.rotation[posture] @ captured.rotation[posture].T).as_rotvec()
            shifted = now.place[posture] - captured.place[posture]
            ways = now.point_jacobian(now.place)[posture]
            for matrix, already, most in ((now.axes[posture].T, turned, TURN), (ways, shifted, _SHIFT)):
                rows = self.arms.of_side(number, DIRECTIONS @ matrix)
                found.append(Rows((posture,), rows, ALONG * most - DIRECTIONS @ already, most))
        return found

    def _movement_rows(self, pair: tuple[int, int], palms: list[ArmPoses]) -> list[Rows]:
        """What palms do from one posture to the next stays what it is, nearly."""
        first, second = pair
        found = []
        for number, (now, captured) in enumerate(zip(palms, self._captured, strict=True)):
            ways = now.point_jacobian(now.place)
            way, way_before = (one.place[second] - one.place[first] for one in (now, captured))
            turn, turn_before = (
                Rotation.from_matrix(one.rotation[second] @ one.rotation[first].T).as_rotvec()
                for one in (now, captured)
            )
            for one, other, change, size, least in (
                (ways[first], ways[second], way - way_before, np.linalg.norm(way_before), _LEAST_WAY),
                (
                    now.axes[first].T,
                    now.axes[second].T,
                    turn - turn_before,
                    np.linalg.norm(turn_before),
                    _LEAST_TURN,
                ),
            ):
                most = max(least, _SHARE * float(size))
                matrix = np.hstack(
                    [
                        self.arms.of_side(number, -DIRECTIONS @ one),
                        self.arms.of_side(number, DIRECTIONS @ other),
                    ]
                )
                found.append(Rows(pair, matrix, most - DIRECTIONS @ change, most))
        return found

    def _bending_rows(self, pair: tuple[int, int], postures: Array) -> Rows:
        """What fingers do from one posture to the next stays what it is, nearly."""
        fingers = self.arms.of_hands
        now, before = (
            np.diff(rows[list(pair)], axis=0)[0, fingers] for rows in (postures, self.arms.postures)
        )
        most = np.maximum(_LEAST_BEND, _SHARE * np.abs(before))
        unit = np.eye(postures.shape[1])[fingers]
        matrix = np.hstack([-unit, unit])
        bound = np.concatenate([most - (now - before), most + (now - before)])
        return Rows(pair, np.vstack([matrix, -matrix]), bound, float(_LEAST_BEND))


def _turned_less(palms: ArmPoses, size: float) -> ArmPoses:
    """The same places with orientations drawn together around their mean, by a factor."""
    orientations = Rotation.from_matrix(palms.rotation)
    mean = orientations.mean()
    drawn = Rotation.from_rotvec(size * (orientations * mean.inv()).as_rotvec()) * mean
    return palms._replace(rotation=drawn.as_matrix())
