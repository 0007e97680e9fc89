# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The arms and hands of a word: their postures, what they carry, what they touch and show.

Arms are seen as right arms throughout (`mirrored`): a left one in the mirror.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from teo_common.arrays import Array
from teo_description.clearance import Contact
from teo_description.hand_geometry import HandGeometry
from teo_description.humanoid import SIDES, Side
from teo_description.robot import Robot
from teo_sign_authoring.linear_program import DIRECTIONS
from teo_sign_capture.retarget.arm_kinematics import ArmKinematics, ArmPoses, mirrored, mirrored_hand
from teo_sign_capture.signing_space import find_place
from teo_signs.sign import Sign

_SIDES: tuple[Side, Side] = ("right", "left")
_MIRROR = np.array([1.0, -1.0, 1.0])
# Share of a tolerance that is used along each of the directions below [1]: between them it is 1.13 times
# as much.
ALONG = 0.88


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
        """Find those of a word as captured; the robot is not shared with another thread."""
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


# [m] Differences of distances below this are none.
_ROUNDING = 5e-4
# [m] Parts nearer than this touch, or are meant to (`teo_motion.sentence.sign_size`); the nearest points of
# the two then move by no more than this against each other: a finger's width on the other hand.
_CONTACT, _SLIP = 0.025, 0.01
# [m] Parts keep as far apart as most entries do, or as they were where they were nearer; parts within the
# second distance are looked at.
_CLEARANCE, _NEAR = 0.006, 0.06

# [m] Ends of fingers within the first distance of the middle of the face show a place of the head, of which
# they are a hand's breadth away at most: they move by less than the second, what is just seen of a place.
_AT_HEAD, _PLACE = 0.24, 0.028
# [m] By how much the middle of the face is below the middle of chin and crown, where a hand stops.
_BELOW_MIDDLE = 0.0125


