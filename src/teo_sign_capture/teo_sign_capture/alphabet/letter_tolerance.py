# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How far a captured letter may be moved and still be read as itself.

A letter is moved by one offset to the joints of all its knots, so that what moves in it moves on. It may turn
its palm, shift its place and bend its fingers by tolerances; it stays most like its own recording, keeps the
fingers apart that tell it from a look-alike, does not hide the face, and thumb and fingers do not meet more
than they do.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product
from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from teo_common.arrays import Array
from teo_description import RIGHT_HAND, joint_limits
from teo_description.hand_geometry import DextraHand, thumb_clearances
from teo_description.robot import Robot
from teo_sign_capture.alphabet.letter_features import features
from teo_sign_capture.alphabet.spelling_arm import spelling_bounds
from teo_sign_capture.retarget.arm_kinematics import ArmKinematics
from teo_sign_capture.retarget.quality_figures import least_clearance
from teo_sign_capture.time_warp import warp
from teo_signs.sign import Sign

# [rad] The palm turns by this much about any axis: what is just seen (`teo_signs.likeness`), a third of the
# 45 deg between a palm to the front and one half to the side.
_TURN = np.radians(15.0)
# [m] A letter has no place of its own; it stays within half a hand's length of where the signer made it.
_SHIFT = 0.08
# [m] The end of a finger or thumb moves less than is just seen, the thickness of a finger: two thirds of it.
_BEND = 0.010
# [m], [rad] A finger folded by this much at each joint may open farther: it stays folded, where an extended
# finger that bends is soon a hooked one.
_FOLDED_BEND, _FOLDED = 0.015, np.radians(60.0)
# Own recording nearer than any other by this [just seen differences].
_AHEAD = 0.2
# Only recordings within this of the own one can come near it [just seen differences].
_RIVAL, _RIVALS = 1.6, 6
# [m] Thumb and fingers nearer than this may meet.
_MEETING = 0.03
# [m] Other parts of TEO keep as far apart: letters as captured keep 25 mm.
_CLEARANCE = 0.015
# [rad], [rad/s], [s] Step of differences; TEO's joints, and what a letter is held
# (`SigningStyle.letter_hold`).
_STEP = 2e-3
_SPEED, _RATE, _HOLD = np.radians(50.0), 25.0, 0.3
# Sizes of what no tolerance bounds, by which being beyond is weighed: recognition [just seen], clearance,
# face [m].
_RECOGNITION_SCALE, _MEETING_SCALE, _FACE_SCALE = 0.5, 0.01, 0.02
# Of an offset that cannot be used whole, the shares that are tried.
_SHARES = (1.0, 0.9, 0.8, 0.65, 0.5, 0.3)

_ARM = 6
# Directions in which a turn or shift is bounded: the faces, edges and corners of a cube.
_DIRECTIONS = np.array([row for row in product((-1.0, 0.0, 1.0), repeat=3) if any(row)])
_DIRECTIONS /= np.linalg.norm(_DIRECTIONS, axis=1, keepdims=True)


class LinearTolerance(NamedTuple):
    """A tolerance about one offset: ``matrix @ offset <= bound``, ``lower <= offset <= upper``.

    Attributes:
        matrix: Shape (r, 12).
        bound: Shape (r,).
        scale: Size of each row's quantity: being beyond by this is as bad as for any other row. Shape (r,).
        lower: Least offset of each joint [rad]. Shape (12,).
        upper: Greatest [rad].
    """

    matrix: Array
    bound: Array
    scale: Array
    lower: Array
    upper: Array


