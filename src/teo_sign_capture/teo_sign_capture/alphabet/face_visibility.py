# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Keeps the signing hand from hiding TEO's face: who reads signs looks at it."""

from __future__ import annotations

import numpy as np

from teo_common.arrays import Array
from teo_description import RIGHT_ARM, RIGHT_HAND
from teo_description.hand_geometry import FINGERS
from teo_description.robot import Robot
from teo_sign_capture.alphabet.spelling_arm import PALM_FRAME

# [m] TEO's face in ``base_link`` at home: half its width, its lower and upper edge, how far before the axis.
_HALF_WIDTH, _CHIN, _TOP, _PLANE = 0.10, 0.625, 0.80, 0.09
# [m] A viewer at conversation distance, at the height of TEO's eyes.
_EYE = np.array([2.2, 0.0, 0.72])
# [m] Half the thickness of a finger, and a little.
_RADIUS = 0.012

_FRAMES = (
    PALM_FRAME,
    "right_sensor_plate",
    *(
        f"Right{finger}Finger{part}"
        for finger in FINGERS
        for part in ("_link", "Middle_link", "Distal_link", "Tip")
    ),
    *(f"RightThumbFinger{part}" for part in ("_link", "Distal_link", "Tip")),
)


def shift_off_face(robot: Robot, positions: Array) -> Array:
    """How a motion must be moved so that no part of the hand is seen before the face.

    Args:
        robot: The robot.
        positions: Joints of right arm and hand [rad]. Shape (n, 12).

    Returns:
        Shift of the hand in ``base_link`` [m], to TEO's right or down, whichever is less; zeros when nothing
        is hidden. Shape (3,).
    """
    points = np.concatenate([_hand_points(robot, row) for row in positions])
    depth = _EYE[0] - points[:, 0]
    seen = _EYE[1:] + (points[:, 1:] - _EYE[1:]) * ((_EYE[0] - _PLANE) / depth)[:, None]
    beside = np.abs(seen[:, 0]) > _HALF_WIDTH + _RADIUS
    off = (seen[:, 1] < _CHIN - _RADIUS) | (seen[:, 1] > _TOP + _RADIUS)
    hiding = ~(beside | off)
    if not hiding.any():
        return np.zeros(3)
    shrink = (depth[hiding] / (_EYE[0] - _PLANE)).max()
    level = seen[~off]
    right = shrink * float(level[:, 0].max() + _HALF_WIDTH + _RADIUS)
    before = seen[~beside]
    down = shrink * float(before[:, 1].max() - _CHIN + _RADIUS)
    return np.array([0.0, -right, 0.0]) if right <= down else np.array([0.0, 0.0, -down])


def _hand_points(robot: Robot, row: Array) -> Array:
    q = robot.configuration(dict(zip(RIGHT_ARM + RIGHT_HAND, row.tolist(), strict=True)))
    places: Array = robot.placements(q, _FRAMES)[:, :3, 3]
    return places
