# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A robot's entry of a sign as postures in another robot's space.

For signs of which nothing but one robot's joints is known. What those show is read off: where a hand is by
the places of the body about it, which way palm and fingers point, how the fingers are bent.
"""

from __future__ import annotations

import numpy as np
from scipy.interpolate import RBFInterpolator

from teo_common.arrays import Array
from teo_description.hand_geometry import HandTable, hand_table
from teo_description.humanoid import Humanoid, Side
from teo_description.robot import Robot
from teo_sign_authoring.notation.score_schema import Hands
from teo_sign_authoring.notation.targets import HandTarget, Posture
from teo_sign_capture.retarget.arm_kinematics import ArmKinematics, mirrored, mirrored_hand
from teo_sign_capture.retarget.handshapes import follow_robot_hand
from teo_sign_capture.signing_space import MIRROR, find_place
from teo_signs.sign import Sign

# [m] A finger tip nearer than this to a place of the body shows it.
_AT_PLACE = 0.05


class BodyToBody:
    """The map of one robot's space to another's by the places that both have, smooth between them.

    Linear radial basis functions with an affine part (`scipy.interpolate.RBFInterpolator`): a place goes to
    the same place, and what is far from all goes as they do on the whole.
    """

    def __init__(self, ours: Humanoid, theirs: Humanoid) -> None:
        """Find the map from our space to theirs."""
        self._names = sorted(set(ours.file.places) & set(theirs.file.places))
        right, other = (
            np.array([find_place(humanoid, name).point for name in self._names])
            for humanoid in (ours, theirs)
        )
        on_body = [find_place(ours, name).body for name in self._names]
        self._body = right[on_body]
        self._outward = np.array([find_place(theirs, name).outward for name in self._names])[on_body]
        from_places, to_places = np.vstack([right, right * MIRROR]), np.vstack([other, other * MIRROR])
        kept = np.unique(np.round(from_places, 6), axis=0, return_index=True)[1]
        self._map = RBFInterpolator(from_places[kept], to_places[kept], kernel="linear", degree=1)

    def __call__(self, points: Array) -> Array:
        """Points of the other robot's space [m]. Shapes (n, 3)."""
        return np.asarray(self._map(points))

    def nearest(self, point: Array) -> tuple[float, Array]:
        """How far a point is from the nearest place of the body [m], and the way out of theirs there."""
        away = np.linalg.norm(self._body - point, axis=1)
        return float(away.min()), self._outward[int(away.argmin())]


def entry_postures(source: Robot, sign: Sign, robot: Robot) -> tuple[Hands, list[Posture]]:
    """Read an entry for the robot `source`: the hands that sign, and the postures of `robot` at the knots."""
    body = BodyToBody(source.humanoid, robot.humanoid)
    tables = hand_table(source), hand_table(robot)
    right = _targets(source, sign, "right", body, *tables)
    left = _targets(source, sign, "left", body, *tables) if sign.handedness == "both" else [None] * len(right)
    turns, bows = (_head(source.humanoid, sign, way) for way in ("yaw", "pitch"))
    postures = [
        Posture(time=time, right=of_right, left=of_left, turn=-turn, bow=bow)
        for time, of_right, of_left, turn, bow in zip(
            sign.times.tolist(), right, left, turns.tolist(), bows.tolist(), strict=True
        )
    ]
    return ("both" if sign.handedness == "both" else "right"), postures


def _targets(
    source: Robot, sign: Sign, side: Side, body: BodyToBody, theirs: HandTable, table: HandTable
) -> list[HandTarget]:
    humanoid = source.humanoid
    arm, hand = (
        sign.knots[:, [sign.joints.index(name) for name in names]]
        for names in (humanoid.arm(side), humanoid.hand(side))
    )
    if side == "left":
        arm, hand = mirrored(humanoid, arm), mirrored_hand(humanoid, hand)
    poses = ArmKinematics(source).poses(arm)
    shapes = follow_robot_hand(theirs, hand, table)
    index = theirs.finger_points(hand[:, 2:])[:, 0, 3]
    tips = poses.points(index)
    found = []
    for row, shape in enumerate(shapes):
        away, outward = body.nearest(tips[row])
        at_place = away < _AT_PLACE
        point = tips[row] if at_place else poses.place[row]
        found.append(
            HandTarget(
                shape=shape,
                part="index" if at_place else "palm",
                other="",
                point=body(point[None])[0],
                outward=outward,
                body=at_place,
                palm=poses.rotation[row, :, 2],
                fingers=poses.rotation[row, :, 0],
            )
        )
    return found


def _head(humanoid: Humanoid, sign: Sign, way: str) -> Array:
    """How far the head is turned at the knots [rad]; 0 where the sign moves it not so."""
    joint = dict(humanoid.file.groups.head).get(way)  # type: ignore[call-overload]
    if joint is None or joint not in sign.joints:
        return np.zeros(len(sign.times))
    return sign.knots[:, sign.joints.index(joint)]
