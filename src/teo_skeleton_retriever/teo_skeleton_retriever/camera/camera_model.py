# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A camera: from points to pixels and from pixels with a depth to points.

Lens distortion is that of the `plumb_bob` and `rational_polynomial` models of OpenCV's calibration, which
sensor_msgs/CameraInfo refers to. Coefficients are in its order: k1, k2, p1, p2, k3 (plumb_bob), k4, k5, k6
(rational_polynomial).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import cv2
import numpy as np

from teo_skeleton_retriever.arrays import BoolArray, FloatArray, frozen
from teo_skeleton_retriever.errors import RetrieverError

# How many each model has; a camera without a model has none.
_COEFFICIENTS = {"": 0, "plumb_bob": 5, "rational_polynomial": 8}
# OpenCV's fixed-point iteration: lenses of depth cameras need 10 to 100 steps to the tolerance, which is
# 1e-10 px at any focal length in use.
_CRITERIA = (cv2.TERM_CRITERIA_COUNT | cv2.TERM_CRITERIA_EPS, 200, 1e-13)
# What counts as landing on a pixel, in normalised coordinates: 1e-6 px.
_RESIDUAL = 1e-9


def _padded(model: str, coefficients: FloatArray) -> FloatArray:
    """Check coefficients and bring them to the eight of the widest model. Shape (8,).

    Raises:
        RetrieverError: An unknown model, another number of coefficients or one that is not finite.
    """
    if model not in _COEFFICIENTS:
        known = ", ".join(name for name in _COEFFICIENTS if name)
        raise RetrieverError("unknown_distortion", f"expected one of {known} or none, got {model!r}")
    flat = np.asarray(coefficients, dtype=np.float64).ravel()
    # Four are OpenCV's short form of plumb_bob; drivers with no distortion send none.
    expected = {0, _COEFFICIENTS[model]} | ({4} if model == "plumb_bob" else set())
    if len(flat) not in expected:
        raise RetrieverError(
            "wrong_distortion", f"{model or 'no model'}: expected {expected} values, got {len(flat)}"
        )
    if not np.isfinite(flat).all():
        raise RetrieverError("not_finite", "distortion: expected finite coefficients, got NaN or infinity")
    return np.concatenate([flat, np.zeros(8 - len(flat))])


def _undistort(points: FloatArray, coefficients: FloatArray) -> FloatArray:
    """Invert `_distort`.

    Returns:
        x/z, y/z; NaN where no ray inside the lens's monotonic region is imaged there. Shape (n, 2).
    """
    if not coefficients.any() or not len(points):
        return points.copy()
    found: FloatArray = cv2.undistortPoints(
        points[:, None], np.eye(3), coefficients, None, None, None, _CRITERIA
    )[:, 0]
    with np.errstate(all="ignore"):
        image, jacobian = _distort(found, coefficients)
        residual = np.abs(image - points).max(axis=1)
        # Beyond the fold of the polynomial other rays land on the same pixel: there the image is turned over
        # (a negative determinant) or mirrored through the middle (a negative trace).
        right_way = (np.linalg.det(jacobian) > 0.0) & (np.trace(jacobian, axis1=1, axis2=2) > 0.0)
        good = (residual < _RESIDUAL) & right_way
    found[~good] = np.nan
    return found


