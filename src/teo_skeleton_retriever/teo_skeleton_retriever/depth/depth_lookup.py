# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What one image shows at keypoints: their viewing rays, and the surfaces that depth shows around them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from teo_skeleton_retriever.arrays import BoolArray, DepthArray, FloatArray
from teo_skeleton_retriever.camera.camera_model import CameraModel


class ViewingRays(NamedTuple):
    """Keypoints in one image; not seen ones are NaN with confidence 0."""

    pixels: FloatArray
    """[px]. Shape (n, 2)"""
    rays: FloatArray
    """x/z, y/z. Shape (n, 2)"""
    confidence: FloatArray
    """0 to 1. Shape (n,)"""
    seen: BoolArray
    """Shape (n,)"""

    def only(self, believed: BoolArray) -> ViewingRays:
        """Treat keypoints that are not believed as not seen."""
        return ViewingRays(
            np.where(believed[:, None], self.pixels, np.nan),
            np.where(believed[:, None], self.rays, np.nan),
            np.where(believed, self.confidence, 0.0),
            self.seen & believed,
        )

    def part(self, rows: slice) -> ViewingRays:
        """Keep some of the keypoints."""
        return ViewingRays(self.pixels[rows], self.rays[rows], self.confidence[rows], self.seen[rows])


def viewing_rays(keypoints: FloatArray, camera: CameraModel, min_confidence: float) -> ViewingRays:
    """Keep the keypoints that are in the image and that the detector is sure of.

    Args:
        keypoints: x, y [px], confidence. Shape (n, 3).
        camera: Of the image.
        min_confidence: Of the detector; 0 means absent in every layout, whatever is asked.
    """
    seen = (keypoints[:, 2] >= min_confidence) & (keypoints[:, 2] > 0.0) & camera.contains(keypoints[:, :2])
    pixels = np.where(seen[:, None], keypoints[:, :2], np.nan)
    rays = np.full((len(keypoints), 2), np.nan)
    rays[seen] = camera.rays(pixels[seen])[:, :2]
    seen &= np.isfinite(rays).all(axis=1)  # a lens may image nothing there
    confidence = np.where(seen, np.clip(keypoints[:, 2], 0.0, 1.0), 0.0)
    return ViewingRays(pixels, rays, confidence, seen)


_MAD_TO_SIGMA = 1.4826  # of a normal distribution
# Samples from the centre of a disc to its edge: 49 in all, enough for a median to a tenth of the noise.
_RINGS = 4
_LAYERS = 3  # surfaces told apart around a keypoint: a hand, the arm or chest behind it, the wall


def _template() -> tuple[FloatArray, FloatArray]:
    """Give the samples of a disc of radius 1, from the centre outwards. Shapes (m, 2), (m,)."""
    steps = np.arange(-_RINGS, _RINGS + 1) / _RINGS
    grid = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    distance = np.hypot(grid[:, 0], grid[:, 1])
    order = np.argsort(distance, kind="stable")
    order = order[distance[order] <= 1.0]
    return grid[order], distance[order]


_OFFSETS, _DISTANCES = _template()


class DepthSamples(NamedTuple):
    """What is known of the depth at n keypoints."""

    depth: FloatArray
    """[m]; NaN where nothing was measured around. Shape (n,)"""
    sigma: FloatArray
    """standard deviation along the optical axis [m]; NaN likewise. Shape (n,)"""


class Surfaces(NamedTuple):
    """The surfaces around n keypoints, from near to far; missing ones are NaN with support 0."""

    depth: FloatArray
    """[m]. Shape (n, 3)"""
    sigma: FloatArray
    """standard deviation along the optical axis [m]. Shape (n, 3)"""
    support: FloatArray
    """share of the measured pixels around that belong to each, 0 to 1. Shape (n, 3)"""

    def part(self, rows: slice | list[int]) -> Surfaces:
        """Keep some of the keypoints."""
        return Surfaces(self.depth[rows], self.sigma[rows], self.support[rows])

    def between(self, near: float, far: float) -> Surfaces:
        """Drop surfaces that are nearer or farther [m]; a NaN bound drops none."""
        with np.errstate(invalid="ignore"):
            return self.without((self.depth < near) | (self.depth > far))

    def without(self, dropped: BoolArray) -> Surfaces:
        """Drop surfaces. Shape (n, 3)."""
        return Surfaces(
            np.where(dropped, np.nan, self.depth),
            np.where(dropped, np.nan, self.sigma),
            np.where(dropped, 0.0, self.support),
        )

    def nearest(self) -> DepthSamples:
        """Choose the nearest: keypoints lie on the body, and what is behind its contour is background."""
        return DepthSamples(self.depth[:, 0], self.sigma[:, 0])

    def closest(self, expected: FloatArray) -> DepthSamples:
        """Choose the surface closest to an expected depth, so that a hand before an elbow does not pull it.

        Args:
            expected: [m]; where it is NaN the nearest surface is chosen. Shape (n,).
        """
        misfit = np.abs(self.depth - np.where(np.isfinite(expected), expected, 0.0)[:, None])
        best = np.argmin(np.where(np.isfinite(misfit), misfit, np.inf), axis=1)
        rows = np.arange(len(best))
        return DepthSamples(self.depth[rows, best], self.sigma[rows, best])


# [px] A disc is no smaller, as single pixels are holes or flying pixels, and no larger. The largest is looked
# at where the smaller disc is a hole.
_MIN_RADIUS, _MAX_RADIUS = 1.5, 20.0
# Of a disc's measured pixels: a smaller surface is specks. Flying pixels at an edge lie between foreground
# and background.
_MIN_SUPPORT = 0.1
_NOISE = 0.002  # [m] least sigma at 1 m, which grows with the square of the depth: the data sheet of the D435


