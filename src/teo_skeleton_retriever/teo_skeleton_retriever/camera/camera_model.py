# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A camera: from points to pixels and from pixels with a depth to points."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from teo_skeleton_retriever.arrays import BoolArray, FloatArray, frozen
from teo_skeleton_retriever.camera.distortion import distort, padded, undistort
from teo_skeleton_retriever.errors import RetrieverError


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
        object.__setattr__(self, "distortion", frozen(padded(self.distortion_model, self.distortion)))

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
        pixels[front] = distort(rays, self.distortion) * [self.fx, self.fy] + [self.cx, self.cy]
        return pixels

    def rays(self, pixels: FloatArray) -> FloatArray:
        """Give the points at depth 1 m that are imaged at pixels; times a depth they are the points there.

        Args:
            pixels: [px], fractions too. Shape (n, 2).

        Returns:
            x/z, y/z, 1; NaN where a pixel is NaN or the lens images nothing there. Shape (n, 3).
        """
        points = (np.asarray(pixels, dtype=np.float64) - [self.cx, self.cy]) / [self.fx, self.fy]
        return np.column_stack([undistort(points, self.distortion), np.ones(len(points))])

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
