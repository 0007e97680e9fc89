# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How far the arms and hands of a word may be moved while it still shows the same.

Palms turn and shift, fingers bend by tolerances at every knot. What palms and fingers do from knot to knot
keeps its direction and three quarters of its size; where parts touch they go on touching at the same place.
Head and trunk stay as they are. Equal knots stay equal, so that what is repeated is repeated.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise, product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from teo_common.arrays import Array
from teo_description import LEFT_ARM, LEFT_HAND, RIGHT_ARM, RIGHT_HAND, joint_limits
from teo_description.clearance import Contact
from teo_description.hand_geometry import DextraHand, thumb_clearances
from teo_description.robot import Robot
from teo_sign_capture.retarget.arm_bounds import Side, arm_bounds, mirrored
from teo_sign_capture.retarget.arm_kinematics import ArmKinematics, ArmPoses
from teo_signs.sign import Sign

# [rad] A palm turns by this much about any axis: what is just seen (`teo_signs.likeness`).
TURN = np.radians(15.0)
# [m] A palm shifts by this much along any axis: less than what is just seen of a place (28 mm).
SHIFT = 0.02
# Share of a palm's way, and of its turn, from knot to knot by which these may change [1], and the least
# change allowed [m], [rad]: a movement made three quarters as large is the same one, and half of a
# tolerance is not seen where nothing moves.
_SHARE = 0.25
_LEAST_WAY, _LEAST_TURN, _LEAST_BEND = 0.01, np.radians(7.5), np.radians(4.0)
# [m] The ends of fingers and thumb move by this much, of a finger folded by more than that [rad] by more:
# as in letters (`letter_tolerance`).
_BEND, _FOLDED_BEND, _FOLDED = 0.010, 0.015, np.radians(60.0)
# [m] Differences of distances below this are none.
_ROUNDING = 5e-4
# [m] Parts nearer than this touch, or are meant to (`teo_motion.sentence.sign_size`); the nearest points of
# the two then move by no more than this against each other: a finger's width on the other hand.
_CONTACT, _SLIP = 0.025, 0.01
# [m] Parts keep as far apart as most entries do, or as they were where they were nearer; parts within the
# second distance are looked at.
CLEARANCE, _NEAR = 0.006, 0.06

# [m] Ends of fingers within the first distance of the middle of the face show a place of the head, of which
# they are a hand's breadth away at most: they move by less than the second, what is just seen of a place.
_AT_HEAD, _PLACE = 0.24, 0.028
# [m] The middle of the face above the last joint of the neck, which is at 0.66 m: TEO's face reaches from
# 0.625 to 0.80 m.
_HEAD_LINK, _FACE_MIDDLE = "FrontalNeck_link", 0.055
_ENDS = tuple(
    f"{side}{finger}FingerTip"
    for side in ("Right", "Left")
    for finger in ("Thumb", "Index", "Middle", "Ring", "Pinky")
)

_JOINTS: Mapping[Side, tuple[str, ...]] = {"right": RIGHT_ARM + RIGHT_HAND, "left": LEFT_ARM + LEFT_HAND}
_MIRROR = np.array([1.0, -1.0, 1.0])
# How many of an arm's joints carry a link; a hand's parts are carried by all.
_CARRIED = {
    "FrontalShoulder": 1,
    "SagittalShoulder": 2,
    "AxialShoulder": 3,
    "FrontalElbow": 4,
    "AxialWrist": 5,
}
_ARM, _HAND = len(RIGHT_ARM), len(RIGHT_HAND)
_SIDE = _ARM + _HAND
# Bends and turns of a hand's joint that are tried [rad].
_TURNS = np.radians(np.arange(1.0, 31.0))
# Share of a tolerance that is used along each of the directions below [1]: between them it is 1.13 times
# as much.
_ALONG = 0.88
# Directions in which a turn or shift is bounded: the faces, edges and corners of a cube.
_DIRECTIONS = np.array([row for row in product((-1.0, 0.0, 1.0), repeat=3) if any(row)])
_DIRECTIONS /= np.linalg.norm(_DIRECTIONS, axis=1, keepdims=True)


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


