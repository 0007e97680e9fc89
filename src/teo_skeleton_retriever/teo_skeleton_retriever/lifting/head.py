# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The depth of nose, eyes and ears in a clip, from a head of usual shape.

Five points in the picture and the same five of a rigid head: the head's turn, size and place that bring both
together are sought, in every frame from the frame before.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.layouts.person_layout import ROW

# Rows of BODY_25.
POINTS = tuple(ROW[name] for name in ("Nose", "REye", "LEye", "REar", "LEar"))

# [m] Forward, left, up, from the middle of the ears: of an adult, to the centimetre. Pupils are 63 mm apart
# and tragi 0.15 m.
_HEAD_SHAPE = np.array(
    [
        [0.115, 0.0, -0.025],
        [0.085, -0.032, 0.02],
        [0.085, 0.032, 0.02],
        [0.0, -0.075, 0.0],
        [0.0, 0.075, 0.0],
    ]
)
# [m] How far ears are in front of the shoulders of an upright person.
_IN_FRONT = 0.02

# [m] Deviation of a point from a person's own head.
_POINT = 0.01
# [rad] Deviation of the head's turn from straight ahead, and from one frame to the next.
_TURN, _STEP = 0.6, 0.15
# Deviation of a head's size from the usual.
_SIZE = 0.1
_LEAST_POINTS = 3


def lift_head(places: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Find the depth of the head's points.

    Args:
        places: Left and up of the five `POINTS` [m]; NaN where not seen. Shape (T, 5, 2).

    Returns:
        Depth in front of the shoulders [m], NaN where too few points are seen; and its standard deviation.
        Shapes (T, 5).
    """
    depths = np.full(places.shape[:2], np.nan)
    turn = np.zeros(3)
    for frame, points in enumerate(places):
        seen = np.isfinite(points).all(axis=1)
        if seen.sum() < _LEAST_POINTS:
            continue
        turn, head = _fit(points, seen, turn)
        depths[frame] = head[:, 0] + _IN_FRONT
    sigma = np.where(np.isfinite(depths), 2.0 * _POINT, np.nan)
    return depths, sigma


def _fit(points: FloatArray, seen: NDArray[np.bool_], before: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Turn as a rotation vector, and the five points turned. Shapes (3,) and (5, 3).

    The slopes are written out: a film of three seconds asks for 150 fits, and finding them by differences
    takes a second.
    """
    wanted = points[seen] - points[seen].mean(axis=0)
    spread = np.array([*(_TURN,) * 3, *(_STEP,) * 3, _SIZE])
    priors = np.vstack([np.eye(4)[:3], np.eye(4)]) / spread[:, None]
    usual = np.array([0.0, 0.0, 0.0, *before, 0.0]) / spread

    def residuals(x: FloatArray) -> FloatArray:
        shown = _head(x)[seen, 1:]
        away = (shown - shown.mean(axis=0) - wanted).ravel() / _POINT
        return np.concatenate([away, priors @ x - usual])

    def slopes(x: FloatArray) -> FloatArray:
        moved = _slopes(x, _head(x))[seen, 1:]
        return np.vstack([(moved - moved.mean(axis=0)).reshape(-1, 4) / _POINT, priors])

    found = least_squares(residuals, [*before, 0.0], jac=slopes, method="lm").x
    return found[:3], _head(found)


def _head(x: FloatArray) -> FloatArray:
    """The points of a head of some turn and size [m]. Shape (5, 3).

    Args:
        x: Rotation vector [rad], and logarithm of the size as a share of the usual.
    """
    axis, angle = _axis_and_angle(x[:3])
    sin, cos = math.sin(angle), math.cos(angle)
    across = _CROSSED @ axis
    turned = cos * _HEAD_SHAPE + sin * across + (1.0 - cos) * np.outer(_HEAD_SHAPE @ axis, axis)
    head: FloatArray = math.exp(x[3]) * turned
    return head


def _slopes(x: FloatArray, head: FloatArray) -> FloatArray:
    """How the points of a head move with its turn and size. Shape (5, 3, 4)."""
    axis, angle = _axis_and_angle(x[:3])
    # Derivative of a rotation by its vector (J. Sola et al., A micro Lie theory, 2018, eq. 145).
    whole, half = math.sin(angle) / angle, (1.0 - math.cos(angle)) / angle
    jacobian = whole * np.eye(3) + (1.0 - whole) * np.outer(axis, axis) + half * _cross_matrix(axis)
    return np.concatenate([-_cross_matrix(head) @ jacobian, head[..., None]], axis=2)


def _axis_and_angle(vector: FloatArray) -> tuple[FloatArray, float]:
    # No angle of zero, by which would be divided.
    angle = math.sqrt(float(vector @ vector)) + 1e-12
    return vector / angle, angle


def _cross_matrix(points: FloatArray) -> FloatArray:
    """Matrices that multiply a vector by points from the left. Shape (..., 3, 3)."""
    matrices: FloatArray = (points @ _GENERATORS).reshape(*points.shape, 3)
    return matrices


# Cross matrices of the three axes, flat. Shape (3, 9).
_GENERATORS = np.array(
    [
        [0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0],
        [0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    ]
)
# The product of any axis and the points of the head is this times the axis.
_CROSSED = -_cross_matrix(_HEAD_SHAPE)
