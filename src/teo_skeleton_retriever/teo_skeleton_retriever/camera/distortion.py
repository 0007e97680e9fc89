# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Lens distortion of the `plumb_bob` and `rational_polynomial` models, both ways.

Source: the model of OpenCV's calibration, which sensor_msgs/CameraInfo refers to. Coefficients are in its
order: k1, k2, p1, p2, k3 (plumb_bob), k4, k5, k6 (rational_polynomial).
"""

from __future__ import annotations

import cv2
import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.errors import RetrieverError

# How many each model has; a camera without a model has none.
COEFFICIENTS = {"": 0, "plumb_bob": 5, "rational_polynomial": 8}
# OpenCV's fixed-point iteration: lenses of depth cameras need 10 to 100 steps to the tolerance, which is
# 1e-10 px at any focal length in use.
_CRITERIA = (cv2.TERM_CRITERIA_COUNT | cv2.TERM_CRITERIA_EPS, 200, 1e-13)
# What counts as landing on a pixel, in normalised coordinates: 1e-6 px.
_RESIDUAL = 1e-9


def padded(model: str, coefficients: FloatArray) -> FloatArray:
    """Check coefficients and bring them to the eight of the widest model. Shape (8,).

    Raises:
        RetrieverError: An unknown model, another number of coefficients or one that is not finite.
    """
    if model not in COEFFICIENTS:
        known = ", ".join(name for name in COEFFICIENTS if name)
        raise RetrieverError("unknown_distortion", f"expected one of {known} or none, got {model!r}")
    flat = np.asarray(coefficients, dtype=np.float64).ravel()
    # Four are OpenCV's short form of plumb_bob; drivers with no distortion send none.
    expected = {0, COEFFICIENTS[model]} | ({4} if model == "plumb_bob" else set())
    if len(flat) not in expected:
        raise RetrieverError(
            "wrong_distortion", f"{model or 'no model'}: expected {expected} values, got {len(flat)}"
        )
    if not np.isfinite(flat).all():
        raise RetrieverError("not_finite", "distortion: expected finite coefficients, got NaN or infinity")
    return np.concatenate([flat, np.zeros(8 - len(flat))])


def distort(points: FloatArray, coefficients: FloatArray) -> FloatArray:
    """Apply the distortion to normalised coordinates.

    Args:
        points: x/z, y/z. Shape (n, 2).
        coefficients: Of `padded`. Shape (8,).

    Returns:
        Shape (n, 2).
    """
    return _distort_with_jacobian(points, coefficients)[0]


def undistort(points: FloatArray, coefficients: FloatArray) -> FloatArray:
    """Invert `distort`.

    Returns:
        x/z, y/z; NaN where no ray inside the lens's monotonic region is imaged there. Shape (n, 2).
    """
    if not coefficients.any() or not len(points):
        return points.copy()
    found: FloatArray = cv2.undistortPoints(
        points[:, None], np.eye(3), coefficients, None, None, None, _CRITERIA
    )[:, 0]
    with np.errstate(all="ignore"):
        image, jacobian = _distort_with_jacobian(found, coefficients)
        residual = np.abs(image - points).max(axis=1)
        # Beyond the fold of the polynomial other rays land on the same pixel: there the image is turned over
        # (a negative determinant) or mirrored through the middle (a negative trace).
        right_way = (np.linalg.det(jacobian) > 0.0) & (np.trace(jacobian, axis1=1, axis2=2) > 0.0)
        good = (residual < _RESIDUAL) & right_way
    found[~good] = np.nan
    return found


def _distort_with_jacobian(points: FloatArray, coefficients: FloatArray) -> tuple[FloatArray, FloatArray]:
    k1, k2, p1, p2, k3, k4, k5, k6 = coefficients
    x, y = points[:, 0], points[:, 1]
    r2 = x * x + y * y
    above = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3))
    below = 1.0 + r2 * (k4 + r2 * (k5 + r2 * k6))
    radial = above / below
    slope = (  # d radial / d r2
        (k1 + r2 * (2 * k2 + r2 * 3 * k3)) * below - above * (k4 + r2 * (2 * k5 + r2 * 3 * k6))
    ) / below**2
    image = np.column_stack(
        [
            x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
            y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y,
        ]
    )
    jacobian = np.empty((len(points), 2, 2))
    jacobian[:, 0, 0] = radial + 2 * x * x * slope + 2 * p1 * y + 6 * p2 * x
    jacobian[:, 0, 1] = 2 * x * y * slope + 2 * p1 * x + 2 * p2 * y
    jacobian[:, 1, 0] = jacobian[:, 0, 1]
    jacobian[:, 1, 1] = radial + 2 * y * y * slope + 6 * p1 * y + 2 * p2 * x
    return image, jacobian
