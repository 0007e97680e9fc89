# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The depth of nose, eyes and ears in a clip, from a head of usual shape.

Five points in the picture and the same five of a rigid head: the head's turn, size and place that bring both
together are sought, in every frame from the frame before.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from teo_common.arrays import Array
from teo_sign_capture.tracks.skeleton_track import EAR, EYE, NOSE

# Places in BODY_25.
POINTS = (NOSE, EYE["right"], EYE["left"], EAR["right"], EAR["left"])

# [m] Forward, left, up, from the middle of the ears: of an adult, to the centimetre. Pupils are 63 mm apart
# and tragi 0.15 m.
HEAD = np.array(
    [
        [0.115, 0.0, -0.025],
        [0.085, -0.032, 0.02],
        [0.085, 0.032, 0.02],
        [0.0, -0.075, 0.0],
        [0.0, 0.075, 0.0],
    ]
)
# [m] How far ears are in front of the shoulders of an upright person.
IN_FRONT = 0.02

# [m] Deviation of a point from a person's own head.
_POINT = 0.01
# [rad] Deviation of the head's turn from straight ahead, and from one frame to the next.
_TURN, _STEP = 0.6, 0.15
# Deviation of a head's size from the usual.
_SIZE = 0.1
_LEAST_POINTS = 3


def lift_head(places: Array) -> tuple[Array, Array]:
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
        depths[frame] = head[:, 0] + IN_FRONT
    sigma = np.where(np.isfinite(depths), 2.0 * _POINT, np.nan)
    return depths, sigma


def _fit(points: Array, seen: NDArray[np.bool_], before: Array) -> tuple[Array, Array]:
    """Turn as a rotation vector, and the five points turned. Shapes (3,) and (5, 3)."""
    middle = points[seen].mean(axis=0)

    def head(x: Array) -> Array:
        turned: Array = np.exp(x[3]) * Rotation.from_rotvec(x[:3]).apply(HEAD)
        return turned

    def residuals(x: Array) -> Array:
        shown = head(x)[seen, 1:]
        away = shown - shown.mean(axis=0) - (points[seen] - middle)
        return np.concatenate(
            [away.ravel() / _POINT, x[:3] / _TURN, (x[:3] - before) / _STEP, [x[3] / _SIZE]]
        )

    found = least_squares(residuals, [*before, 0.0], max_nfev=20).x
    return found[:3], head(found)