def _distort(points: FloatArray, coefficients: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Apply the distortion to normalised coordinates; its Jacobian beside it. Shapes (n, 2), (n, 2, 2).

    Args:
        points: x/z, y/z. Shape (n, 2).
        coefficients: Of `_padded`. Shape (8,).
    """
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


@dataclass(frozen=True, eq=False, kw_only=True)
class CameraModel:
    """Pinhole with lens distortion. The centre of the first pixel is at (0, 0); z is along the optical axis.

    Attributes:
        width: Of the image [px].
        height: Of the image [px].
        fx: Focal length [px].
        fy: Focal length [px].
        cx: Principal point [px].
        cy: Principal point [px].
        distortion_model: As in sensor_msgs/CameraInfo: "plumb_bob", "rational_polynomial" or "" for none.
        distortion: Its coefficients, in OpenCV's order; kept as the eight of the widest model.

    Raises:
        RetrieverError: A number that makes no camera.
    """

    width: int
    height: int
    fx: float
    fy: float
    cx: float
    cy: float
    distortion_model: str = ""
    distortion: FloatArray = field(default_factory=lambda: np.zeros(0))

    def __post_init__(self) -> None:
        if self.width <= 0 or self.height <= 0:
            raise RetrieverError(
                "bad_size", f"expected a width and height above 0 px, got {self.width} x {self.height}"
            )
        if not all(math.isfinite(value) for value in (self.fx, self.fy, self.cx, self.cy)):
            raise RetrieverError("not_finite", "expected finite fx, fy, cx, cy, got NaN or infinity")
        if self.fx <= 0.0 or self.fy <= 0.0:
            raise RetrieverError(
                "no_focal_length",
                f"expected focal lengths > 0 px, got {self.fx}, {self.fy}; uncalibrated drivers send 0",
            )
        object.__setattr__(self, "distortion", frozen(_padded(self.distortion_model, self.distortion)))

    @classmethod
    def from_field_of_view(cls, *, width: int, height: int, horizontal: float) -> CameraModel:
        """Build the original skeletonRetriever's camera: one focal length, centred, no distortion.

        Args:
            width: Of the image [px].
            height: Of the image [px].
            horizontal: Field of view [rad].

        Raises:
            RetrieverError: The angle is not between 0 and pi.
        """
        if not 0.0 < horizontal < math.pi:
            raise RetrieverError(
                "bad_field_of_view", f"expected an angle between 0 and pi rad, got {horizontal}"
            )
        focal = width / (2.0 * math.tan(horizontal / 2.0))
        return cls(width=width, height=height, fx=focal, fy=focal, cx=(width - 1) / 2, cy=(height - 1) / 2)

    @classmethod
    def from_camera_info(
        cls, *, width: int, height: int, k: FloatArray, d: FloatArray, distortion_model: str
    ) -> CameraModel:
        """Build from the fields of sensor_msgs/CameraInfo.

        Args:
            width: [px].
            height: [px].
            k: Intrinsic matrix, row by row. Shape (9,) or (3, 3).
            d: Distortion coefficients.
            distortion_model: Their model.

        Raises:
            RetrieverError: The matrix has another shape, a skew or other numbers that make no camera.
        """
        flat = np.asarray(k, dtype=np.float64).ravel()
        if len(flat) != 9:
            raise RetrieverError("wrong_shape", f"k: expected 9 numbers, got {len(flat)}")
        if flat[1] != 0.0:
            raise RetrieverError("skewed", f"k: expected no skew, got {flat[1]}")
        return cls(
            width=width,
            height=height,
            fx=float(flat[0]),
            fy=float(flat[4]),
            cx=float(flat[2]),
            cy=float(flat[5]),
            distortion_model=distortion_model,
            distortion=np.asarray(d, dtype=np.float64),
        )

    def project(self, points: FloatArray) -> FloatArray:
        """Project points to pixels, also outside the image.

        Args:
            points: [m]. Shape (n, 3).

        Returns:
            [px]; NaN for a point that is not before the camera. Shape (n, 2).
        """
        points = np.asarray(points, dtype=np.float64)
        pixels = np.full((len(points), 2), np.nan)
        front = points[:, 2] > 0.0
        rays = points[front, :2] / points[front, 2:]
        pixels[front] = _distort(rays, self.distortion)[0] * [self.fx, self.fy] + [self.cx, self.cy]
        return pixels

    def rays(self, pixels: FloatArray) -> FloatArray:
        """Give the points at depth 1 m that are imaged at pixels; times a depth they are the points there.

        Args:
            pixels: [px], fractions too. Shape (n, 2).

        Returns:
            x/z, y/z, 1; NaN where a pixel is NaN or the lens images nothing there. Shape (n, 3).
        """
        points = (np.asarray(pixels, dtype=np.float64) - [self.cx, self.cy]) / [self.fx, self.fy]
        return np.column_stack([_undistort(points, self.distortion), np.ones(len(points))])

    def unproject(self, pixels: FloatArray, depths: FloatArray) -> FloatArray:
        """Give the points that are imaged at pixels, at these depths along the optical axis.

        Args:
            pixels: [px]. Shape (n, 2).
            depths: [m]; not finite or not above zero means unknown. Shape (n,).

        Returns:
            [m]; NaN where the depth is unknown. Shape (n, 3).
        """
        depths = np.asarray(depths, dtype=np.float64)
        known = np.where(np.isfinite(depths) & (depths > 0.0), depths, np.nan)
        points: FloatArray = self.rays(pixels) * known[:, None]
        return points

    def contains(self, pixels: FloatArray) -> BoolArray:
        """Tell which pixels lie in the image, to its outer edge. Shape (n,), of booleans."""
        pixels = np.asarray(pixels, dtype=np.float64)
        inside: BoolArray = np.all(
            (pixels >= -0.5) & (pixels < [self.width - 0.5, self.height - 0.5]), axis=1
        )
        return inside
