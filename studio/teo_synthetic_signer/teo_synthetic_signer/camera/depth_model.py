# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From the depth that is there to the depth that a sensor gives: noise, steps, shadows, edges and holes."""

from __future__ import annotations

import math

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtri

from teo_skeleton_retriever.arrays import BoolArray, DepthArray, FloatArray
from teo_skeleton_retriever.camera.camera_model import CameraModel
from teo_synthetic_signer.camera.sensors import Principle, Sensor

# A step between neighbours that is an edge, of their depth: steeper surfaces are grazing ones.
_EDGE = 0.03
# Share of pixels beside an edge that give nothing: windows that hold two depths match badly. Assumption.
_EDGE_DROPOUT = 0.3
# By how much outlines are displaced, standard deviation [px of the sensor]. Assumption.
_RAGGED = 0.6
# Size of holes in good surfaces: of the blur that makes them [px of the sensor]. Assumption.
_PATCH = 4.0


class DepthModel:
    """One sensor's depth, aligned to its colour image."""

    def __init__(self, sensor: Sensor, camera: CameraModel, random: np.random.Generator) -> None:
        """Prepare.

        Args:
            sensor: What measures.
            camera: The colour image to which depth is aligned.
            random: Where noise comes from.
        """
        self._sensor = sensor
        self._random = random
        # Where the sensor's own pixels are coarser, several pixels of the colour image show the same one.
        pitch = max(1.0, camera.fx / sensor.depth_focal)
        self._rows, self._row_of = _grid(camera.height, pitch)
        self._columns, self._column_of = _grid(camera.width, pitch)
        self._focal = camera.fx / pitch

    def measure(self, depth: DepthArray, facing: NDArray[np.float32]) -> DepthArray:
        """Measure one image.

        Args:
            depth: That is there [m], infinite where nothing is. Shape (height, width).
            facing: Cosine between the surface's normal and the view. Shape (height, width).

        Returns:
            [m], NaN where the sensor gives nothing. Shape (height, width).
        """
        true = depth[self._rows][:, self._columns].astype(np.float64)
        cosine = facing[self._rows][:, self._columns]
        true = self._displaced(true)
        known = np.isfinite(true) & (cosine > self._sensor.grazing)
        if self._sensor.baseline > 0.0:
            known &= ~self._shadow(true)
        measured, lost = self._at_edges(true)
        known &= ~lost & ~self._holes(true.shape)
        measured = self._noisy(np.where(np.isfinite(measured), measured, self._sensor.farthest))
        measured = np.round(measured / self._sensor.step) * self._sensor.step
        known &= (measured >= self._sensor.nearest) & (measured <= self._sensor.farthest)
        given = np.where(known, measured, np.nan).astype(np.float32)
        aligned: DepthArray = given[self._row_of][:, self._column_of]
        return aligned

    def _field(self, shape: tuple[int, ...], size: float) -> FloatArray:
        """Draw noise of variance 1 that is alike over `size` pixels."""
        noise = self._random.standard_normal(shape)
        if size < 0.3:
            return noise
        blurred = cv2.GaussianBlur(noise, (0, 0), size)
        scaled: FloatArray = blurred * (2.0 * math.sqrt(math.pi) * size)  # a blur's share of white noise
        return scaled

    def _displaced(self, depth: FloatArray) -> FloatArray:
        rows, columns = np.indices(depth.shape)
        up = np.rint(_RAGGED * self._field(depth.shape, 1.0)).astype(int)
        aside = np.rint(_RAGGED * self._field(depth.shape, 1.0)).astype(int)
        near = depth[
            np.clip(rows + up, 0, depth.shape[0] - 1), np.clip(columns + aside, 0, depth.shape[1] - 1)
        ]
        at_edge, _, _ = _edges(depth)
        displaced: FloatArray = np.where(at_edge, near, depth)
        return displaced

    def _shadow(self, depth: FloatArray) -> BoolArray:
        """Find what the second eye, right of the first, cannot see: something nearer is before it there."""
        columns = np.arange(depth.shape[1], dtype=np.float64)
        finite = np.where(np.isfinite(depth), depth, 1e6)
        seen_at = columns - self._focal * self._sensor.baseline / finite
        from_right = np.minimum.accumulate(seen_at[:, ::-1], axis=1)[:, ::-1]
        hidden = np.zeros(depth.shape, dtype=bool)
        hidden[:, :-1] = seen_at[:, :-1] > from_right[:, 1:] + 0.5
        return hidden

    def _at_edges(self, depth: FloatArray) -> tuple[FloatArray, BoolArray]:
        edge, low, high = _edges(depth)
        chance = self._random.random(depth.shape)
        flying = edge & (chance < self._sensor.flying)
        mixed = low + (high - low) * self._random.random(depth.shape)
        lost = edge & (chance > 1.0 - _EDGE_DROPOUT)
        return np.where(flying, mixed, depth), lost

    def _holes(self, shape: tuple[int, ...]) -> BoolArray:
        field = self._field(shape, _PATCH)
        holes: BoolArray = field > ndtri(1.0 - self._sensor.dropout)
        return holes

    def _noisy(self, depth: FloatArray) -> FloatArray:
        sensor = self._sensor
        noise = self._field(depth.shape, sensor.correlation)
        if sensor.principle is Principle.TIME_OF_FLIGHT:
            noisy: FloatArray = depth * (1.0 + sensor.error * noise)
            return noisy
        scale = sensor.depth_focal * sensor.baseline
        disparity = scale / depth + sensor.error * noise
        if sensor.disparity_step > 0.0:
            disparity = np.round(disparity / sensor.disparity_step) * sensor.disparity_step
        return np.where(disparity > 0.0, scale / np.maximum(disparity, 1e-6), np.inf)


def _grid(size: int, pitch: float) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Give the pixel that stands for each coarse pixel, and the coarse pixel that each pixel shows."""
    own = np.minimum((np.arange(size) / pitch).astype(np.int64), math.ceil(size / pitch) - 1)
    centres = np.minimum(((np.arange(own[-1] + 1) + 0.5) * pitch).astype(np.int64), size - 1)
    return centres, own


def _edges(depth: FloatArray) -> tuple[BoolArray, FloatArray, FloatArray]:
    """Find pixels beside an edge, and the nearest and farthest depth around each."""
    finite = np.where(np.isfinite(depth), depth, 1e3).astype(np.float32)
    kernel = np.ones((3, 3), dtype=np.uint8)
    low, high = cv2.erode(finite, kernel), cv2.dilate(finite, kernel)
    return high - low > _EDGE * low, low.astype(np.float64), high.astype(np.float64)
