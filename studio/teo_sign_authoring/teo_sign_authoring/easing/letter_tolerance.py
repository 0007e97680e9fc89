# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How far a captured letter may be moved and still be read as itself.

A letter is moved by one offset to the joints of all its knots, so that what moves in it moves on. It may turn
its palm, shift its place, raise its elbow and bend its fingers by tolerances; it stays most like its own
recording, keeps what tells it from a look-alike, does not hide the face, and thumb and fingers do not meet
more than they do.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from teo_common.arrays import Array
from teo_common.dynamic_programming import warp
from teo_description.hand_geometry import HandGeometry
from teo_description.robot import Robot
from teo_sign_authoring.alphabet.letter_likeness import features
from teo_sign_authoring.alphabet.spelling_arm import spelling_bounds
from teo_sign_authoring.linear_program import DIRECTIONS
from teo_sign_capture.retarget.arm_kinematics import ArmKinematics
from teo_sign_capture.retarget.arm_residuals import ELBOW_UP
from teo_sign_capture.retarget.knots import least_clearance
from teo_signs.sign import Sign

# [rad] A palm turns by this much about any axis: what is just seen (`teo_signs.likeness`), a third of the
# 45 deg between a palm to the front and one half to the side.
TURN = np.radians(15.0)
# [m] The end of a finger or thumb moves less than is just seen, the thickness of a finger: two thirds of it.
BEND = 0.010
# [m], [rad] A finger folded by this much at each joint may open farther: it stays folded, where an extended
# finger that bends is soon a hooked one.
FOLDED_BEND, FOLDED = 0.015, np.radians(60.0)
# [m] A letter has no place of its own; it stays within half a hand's length of where the signer made it.
_SHIFT = 0.08
# [m] The elbow goes no farther out and up than this, about its own thickness: a person's hangs, and with it
# raised to the shoulder, as is easiest, the letters of a word are seen far from each other. It costs spelling
# 5 % of its travel; 10 cm would cost 3 %.
_ELBOW = 0.05
# To the right, up, and both, in ``base_link``.
_ELBOW_WAYS = np.array([[0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, -np.sqrt(0.5), np.sqrt(0.5)]])
# Own recording nearer than any other by this [just seen differences].
_AHEAD = 0.2
# Only recordings within this of the own one can come near it [just seen differences].
_RIVAL, _RIVALS = 1.6, 6
# A movement is as large as what of it goes at least this share of the farthest away from its middle.
_FAR = 0.5
# [m] Thumb and fingers nearer than this may meet.
_MEETING = 0.03
# [m] Other parts of TEO keep as far apart: letters as captured keep 25 mm.
_CLEARANCE = 0.015
# [rad], [rad/s], [s] Step of differences; joints about as fast as TEO's, and what a letter was held
# when the tolerances were sought.
_STEP = 2e-3
_SPEED, _RATE, _HOLD = np.radians(50.0), 25.0, 0.3
# Sizes of what no tolerance bounds, by which being beyond is weighed: recognition [just seen], clearance,
# face [m].
_RECOGNITION_SCALE, _MEETING_SCALE, _FACE_SCALE = 0.5, 0.01, 0.02
# Of an offset that cannot be used whole, the shares that are tried.
_SHARES = (1.0, 0.9, 0.8, 0.65, 0.5, 0.3)