class DepthLookup:
    """Splits the depths in a disc around each keypoint into surfaces."""

    def __init__(self, *, nearest: float, farthest: float) -> None:
        """Set what counts as measured: nearer is noise, farther is background [m]."""
        self._nearest = nearest
        self._farthest = farthest

    def surfaces(
        self,
        depth: DepthArray,
        pixels: FloatArray,
        *,
        focal: float,
        distance: FloatArray,
        radius: float | FloatArray,
        gap: float | FloatArray,
    ) -> Surfaces:
        """Find the surfaces around keypoints.

        Args:
            depth: [m], NaN where unknown. Shape (height, width).
            pixels: x, y [px]; NaN or outside the image is nothing seen. Shape (n, 2).
            focal: Length of the camera [px].
            distance: About where the keypoints are [m], which sets the size of the discs. Shape (n,).
            radius: Of each disc [m], one or each. Shape (n,).
            gap: Depths that are this far apart belong to different surfaces [m], one or each. Shape (n,).
        """
        n = len(pixels)
        gap, radius = np.broadcast_to(gap, (n,)), np.broadcast_to(radius, (n,))
        found = _nothing(n)
        seen = np.flatnonzero(np.isfinite(pixels).all(axis=1))
        if not len(seen):
            return found
        pixels, gap = pixels[seen], gap[seen]
        radii = np.clip(radius[seen] * focal / distance[seen], _MIN_RADIUS, _MAX_RADIUS)
        parts = self._split(depth, pixels, radii, gap)
        holes = np.isnan(parts.depth[:, 0])
        if holes.any():
            wide = self._split(depth, pixels[holes], np.full(int(holes.sum()), _MAX_RADIUS), gap[holes])
            for rows, wide_rows in zip(parts, wide, strict=True):
                rows[holes] = wide_rows
        for all_rows, rows in zip(found, parts, strict=True):
            all_rows[seen] = rows
        return found

    def _split(self, depth: DepthArray, pixels: FloatArray, radii: FloatArray, gap: FloatArray) -> Surfaces:
        values = self._disc(depth, pixels, radii)
        order = np.argsort(values, axis=1)
        values = np.take_along_axis(values, order, axis=1)
        n, m = values.shape
        known = np.isfinite(values)
        with np.errstate(invalid="ignore"):
            starts = values[:, 1:] - values[:, :-1] > gap[:, None]
        labels = np.zeros((n, m), dtype=np.int64)
        np.cumsum(starts, axis=1, out=labels[:, 1:])
        sizes = np.bincount((labels + m * np.arange(n)[:, None])[known], minlength=n * m).reshape(n, m)
        total = known.sum(axis=1, keepdims=True)
        # Very torn discs have no solid surface: then the largest piece is the best there is.
        solid = (sizes >= _MIN_SUPPORT * total) | (sizes == sizes.max(axis=1, keepdims=True, initial=0))
        solid &= sizes > 0
        rank = np.cumsum(solid, axis=1) * solid
        found = _nothing(n)
        rows, chosen = np.nonzero(solid & (rank <= _LAYERS))
        layer = rank[rows, chosen] - 1
        member = (labels[rows] == chosen[:, None]) & known[rows]
        found.depth[rows, layer], found.sigma[rows, layer] = self._sample(values[rows], order[rows], member)
        found.support[rows, layer] = sizes[rows, chosen] / total[rows, 0]
        return found

    def _disc(self, depth: DepthArray, pixels: FloatArray, radii: FloatArray) -> FloatArray:
        """Give the depths in discs around pixels, infinite where unknown. Shape (n, m)."""
        height, width = depth.shape
        inside = np.all((pixels >= -0.5) & (pixels < [width - 0.5, height - 0.5]), axis=1)
        centres = np.where(inside[:, None], pixels, 0.0)
        columns, rows = (
            np.rint(centres[:, i, None] + radii[:, None] * _OFFSETS[:, i]).astype(np.int64) for i in (0, 1)
        )
        seen = (columns >= 0) & (columns < width) & (rows >= 0) & (rows < height) & inside[:, None]
        values = depth.take(np.where(seen, rows * width + columns, 0)).astype(np.float64)
        seen &= (values >= self._nearest) & (values <= self._farthest)  # NaN is neither
        return np.where(seen, values, np.inf)

    def _sample(
        self, values: FloatArray, order: NDArray[np.int64], member: BoolArray
    ) -> tuple[FloatArray, FloatArray]:
        """Give depth and sigma of one surface in each disc. Shapes (k,)."""
        # The nearest half of the surface: of a slope cut by a contour the median lies to one side.
        distances = np.where(member, _DISTANCES[order], np.inf)
        near = member & (distances <= _middle(np.sort(distances, axis=1), member.sum(axis=1))[0][:, None])
        count = near.sum(axis=1)
        ascending = np.sort(np.where(near, values, np.inf), axis=1)
        low, high = _middle(ascending, count)
        depth = (low + high) / 2.0
        with np.errstate(invalid="ignore"):
            deviations = np.where(near, np.abs(values - depth[:, None]), np.inf)
        low, high = _middle(np.sort(deviations, axis=1), count)
        return depth, np.hypot(_MAD_TO_SIGMA * (low + high) / 2.0, _NOISE * depth * depth)


def _nothing(n: int) -> Surfaces:
    return Surfaces(np.full((n, _LAYERS), np.nan), np.full((n, _LAYERS), np.nan), np.zeros((n, _LAYERS)))


def _middle(ascending: FloatArray, count: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give the two values in the middle of the first `count` of each row (the same one if it is odd)."""
    rows = np.arange(len(ascending))
    return ascending[rows, (count - 1) // 2], ascending[rows, count // 2]
