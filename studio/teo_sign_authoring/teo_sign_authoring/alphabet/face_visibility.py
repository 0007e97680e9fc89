# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Keeps the signing hand from hiding a robot's face: who reads signs looks at it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from teo_common.arrays import Array
from teo_description.humanoid import Humanoid
from teo_description.robot import Robot
from teo_sign_capture.signing_space import find_place

# [m] What the face reaches beyond its places: below the chin, to the side of an ear, behind the mouth, which
# is on the surface that counts in a collision; it ends so much below the crown.
_BELOW_CHIN, _BESIDE_EAR, _BEHIND_MOUTH, _BELOW_CROWN = 0.015, 0.001, 0.012, 0.015
# [m] How far before the robot a viewer at conversation distance is, eyes at the height of its own.
_VIEWER = 2.2
# [m] Half the thickness of a finger, and a little.
_RADIUS = 0.012


class _Face(NamedTuple):
    """A face in ``base_link`` at home, and who looks at it [m]."""

    half_width: float
    chin: float
    top: float
    plane: float
    eye: Array


def _face(humanoid: Humanoid) -> _Face:
    ear, mouth, chin, crown, eye = (
        find_place(humanoid, name).point for name in ("ear", "mouth", "chin", "head_top", "eye")
    )
    return _Face(
        half_width=round(abs(float(ear[1])) + _BESIDE_EAR, 3),
        chin=round(float(chin[2]) - _BELOW_CHIN, 3),
        top=round(float(crown[2]) - _BELOW_CROWN, 3),
        plane=round(float(mouth[0]) - _BEHIND_MOUTH, 3),
        eye=np.array([_VIEWER, 0.0, round(float(eye[2]), 2)]),
    )


def shift_off_face(robot: Robot, positions: Array) -> Array:
    """How a motion must be moved so that no part of the hand is seen before the face.

    Args:
        robot: The robot.
        positions: Joints of right arm and hand [rad]. Shape (n, joints).

    Returns:
        Shift of the hand in ``base_link`` [m], to the robot's right or down, whichever is less; zeros when
        nothing is hidden. Shape (3,).
    """
    face = _face(robot.humanoid)
    points = np.concatenate([_hand_points(robot, row) for row in positions])
    depth = face.eye[0] - points[:, 0]
    seen = face.eye[1:] + (points[:, 1:] - face.eye[1:]) * ((face.eye[0] - face.plane) / depth)[:, None]
    beside = np.abs(seen[:, 0]) > face.half_width + _RADIUS
    off = (seen[:, 1] < face.chin - _RADIUS) | (seen[:, 1] > face.top + _RADIUS)
    hiding = ~(beside | off)
    if not hiding.any():
        return np.zeros(3)
    shrink = (depth[hiding] / (face.eye[0] - face.plane)).max()
    level = seen[~off]
    right = shrink * float(level[:, 0].max() + face.half_width + _RADIUS)
    before = seen[~beside]
    down = shrink * float(before[:, 1].max() - face.chin + _RADIUS)
    return np.array([0.0, -right, 0.0]) if right <= down else np.array([0.0, 0.0, -down])


def _hand_points(robot: Robot, row: Array) -> Array:
    humanoid, hand = robot.humanoid, robot.humanoid.file.hand
    joints = humanoid.arm("right") + humanoid.hand("right")
    q = robot.configuration(dict(zip(joints, row.tolist(), strict=True)))
    frames = [hand.palm, *(frame for finger in hand.fingers.values() for frame in finger), *hand.thumb]
    placed = robot.placements(q, frames)
    heel = placed[0, :3, :3] @ np.array(hand.heel) + placed[0, :3, 3]
    return np.vstack([placed[:, :3, 3], heel])