class LinearTolerance(NamedTuple):
    """A tolerance about one offset: ``matrix @ offset <= bound``, ``lower <= offset <= upper``.

    Attributes:
        matrix: Shape (r, m).
        bound: Shape (r,).
        scale: Size of each row's quantity: being beyond by this is as bad as for any other row. Shape (r,).
        lower: Least offset of each joint [rad]. Shape (m,).
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
        """Describe the tolerance of a letter as captured, among the features of all recordings by letter."""
        self.sign = sign
        self._robot, self._chain, self._hand = robot, ArmKinematics(robot), HandGeometry(robot)
        self._arm = self._chain.count
        self._poses = self._chain.poses(sign.knots[:, : self._arm])
        self._points = [self._hand.points(row[self._arm :]) for row in sign.knots]
        self._meeting = [np.minimum(self._hand.thumb_clearances(points), 0.0) for points in self._points]
        self._lower, self._upper = self._joint_room()
        self._off_face = np.full(2, np.inf)  # most shift of the palm to the left and up [m]
        self._apart: list[tuple[int, Array]] = []  # finger tips and where to they may not go
        self._turned_from: list[Array] = []  # axes about which the palm may not turn
        self._way: tuple[int, NDArray[np.intp]] | None = None  # finger, and where it is far from its middle
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

    def keep_turned_from(self, other: LetterTolerance) -> None:
        """Do not turn the palm, which tells two letters apart, towards where the other has it."""
        towards = Rotation.from_matrix(other._poses.rotation[0] @ self._poses.rotation[0].T).as_rotvec()
        angle = float(np.linalg.norm(towards))
        if angle > _STEP:  # else they begin alike, and the way of the palm tells them apart
            self._turned_from.append(towards / angle)

    def keep_moving(self) -> None:
        """Let the movement, which tells the letter from another, become no smaller."""
        away = np.linalg.norm(self._from_middle(self._tips(self.sign.knots)), axis=2)
        finger = int(away.max(axis=0).argmax())
        self._way = finger, np.flatnonzero(away[:, finger] >= _FAR * away[:, finger].max())

    def keep_off(self, offset: Array, shift: Array) -> None:
        """Keep the palm where a shift [m] brings it that leaves the face free, shape (3,)."""
        moved = (self._chain.poses((self.sign.knots + offset)[:, : self._arm]).place - self._poses.place).max(
            axis=0
        )
        wanted = np.where(shift != 0.0, moved + shift, np.inf)
        self._off_face = np.minimum(self._off_face, wanted[1:])

    def linear(self, offset: Array, step: float) -> LinearTolerance:
        """The tolerance about an offset [rad], for offsets within a step of it [rad]."""
        blocks = [*self._frame_rows(offset), *self._way_rows(offset), self._recognition_rows(offset)]
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
        poses = self._chain.poses(knots[:, : self._arm])
        points = [self._hand.points(row[self._arm :]) for row in knots]
        fingers = np.stack([points_of.fingers[:, [0, 2, 3]].swapaxes(0, 1) for points_of in points])
        thumb = np.stack([points_of.thumb[2] for points_of in points])
        return features(
            poses.rotation,
            np.einsum("tij,tekj->teki", poses.rotation, fingers) + poses.place[:, None, None],
            np.einsum("tij,tj->ti", poses.rotation, thumb) + poses.place,
        )

    def _joint_room(self) -> tuple[Array, Array]:
        """Least and greatest offset of each joint: its limits, and how far a finger's end may go [rad]."""
        arm_lower, arm_upper = spelling_bounds(self._chain)
        limits, count = self._hand.limits, self._arm
        knots = self.sign.knots
        lower = np.concatenate([arm_lower, limits.lower]) - knots.min(axis=0)
        upper = np.concatenate([arm_upper, limits.upper]) - knots.max(axis=0)
        grid = np.linspace(limits.lower[2], limits.upper[2], 160)
        reached = np.stack(
            [self._hand.points(np.full(len(self._hand.joints), bend)).fingers for bend in grid]
        )
        for points, row in zip(self._points, knots, strict=True):
            away = np.linalg.norm(reached[:, :, 2:] - points.fingers[None, :, 2:], axis=3).max(axis=2)
            for finger, bend in enumerate(row[count + 2 :]):
                inside = grid[away[:, finger] <= (FOLDED_BEND if bend > FOLDED else BEND)]
                column = count + 2 + finger
                lower[column] = max(lower[column], inside.min() - bend)
                upper[column] = min(upper[column], inside.max() - bend)
        # What is captured is within every tolerance, also where rounding has it a hair outside a limit.
        return np.minimum(lower, 0.0), np.maximum(upper, 0.0)

    def _frame_rows(self, offset: Array) -> list[tuple[Array, Array, float]]:
        """What each of the first, middle and last knot may do: rows, what they may change by, size."""
        knots = self.sign.knots + offset
        poses = self._chain.poses(knots[:, : self._arm])
        places = poses.point_jacobian(poses.place)
        elbows = poses.origins[:, self._chain.elbow]
        raising = poses.point_jacobian(elbows) * (np.arange(self._arm) < self._chain.elbow)
        blocks: list[tuple[Array, Array, float]] = []
        for at in sorted({0, len(knots) // 2, len(knots) - 1}):
            turned = Rotation.from_matrix(poses.rotation[at] @ self._poses.rotation[at].T).as_rotvec()
            shifted = poses.place[at] - self._poses.place[at]
            blocks.append((self._of_arm(DIRECTIONS @ poses.axes[at].T), TURN - DIRECTIONS @ turned, TURN))
            blocks.extend(
                (self._of_arm(axis[None] @ poses.axes[at].T), np.array([-axis @ turned]), TURN)
                for axis in self._turned_from
            )
            blocks.append((self._of_arm(DIRECTIONS @ places[at]), _SHIFT - DIRECTIONS @ shifted, _SHIFT))
            captured = self._poses.origins[at, self._chain.elbow]
            rise = float(np.clip(self._chain.shoulder[2] + ELBOW_UP - captured[2], 0.0, _ELBOW))
            room = np.array([_ELBOW, rise, _ELBOW]) - _ELBOW_WAYS @ (elbows[at] - captured)
            blocks.append((self._of_arm(_ELBOW_WAYS @ raising[at]), room, _ELBOW))
            facing = np.isfinite(self._off_face)
            blocks.append(
                (self._of_arm(places[at, 1:][facing]), (self._off_face - shifted[1:])[facing], _FACE_SCALE)
            )
            blocks.extend(self._hand_rows(at, knots[at, self._arm :]))
        return blocks

    def _hand_rows(self, at: int, hand: Array) -> list[tuple[Array, Array, float]]:
        """What thumb and finger tips may do, in one knot."""
        here, captured = self._hand.points(hand), self._points[at]
        moved = [self._hand.points(hand + _STEP * unit) for unit in np.eye(len(hand))]
        thumb = np.column_stack([(points.thumb[2] - here.thumb[2]) / _STEP for points in moved])
        away = here.thumb[2] - captured.thumb[2]
        blocks = [(self._of_hand(DIRECTIONS @ thumb), BEND - DIRECTIONS @ away, BEND)]
        clearance = self._hand.thumb_clearances(here)
        near = np.flatnonzero(clearance < _MEETING)
        slopes = (
            np.stack(
                [self._hand.thumb_clearances(points)[near] - clearance[near] for points in moved], axis=1
            )
            / _STEP
        )
        sure = np.isfinite(slopes).all(axis=1)  # not where the thumb comes over the palm's edge
        room = clearance[near] - self._meeting[at][near]
        blocks.append((self._of_hand(-slopes[sure]), room[sure], _MEETING_SCALE))
        for tip, way in self._apart:
            tips = [
                np.vstack([points.fingers[:, 3], points.thumb[2]])[tip] for points in (captured, here, *moved)
            ]
            slope = np.array([(other - tips[1]) @ way for other in tips[2:]]) / _STEP
            blocks.append((self._of_hand(-slope[None]), np.array([(tips[1] - tips[0]) @ way]), BEND))
        return blocks

    def _way_rows(self, offset: Array) -> list[tuple[Array, Array, float]]:
        """What the movement may become, where it tells the letter from another."""
        if self._way is None:
            return []
        finger, far = self._way
        knots = self.sign.knots + offset
        tips, captured = (self._tips(row)[:, finger] for row in (knots, self.sign.knots))
        carried = self._chain.poses(knots[:, : self._arm]).point_jacobian(tips)
        ways, before = (self._from_middle(points)[far] for points in (tips, captured))
        lengths = np.linalg.norm(ways, axis=1)
        longer = np.einsum("ni,nij->nj", ways / lengths[:, None], self._from_middle(carried)[far])
        return [(-self._of_arm(longer), lengths - np.linalg.norm(before, axis=1), BEND)]

    def _from_middle(self, values: Array) -> Array:
        """Values of each knot, less their mean over the letter's time. Shape (n, ...)."""
        steps = np.diff(self.sign.times)
        shares = (np.append(steps, 0.0) + np.append(0.0, steps)) / (2.0 * steps.sum())
        return values - np.tensordot(shares, values, axes=1)

    def _tips(self, knots: Array) -> Array:
        """Ends of fingers and thumb, in ``base_link`` [m]. Shape (n, digits, 3)."""
        poses = self._chain.poses(knots[:, : self._arm])
        hands = [self._hand.points(row[self._arm :]) for row in knots]
        local = np.stack([np.vstack([hand.fingers[:, 3], hand.thumb[2]]) for hand in hands])
        placed: Array = np.einsum("nij,nfj->nfi", poses.rotation, local) + poses.place[:, None]
        return placed

    def _recognition_rows(self, offset: Array) -> tuple[Array, Array, float]:
        """The own recording stays nearest, by `_AHEAD`."""
        knots = self.sign.knots + offset
        lead = self._lead(knots)
        if not lead.size:
            return np.zeros((0, len(offset))), lead, _RECOGNITION_SCALE
        units = _STEP * np.eye(len(offset))
        slopes = np.column_stack([(self._lead(knots + unit) - lead) / _STEP for unit in units])
        return -slopes, lead - _AHEAD, _RECOGNITION_SCALE

    def _of_arm(self, rows: Array) -> Array:
        """Rows of the arm's joints as rows of all. Shapes (r, j), (r, m)."""
        return np.hstack([rows, np.zeros((len(rows), len(self._hand.joints)))])

    def _of_hand(self, rows: Array) -> Array:
        """Rows of the hand's joints as rows of all. Shapes (r, axes), (r, m)."""
        return np.hstack([np.zeros((len(rows), self._arm)), rows])