class WordTolerance:
    """The tolerance of one word.

    Arms are seen as right arms throughout (`arm_bounds`): a left one in the mirror.

    Attributes:
        sign: The word as captured.
        sides: Sides whose arm and hand it moves.
        columns: Columns of the sign's knots that hold their joints, side after side. Shape (m,).
        postures: The different postures of those joints, as of right arms [rad]. Shape (p, m).
        at: Which posture each knot has. Shape (n,).
        of_hands: Which of the joints are of hands. Shape (m,).
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
        self.sign = sign
        self._robot, self._chain, self._hand = robot, ArmKinematics(robot), DextraHand(robot)
        self.sides: tuple[Side, ...] = tuple(
            side for side in _JOINTS if set(_JOINTS[side]) <= set(sign.joints)
        )
        names = [joint for side in self.sides for joint in _JOINTS[side]]
        self.columns = np.array([sign.joints.index(name) for name in names])
        arms = self.as_right(sign.knots[:, self.columns])
        self.postures, self.at = _different(arms)
        self.of_hands = np.arange(len(names)) % _SIDE >= _ARM
        self.lower, self.upper = self._room()
        self._captured = [_turned_less(palms, turns) for palms in self._palms(self.postures)]
        first = [int(np.flatnonzero(self.at == posture)[0]) for posture in range(len(self.postures))]
        self._others = [sign.pose(knot) for knot in first]
        self._touching = [self._contacts(posture, self.postures) for posture in range(len(self.postures))]

    def knots(self, postures: Array) -> Array:
        """The sign's knots with its arms in other postures [rad]. Shapes (p, m) and (n, joints)."""
        knots = self.sign.knots.copy()
        knots[:, self.columns] = self.as_right(postures[self.at])
        return knots

    def rows(self, postures: Array) -> list[Rows]:
        """The tolerance about some postures, for changes from there. Shape (p, m)."""
        palms = self._palms(postures)
        found = []
        for posture in range(len(postures)):
            found += self._palm_rows(posture, palms)
            found += self._contact_rows(posture, postures, palms)
            found += self._head_rows(posture, postures, palms)
        for pair in sorted({pair for pair in pairwise(self.at.tolist()) if pair[0] != pair[1]}):
            found += self._movement_rows(pair, palms)
            found.append(self._bending_rows(pair, postures))
        return found

    def excess(self, postures: Array) -> float:
        """The most that palms are turned or shifted, over the tolerance [1]. Shape (p, m)."""
        worst = float(np.maximum(postures - self.upper, self.lower - postures).max() > 1e-9)
        for now, captured in zip(self._palms(postures), self._captured, strict=True):
            turned = Rotation.from_matrix(now.rotation @ captured.rotation.transpose(0, 2, 1)).magnitude()
            shifted = np.linalg.norm(now.place - captured.place, axis=1)
            worst = max(worst, float(turned.max()) / TURN, float(shifted.max()) / SHIFT)
        return worst

    def keeps_contacts(self, postures: Array) -> bool:
        """Whether what touches still does, and nothing else comes nearer than `CLEARANCE`. Shape (p, m)."""
        for posture, before in enumerate(self._touching):
            thumbs, captured = self._thumbs(postures[posture]), self._thumbs(self.postures[posture])
            if (thumbs < np.minimum(captured, 0.0) - _ROUNDING).any():
                return False
            now = _of_pairs(self._contacts(posture, postures))
            least = min([CLEARANCE, *(item.distance for item in before)])
            if min((item.distance for item in now.values()), default=np.inf) < least - _ROUNDING:
                return False
            for item in _nearest(before):
                touching = now.get((item.first, item.second))
                if touching is None or touching.distance > item.distance + _SLIP:
                    return False
        return True

    def keeps_places_at_head(self, postures: Array) -> bool:
        """Whether fingers that show a place of the head still show it. Shape (p, m)."""
        for posture in range(len(postures)):
            captured, face = self._ends(posture, self.postures)
            now, _ = self._ends(posture, postures)
            shows = np.linalg.norm(captured - face, axis=1) < _AT_HEAD
            if (np.linalg.norm(now - captured, axis=1)[shows] > _PLACE).any():
                return False
        return True

    def as_right(self, arms: Array) -> Array:
        """Arms as right arms, or back. Shape (n, m)."""
        parts = np.split(arms, len(self.sides), axis=1)
        return np.hstack(
            [
                np.hstack([mirrored(part[:, :_ARM]), part[:, _ARM:]]) if side == "left" else part
                for side, part in zip(self.sides, parts, strict=True)
            ]
        )

    def _room(self) -> tuple[Array, Array]:
        """Bounds of the joints in each posture: arms like a person's, ends of fingers near theirs."""
        limits = joint_limits(RIGHT_HAND)
        lower: list[Array] = []
        upper: list[Array] = []
        for side, part in zip(self.sides, np.split(self.postures, len(self.sides), axis=1), strict=True):
            arm_lower, arm_upper = arm_bounds(side)
            room = [self._bends(hand) for hand in part[:, _ARM:]]
            for ends, arm, bends, hand, rows in (
                (np.maximum, arm_lower, [one[0] for one in room], limits.lower, lower),
                (np.minimum, arm_upper, [one[1] for one in room], limits.upper, upper),
            ):
                rows.append(np.hstack([np.tile(arm, (len(part), 1)), ends(hand, np.array(bends))]))
        # What is captured is within every tolerance, also where it is a hair outside a bound.
        return np.minimum(np.hstack(lower), self.postures), np.maximum(np.hstack(upper), self.postures)

    def _bends(self, hand: Array) -> tuple[Array, Array]:
        """Least and greatest position of each joint of a hand with which its ends stay near [rad]."""
        here = self._hand.points(hand)
        least, most = hand.copy(), hand.copy()
        for joint in range(_HAND):
            finger = joint - 2
            near = _FOLDED_BEND if finger >= 0 and hand[joint] > _FOLDED else _BEND
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

    def _thumbs(self, posture: Array) -> Array:
        """How far each thumb is from the fingers of its hand [m]."""
        hands = [part[_ARM:] for part in np.split(posture, len(self.sides))]
        return np.concatenate([thumb_clearances(self._hand.points(hand)) for hand in hands])

    def _palms(self, postures: Array) -> list[ArmPoses]:
        return [self._chain.poses(part[:, :_ARM]) for part in np.split(postures, len(self.sides), axis=1)]

    def _contacts(self, posture: int, postures: Array) -> list[Contact]:
        return self._robot.contacts(self._configuration(posture, postures), _NEAR)

    def _ends(self, posture: int, postures: Array) -> tuple[Array, Array]:
        """Ends of all fingers, and the middle of the face [m]. Shapes (10, 3) and (3,)."""
        poses = self._robot.placements(self._configuration(posture, postures), (*_ENDS, _HEAD_LINK))
        return poses[:-1, :3, 3], poses[-1, :3, 3] + _FACE_MIDDLE * poses[-1, :3, 2]

    def _configuration(self, posture: int, postures: Array) -> Array:
        names = [self.sign.joints[column] for column in self.columns]
        arms = self.as_right(postures[posture][None])[0]
        pose = self._others[posture] | dict(zip(names, arms.tolist(), strict=True))
        return self._robot.configuration(pose)

    def _of_side(self, number: int, matrix: Array) -> Array:
        """A matrix for one arm's joints as one for all. Shapes (r, 6) and (r, m)."""
        whole = np.zeros((len(matrix), _SIDE * len(self.sides)))
        whole[:, _SIDE * number : _SIDE * number + matrix.shape[1]] = matrix
        return whole

    def _palm_rows(self, posture: int, palms: list[ArmPoses]) -> list[Rows]:
        found = []
        for number, (now, captured) in enumerate(zip(palms, self._captured, strict=True)):
            turned = Rotation.from_matrix(now.rotation[posture] @ captured.rotation[posture].T).as_rotvec()
            shifted = now.place[posture] - captured.place[posture]
            ways = now.point_jacobian(now.place)[posture]
            for matrix, already, most in (
                (now.axes[posture].T, turned, TURN),
                (ways, shifted, SHIFT),
            ):
                rows = self._of_side(number, _DIRECTIONS @ matrix)
                found.append(Rows((posture,), rows, _ALONG * most - _DIRECTIONS @ already, most))
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
                        self._of_side(number, -_DIRECTIONS @ one),
                        self._of_side(number, _DIRECTIONS @ other),
                    ]
                )
                found.append(Rows(pair, matrix, most - _DIRECTIONS @ change, most))
        return found

    def _bending_rows(self, pair: tuple[int, int], postures: Array) -> Rows:
        """What fingers do from one posture to the next stays what it is, nearly."""
        fingers = self.of_hands
        now, before = (np.diff(rows[list(pair)], axis=0)[0, fingers] for rows in (postures, self.postures))
        most = np.maximum(_LEAST_BEND, _SHARE * np.abs(before))
        unit = np.eye(postures.shape[1])[fingers]
        matrix = np.hstack([-unit, unit])
        bound = np.concatenate([most - (now - before), most + (now - before)])
        return Rows(pair, np.vstack([matrix, -matrix]), bound, float(_LEAST_BEND))

    def _contact_rows(self, posture: int, postures: Array, palms: list[ArmPoses]) -> list[Rows]:
        found = []
        before = _of_pairs(self._touching[posture])
        meant = {(item.first, item.second) for item in _nearest(self._touching[posture])}
        for item in _of_pairs(self._contacts(posture, postures)).values():
            moves = self._moves(item.second, item.second_point, posture, palms) - self._moves(
                item.first, item.first_point, posture, palms
            )
            if not moves.any():
                continue
            captured = before.get((item.first, item.second))
            least = min(CLEARANCE, np.inf if captured is None else captured.distance)
            found.append(
                Rows((posture,), -(item.normal @ moves)[None], np.array([item.distance - least]), _SLIP)
            )
            if captured is not None and (item.first, item.second) in meant:
                already = (item.second_point - item.first_point) - (
                    captured.second_point - captured.first_point
                )
                found.append(Rows((posture,), _DIRECTIONS @ moves, _SLIP - _DIRECTIONS @ already, _SLIP))
        return found

    def _head_rows(self, posture: int, postures: Array, palms: list[ArmPoses]) -> list[Rows]:
        """Fingers that show a place of the head go on showing it; that they bend too is small beside it."""
        captured, face = self._ends(posture, self.postures)
        now, _ = self._ends(posture, postures)
        found = []
        for end in np.flatnonzero(np.linalg.norm(captured - face, axis=1) < _AT_HEAD).tolist():
            moves = self._moves(_ENDS[end], now[end], posture, palms)
            if moves.any():
                bound = _ALONG * _PLACE - _DIRECTIONS @ (now[end] - captured[end])
                found.append(Rows((posture,), _DIRECTIONS @ moves, bound, _PLACE))
        return found

    def _moves(self, link: str, point: Array, posture: int, palms: list[ArmPoses]) -> Array:
        """How a point of a link moves with the arms, in the base's axes [m/rad]. Shape (3, m)."""
        for number, side in enumerate(self.sides):
            name = side.capitalize()
            if name not in link or "Hip" in link or "Knee" in link:
                continue
            carried = _CARRIED.get(link.removesuffix("_link").replace(name, ""), _ARM)
            mirror = _MIRROR if side == "left" else np.ones(3)
            points = np.tile(point * mirror, (len(palms[number].place), 1))
            moves = palms[number].point_jacobian(points)[posture] * mirror[:, None]
            moves[:, carried:] = 0.0
            return self._of_side(number, moves)
        return np.zeros((3, _SIDE * len(self.sides)))