class LetterTolerance:
    """The tolerance of one letter.

    Attributes:
        sign: The letter as captured; its joints are those of the right arm, then of the hand.
    """

    def __init__(self, robot: Robot, sign: Sign, recordings: Mapping[str, Array]) -> None:
        """Describe it.

        Args:
            robot: The robot.
            sign: The letter as captured.
            recordings: Features of all recordings, by letter.
        """
        self.sign = sign
        self._robot, self._chain, self._hand = robot, ArmKinematics(robot), DextraHand(robot)
        self._poses = self._chain.poses(sign.knots[:, :_ARM])
        self._points = [self._hand.points(row[_ARM:]) for row in sign.knots]
        self._meeting = [np.minimum(thumb_clearances(points), 0.0) for points in self._points]
        self._lower, self._upper = self._joint_room()
        self._off_face = np.full(2, np.inf)  # most shift of the palm to the left and up [m]
        self._apart: list[tuple[int, Array]] = []  # finger tips and where to they may not go
        away = {
            letter: warp(self._seen(sign.knots), recording).distance
            for letter, recording in recordings.items()
        }
        own = away.pop(sign.gloss)
        rivals = [
            letter for letter in sorted(away, key=lambda letter: away[letter]) if away[letter] < own + _RIVAL
        ]
        self._own, self._others = recordings[sign.gloss], [recordings[letter] for letter in rivals[:_RIVALS]]

    def keep_from(self, other: LetterTolerance) -> None:
        """Do not move the finger tip that tells two letters apart towards where the other has it."""
        own, others = ([*one._points[0].fingers[:, 3], one._points[0].thumb[2]] for one in (self, other))
        ways = [own_tip - other_tip for own_tip, other_tip in zip(own, others, strict=True)]
        most = int(np.argmax([np.linalg.norm(way) for way in ways]))
        self._apart.append((most, ways[most] / np.linalg.norm(ways[most])))

    def keep_off(self, offset: Array, shift: Array) -> None:
        """Keep the palm where a shift [m] brings it that leaves the face free, shape (3,)."""
        moved = (self._chain.poses((self.sign.knots + offset)[:, :_ARM]).place - self._poses.place).max(
            axis=0
        )
        wanted = np.where(shift != 0.0, moved + shift, np.inf)
        self._off_face = np.minimum(self._off_face, wanted[1:])

    def linear(self, offset: Array, step: float) -> LinearTolerance:
        """The tolerance about an offset [rad], for offsets within a step of it [rad]."""
        blocks = [*self._frame_rows(offset), self._recognition_rows(offset)]
        matrix = np.concatenate([block[0] for block in blocks])
        # Each block bounds a change from here on.
        bound = np.concatenate([block[1] for block in blocks]) + matrix @ offset
        scale = np.concatenate([np.full(len(block[1]), block[2]) for block in blocks])
        lower = np.minimum(np.maximum(self._lower, offset - step), offset)
        upper = np.maximum(np.minimum(self._upper, offset + step), offset)
        return LinearTolerance(matrix, bound, scale, lower, upper)

    def settled(self, offset: Array) -> Array:
        """The offset, or as much of it as keeps the letter recognised and TEO's parts apart [rad]."""
        inside = np.clip(offset, self._lower, self._upper)
        margin = min(0.0, self._margin(self.sign.knots))
        for share in _SHARES:
            knots = self.sign.knots + share * inside
            clear = least_clearance(self._robot, self.sign.joints, knots) >= _CLEARANCE
            if clear and self._margin(knots) >= margin:
                return share * inside
        return np.zeros_like(offset)

    def _margin(self, knots: Array) -> float:
        """How much nearer the own recording is than any other [just seen differences]."""
        return float(self._lead(knots).min(initial=np.inf))

    def _lead(self, knots: Array) -> Array:
        """How much nearer the own recording is than each rival [just seen differences]."""
        seen = self._seen(knots)
        own = warp(seen, self._own).distance
        return np.array([warp(seen, other).distance - own for other in self._others])

    def _seen(self, knots: Array) -> Array:
        """Features of the letter as TEO plays it, a frame for each of the recordings'."""
        if len(knots) > 2:
            steps = np.maximum(np.diff(self.sign.times), np.abs(np.diff(knots, axis=0)).max(axis=1) / _SPEED)
            times = np.concatenate([[0.0], np.cumsum(steps)])
            frames = np.arange(0.0, times[-1] + _HOLD, 1.0 / _RATE)
            knots = np.column_stack([np.interp(frames, times, column) for column in knots.T])
        else:
            knots = knots[:1]  # stands still
        poses = self._chain.poses(knots[:, :_ARM])
        points = [self._hand.points(row[_ARM:]) for row in knots]
        fingers = np.stack([points_of.fingers[:, [0, 2, 3]].swapaxes(0, 1) for points_of in points])
        thumb = np.stack([points_of.thumb[2] for points_of in points])
        return features(
            poses.rotation,
            np.einsum("tij,tekj->teki", poses.rotation, fingers) + poses.place[:, None, None],
            np.einsum("tij,tj->ti", poses.rotation, thumb) + poses.place,
        )

    def _joint_room(self) -> tuple[Array, Array]:
        """Least and greatest offset of each joint: its limits, and how far a finger's end may go [rad]."""
        arm_lower, arm_upper = spelling_bounds()
        limits = joint_limits(RIGHT_HAND)
        knots = self.sign.knots
        lower = np.concatenate([arm_lower, limits.lower]) - knots.min(axis=0)
        upper = np.concatenate([arm_upper, limits.upper]) - knots.max(axis=0)
        grid = np.linspace(limits.lower[2], limits.upper[2], 160)
        reached = np.stack([self._hand.points(np.full(_ARM, bend)).fingers for bend in grid])
        for points, row in zip(self._points, knots, strict=True):
            away = np.linalg.norm(reached[:, :, 2:] - points.fingers[None, :, 2:], axis=3).max(axis=2)
            for finger, bend in enumerate(row[_ARM + 2 :]):
                inside = grid[away[:, finger] <= (_FOLDED_BEND if bend > _FOLDED else _BEND)]
                column = _ARM + 2 + finger
                lower[column] = max(lower[column], inside.min() - bend)
                upper[column] = min(upper[column], inside.max() - bend)
        # What is captured is within every tolerance, also where rounding has it a hair outside a limit.
        return np.minimum(lower, 0.0), np.maximum(upper, 0.0)

    def _frame_rows(self, offset: Array) -> list[tuple[Array, Array, float]]:
        """What each of the first, middle and last knot may do: rows, what they may change by, size."""
        knots = self.sign.knots + offset
        poses = self._chain.poses(knots[:, :_ARM])
        places = poses.point_jacobian(poses.place)
        blocks: list[tuple[Array, Array, float]] = []
        for at in sorted({0, len(knots) // 2, len(knots) - 1}):
            turned = Rotation.from_matrix(poses.rotation[at] @ self._poses.rotation[at].T).as_rotvec()
            shifted = poses.place[at] - self._poses.place[at]
            blocks.append((_of_arm(_DIRECTIONS @ poses.axes[at].T), _TURN - _DIRECTIONS @ turned, _TURN))
            blocks.append((_of_arm(_DIRECTIONS @ places[at]), _SHIFT - _DIRECTIONS @ shifted, _SHIFT))
            facing = np.isfinite(self._off_face)
            blocks.append(
                (_of_arm(places[at, 1:][facing]), (self._off_face - shifted[1:])[facing], _FACE_SCALE)
            )
            blocks.extend(self._hand_rows(at, knots[at, _ARM:]))
        return blocks

    def _hand_rows(self, at: int, hand: Array) -> list[tuple[Array, Array, float]]:
        """What thumb and finger tips may do, in one knot."""
        here, captured = self._hand.points(hand), self._points[at]
        moved = [self._hand.points(hand + _STEP * unit) for unit in np.eye(len(hand))]
        thumb = np.column_stack([(points.thumb[2] - here.thumb[2]) / _STEP for points in moved])
        away = here.thumb[2] - captured.thumb[2]
        blocks = [(_of_hand(_DIRECTIONS @ thumb), _BEND - _DIRECTIONS @ away, _BEND)]
        clearance = thumb_clearances(here)
        near = np.flatnonzero(clearance < _MEETING)
        slopes = (
            np.stack([thumb_clearances(points)[near] - clearance[near] for points in moved], axis=1) / _STEP
        )
        sure = np.isfinite(slopes).all(axis=1)  # not where the thumb comes over the palm's edge
        room = clearance[near] - self._meeting[at][near]
        blocks.append((_of_hand(-slopes[sure]), room[sure], _MEETING_SCALE))
        for tip, way in self._apart:
            tips = [
                np.vstack([points.fingers[:, 3], points.thumb[2]])[tip] for points in (captured, here, *moved)
            ]
            slope = np.array([(other - tips[1]) @ way for other in tips[2:]]) / _STEP
            blocks.append((_of_hand(-slope[None]), np.array([(tips[1] - tips[0]) @ way]), _BEND))
        return blocks

    def _recognition_rows(self, offset: Array) -> tuple[Array, Array, float]:
        """The own recording stays nearest, by `_AHEAD`."""
        knots = self.sign.knots + offset
        lead = self._lead(knots)
        if not lead.size:
            return np.zeros((0, len(offset))), lead, _RECOGNITION_SCALE
        units = _STEP * np.eye(len(offset))
        slopes = np.column_stack([(self._lead(knots + unit) - lead) / _STEP for unit in units])
        return -slopes, lead - _AHEAD, _RECOGNITION_SCALE


def _of_arm(rows: Array) -> Array:
    """Rows of the arm's joints as rows of all. Shapes (r, 6), (r, 12)."""
    return np.hstack([rows, np.zeros((len(rows), len(RIGHT_HAND)))])


def _of_hand(rows: Array) -> Array:
    """Rows of the hand's joints as rows of all. Shapes (r, 6), (r, 12)."""
    return np.hstack([np.zeros((len(rows), _ARM)), rows])