class WordContacts:
    """What is to go on touching, to stay apart, and to stay at the head; the robot is as of `WordArms`."""

    def __init__(self, robot: Robot, arms: WordArms) -> None:
        self._robot, self._arms, self._hand = robot, arms, HandGeometry(robot)
        humanoid, hand = robot.humanoid, robot.humanoid.file.hand
        right = (hand.thumb[-1], *(frames[-1] for frames in hand.fingers.values()))
        self._tips = (*right, *map(humanoid.mirrored_name, right))
        self._face_joint = (humanoid.head or humanoid.trunk)[-1:]
        home = robot.joint_placements(robot.configuration({}), self._face_joint)[0]
        heights = [float(find_place(humanoid, name).point[2]) for name in ("chin", "head_top")]
        middle = np.array([*home[:2, 3], sum(heights) / 2.0 - _BELOW_MIDDLE])
        self._face = home[:3, :3].T @ (middle - home[:3, 3])
        self._touching = [self._near(posture, arms.postures) for posture in range(len(arms.postures))]

    def rows(self, posture: int, postures: Array, palms: list[ArmPoses]) -> list[Rows]:
        """What holds for changes of one of some postures. Shape (p, m)."""
        return [*self._contact_rows(posture, postures, palms), *self._head_rows(posture, postures, palms)]

    def kept(self, postures: Array) -> bool:
        """Whether what touches still does, and nothing else comes nearer than `_CLEARANCE`. Shape (p, m)."""
        for posture, before in enumerate(self._touching):
            thumbs, captured = self._thumbs(postures[posture]), self._thumbs(self._arms.postures[posture])
            if (thumbs < np.minimum(captured, 0.0) - _ROUNDING).any():
                return False
            now = _of_pairs(self._near(posture, postures))
            least = min([_CLEARANCE, *(item.distance for item in before)])
            if min((item.distance for item in now.values()), default=np.inf) < least - _ROUNDING:
                return False
            for item in self._nearest(before):
                touching = now.get((item.first, item.second))
                if touching is None or touching.distance > item.distance + _SLIP:
                    return False
        return True

    def places_kept(self, postures: Array) -> bool:
        """Whether fingers that show a place of the head still show it. Shape (p, m)."""
        for posture in range(len(postures)):
            captured, face = self._ends(posture, self._arms.postures)
            now, _ = self._ends(posture, postures)
            shows = np.linalg.norm(captured - face, axis=1) < _AT_HEAD
            if (np.linalg.norm(now - captured, axis=1)[shows] > _PLACE).any():
                return False
        return True

    def _contact_rows(self, posture: int, postures: Array, palms: list[ArmPoses]) -> list[Rows]:
        found = []
        before = _of_pairs(self._touching[posture])
        meant = {(item.first, item.second) for item in self._nearest(self._touching[posture])}
        for item in _of_pairs(self._near(posture, postures)).values():
            moves = self._arms.moves(item.second, item.second_point, posture, palms) - self._arms.moves(
                item.first, item.first_point, posture, palms
            )
            if not moves.any():
                continue
            captured = before.get((item.first, item.second))
            least = min(_CLEARANCE, np.inf if captured is None else captured.distance)
            found.append(
                Rows((posture,), -(item.normal @ moves)[None], np.array([item.distance - least]), _SLIP)
            )
            if captured is not None and (item.first, item.second) in meant:
                already = (item.second_point - item.first_point) - (
                    captured.second_point - captured.first_point
                )
                found.append(Rows((posture,), DIRECTIONS @ moves, _SLIP - DIRECTIONS @ already, _SLIP))
        return found

    def _head_rows(self, posture: int, postures: Array, palms: list[ArmPoses]) -> list[Rows]:
        """Fingers that show a place of the head go on showing it; that they bend too is small beside it."""
        captured, face = self._ends(posture, self._arms.postures)
        now, _ = self._ends(posture, postures)
        found = []
        for end in np.flatnonzero(np.linalg.norm(captured - face, axis=1) < _AT_HEAD).tolist():
            moves = self._arms.moves(self._tips[end], now[end], posture, palms)
            if moves.any():
                bound = ALONG * _PLACE - DIRECTIONS @ (now[end] - captured[end])
                found.append(Rows((posture,), DIRECTIONS @ moves, bound, _PLACE))
        return found

    def _ends(self, posture: int, postures: Array) -> tuple[Array, Array]:
        """Ends of all fingers, and the middle of the face [m]. Shapes (tips, 3) and (3,)."""
        q = self._arms.configuration(posture, postures)
        head = self._robot.joint_placements(q, self._face_joint)[0]
        return self._robot.placements(q, self._tips)[:, :3, 3], head[:3, :3] @ self._face + head[:3, 3]

    def _near(self, posture: int, postures: Array) -> list[Contact]:
        return self._robot.contacts(self._arms.configuration(posture, postures), _NEAR)

    def _nearest(self, contacts: list[Contact]) -> list[Contact]:
        """What touches: of each two of right arm, left arm and body the nearest parts, if they are near."""
        arms = [self._robot.humanoid.arm(side) for side in SIDES]
        found: dict[tuple[bool, ...], Contact] = {}
        for item in sorted(contacts, key=lambda item: item.distance):
            links = (item.first, item.second)
            both = tuple(self._robot.carried_by(link, arm) > 0 for link in links for arm in arms)
            if item.distance < _CONTACT and item.may_be_meant:
                found.setdefault(both, item)
        return list(found.values())

    def _thumbs(self, posture: Array) -> Array:
        """How far each thumb is from the fingers of its hand [m]."""
        hands = [part[0, self._arms.arm :] for part in self._arms.of_each_side(posture[None])]
        return np.concatenate([self._hand.thumb_clearances(self._hand.points(hand)) for hand in hands])


def _of_pairs(contacts: list[Contact]) -> dict[tuple[str, str], Contact]:
    """Of each two links the nearest of their shapes."""
    farthest_first = sorted(contacts, key=lambda item: -item.distance)
    return {(item.first, item.second): item for item in farthest_first}