def _different(arms: Array) -> tuple[Array, NDArray[np.intp]]:
    """The different rows, in the order in which they come, and which each row is."""
    _, first, which = np.unique(np.round(arms, 6), axis=0, return_index=True, return_inverse=True)
    order = np.argsort(first)
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    return arms[first[order]], rank[which.reshape(-1)]


def _turned_less(palms: ArmPoses, size: float) -> ArmPoses:
    """The same places with orientations drawn together around their mean, by a factor."""
    orientations = Rotation.from_matrix(palms.rotation)
    mean = orientations.mean()
    drawn = Rotation.from_rotvec(size * (orientations * mean.inv()).as_rotvec()) * mean
    return palms._replace(rotation=drawn.as_matrix())


def _of_pairs(contacts: list[Contact]) -> dict[tuple[str, str], Contact]:
    """Of each two links the nearest of their shapes."""
    farthest_first = sorted(contacts, key=lambda item: -item.distance)
    return {(item.first, item.second): item for item in farthest_first}


def _nearest(contacts: list[Contact]) -> list[Contact]:
    """What touches: of each two of right arm, left arm and body the nearest parts, if they are near."""
    found: dict[tuple[bool, ...], Contact] = {}
    for item in sorted(contacts, key=lambda item: item.distance):
        both = tuple(name in link for link in (item.first, item.second) for name in ("Right", "Left"))
        if item.distance < _CONTACT and item.may_be_meant:
            found.setdefault(both, item)
    return list(found.values())
