"""The depth at a keypoint, from what is around it: holes, contours and things in front do not fool it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from teo_skeleton_retriever.arrays import DepthArray, FloatArray
from teo_skeleton_retriever.errors import DepthError

_MAD_TO_SIGMA = 1.4826  # of a normal distribution
_DENSE_RADIUS = 8.0  # [px] of larger discs every second pixel, third and so on is read: 200 are enough


class DepthSample(NamedTuple):
    """What is known of the depth at a keypoint."""

    depth: float
    """[m]; NaN if nothing was measured around it"""
    sigma: float
    """standard deviation along the optical axis [m]; NaN likewise"""
    support: float
    """share of the measured pixels around that belong to the surface chosen, 0 to 1"""


UNKNOWN = DepthSample(math.nan, math.nan, 0.0)


@dataclass(frozen=True, kw_only=True)
class DepthLookup:
    """Splits the depths around a pixel into surfaces and chooses one.

    Without an expectation it is the nearest surface that is more than specks: keypoints lie on the body, and
    what is behind the body's contour is background. With one (the last depth, or that of the limb's other
    end) it is the surface closest to it, so that a hand before an elbow does not pull the elbow forward.

    Attributes:
        radius: of the disc that is looked at [m], at the depth in question: half a wrist.
        min_radius_px: but no smaller than this: single pixels are holes or flying pixels [px].
        max_radius_px: and no larger, for the time it takes [px].
        gap: depths that are this far apart belong to different surfaces [m]: less than a forearm before a
            chest, more than the steps of noise and slopes of a body within the disc.
        min_support: a surface with a smaller share of the disc's measured pixels is specks (flying pixels at
            an edge lie between foreground and background).
        noise: smallest sigma, at 1 m [m]; grows with the square of the depth, as stereo noise does. 2 mm is
            the data sheet figure of the D435.

    Raises:
        DepthError: a value makes no lookup.
    """

    radius: float = 0.03
    min_radius_px: float = 1.5
    max_radius_px: float = 20.0
    gap: float = 0.06
    min_support: float = 0.15
    noise: float = 0.002

    def __post_init__(self) -> None:
        values = (self.radius, self.min_radius_px, self.max_radius_px, self.gap, self.noise)
        if not all(math.isfinite(value) and value > 0.0 for value in values):
            raise DepthError("bad_lookup", f"expected positive lengths, got {values}")
        if self.min_radius_px > self.max_radius_px or not 0.0 <= self.min_support < 1.0:
            raise DepthError(
                "bad_lookup", "expected min_radius_px <= max_radius_px and a min_support from 0 to below 1"
            )

    def at(
        self, depth: DepthArray, pixel: FloatArray, *, focal: float, expected: float | None = None
    ) -> DepthSample:
        """Tell the depth at a keypoint.

        Args:
            depth: [m], NaN where unknown. Shape (height, width).
            pixel: x, y [px]. Shape (2,).
            focal: length of the camera [px].
            expected: depth that the keypoint should have about [m]; None or not finite if there is none.

        Returns:
            `UNKNOWN` if the pixel is outside the image or nothing was measured around it.
        """
        x, y = float(pixel[0]), float(pixel[1])
        height, width = depth.shape
        if not (-0.5 <= x < width - 0.5 and -0.5 <= y < height - 0.5):
            return UNKNOWN
        expectation = (
            expected if expected is not None and math.isfinite(expected) and expected > 0.0 else None
        )
        values, distances = self._disc(depth, x, y, self._radius_px(expectation, focal))
        if not len(values):
            values, distances = self._disc(depth, x, y, self.max_radius_px)
        elif expectation is None:
            # The disc's size follows from the depth that it is to find: look again at the size that fits.
            values, distances = self._disc(depth, x, y, self._radius_px(float(values.min()), focal))
        if not len(values):
            return UNKNOWN
        return self._choose(values, distances, expectation)

    def _radius_px(self, depth: float | None, focal: float) -> float:
        if depth is None:
            return self.max_radius_px / 2.0
        return min(max(self.radius * focal / depth, self.min_radius_px), self.max_radius_px)

    @staticmethod
    def _disc(depth: DepthArray, x: float, y: float, radius: float) -> tuple[FloatArray, FloatArray]:
        """Give the measured depths around a pixel, ascending, and their squared distances to it [px^2]."""
        stride = math.ceil(radius / _DENSE_RADIUS)
        left, top = max(math.ceil(x - radius), 0), max(math.ceil(y - radius), 0)
        patch = depth[top : math.floor(y + radius) + 1 : stride, left : math.floor(x + radius) + 1 : stride]
        rows = np.arange(patch.shape[0]) * stride + (top - y)
        columns = np.arange(patch.shape[1]) * stride + (left - x)
        distances = rows[:, None] ** 2 + columns**2
        chosen = (patch > 0.0) & (distances <= radius * radius)  # NaN is not above zero
        values = patch[chosen].astype(np.float64)
        order = values.argsort(kind="stable")
        return values[order], distances[chosen][order]

    def _choose(self, values: FloatArray, distances: FloatArray, expected: float | None) -> DepthSample:
        cuts = np.flatnonzero(values[1:] - values[:-1] > self.gap) + 1
        edges = [0, *cuts.tolist(), len(values)]
        surfaces = list(pairwise(edges))
        solid = [(i, k) for i, k in surfaces if k - i >= self.min_support * len(values)]
        # Very torn patches have no solid surface: then the largest piece is the best there is.
        candidates = solid or [max(surfaces, key=lambda surface: surface[1] - surface[0])]
        first, last = candidates[0]
        if expected is not None and len(candidates) > 1:
            first, last = min(candidates, key=lambda s: abs(_median(values[s[0] : s[1]]) - expected))
        return self._sample(values[first:last], distances[first:last], (last - first) / len(values))

    def _sample(self, values: FloatArray, distances: FloatArray, support: float) -> DepthSample:
        # The nearest half of the surface: of a slope cut by a contour the median lies to one side.
        half = (len(values) - 1) // 2
        near = values[distances <= np.partition(distances, half)[half]]
        depth = _median(near)
        deviations = np.abs(values - depth)
        deviations.sort()
        return DepthSample(
            depth, math.hypot(_MAD_TO_SIGMA * _median(deviations), self.noise * depth * depth), support
        )


def _median(ascending: FloatArray) -> float:
    """Median of values in order; many times as fast as one that has to sort."""
    n = len(ascending)
    return float(ascending[(n - 1) // 2] + ascending[n // 2]) / 2.0
