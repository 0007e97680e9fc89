# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Depth cameras: what each sees, and by which law its depth is wrong."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtri

from teo_skeleton_retriever.arrays import BoolArray, DepthArray, FloatArray
from teo_skeleton_retriever.camera.camera_model import CameraModel
from teo_synthetic_signer.errors import SyntheticError, named


class Principle(Enum):
    """How depth is measured."""

    TRIANGULATION = "triangulation"
    """from the shift of a pattern between two places: the error grows with the square of the distance"""
    TIME_OF_FLIGHT = "time of flight"
    """from the phase of light that returns: the error grows with the distance"""


@dataclass(frozen=True, kw_only=True)
class Sensor:
    """A depth camera.

    Attributes:
        label: What people call it.
        principle: How it measures.
        color_view: Field of view that its images are rendered with, horizontal and vertical [rad].
        depth_size: Columns and rows of its own depth image [px].
        depth_view: Field of view of that image, horizontal [rad].
        nearest: Least depth it gives [m].
        farthest: Greatest depth it gives [m].
        baseline: From the second eye, or the projector, to the depth camera [m]; 0 for time of flight.
        error: Standard deviation: of the disparity [px of its own depth image], or of the depth at 1 m
            for time of flight [m].
        disparity_step: Smallest difference of disparities [px]; 0 if depth is not quantised by it.
        step: Smallest difference of depths [m].
        correlation: How far noise is alike [px of its own depth image].
        flying: Share of pixels at an edge whose depth lies between both sides.
        dropout: Share of pixels of good surfaces that give nothing.
        grazing: Cosine between surface and view below which nothing comes back.
        mono: Whether its image has no colour.
        sources: Where the figures are from.
    """

    label: str
    principle: Principle
    color_view: tuple[float, float]
    depth_size: tuple[int, int]
    depth_view: float
    nearest: float
    farthest: float
    baseline: float
    error: float
    disparity_step: float
    step: float = 0.001
    correlation: float
    flying: float
    dropout: float
    grazing: float
    mono: bool = False
    sources: str

    @property
    def depth_focal(self) -> float:
        """Focal length of its own depth image [px]."""
        return self.depth_size[0] / (2.0 * math.tan(self.depth_view / 2.0))

    def sigma(self, depth: float) -> float:
        """Give the standard deviation of a depth [m], before quantisation."""
        if self.principle is Principle.TIME_OF_FLIGHT:
            return self.error * depth
        return depth**2 * self.error / (self.depth_focal * self.baseline)

    def camera(self, width: int, height: int) -> CameraModel:
        """Give the colour camera at a resolution; another aspect than the sensor's is cut out of its middle.

        Raises:
            SyntheticError: A resolution that makes no image.
        """
        if not (16 <= width <= 4096 and 16 <= height <= 4096):
            raise SyntheticError("bad_size", f"expected 16 to 4096 px each way, got {width} x {height}")
        horizontal, vertical = (math.tan(angle / 2.0) for angle in self.color_view)
        focal = max(width / (2.0 * horizontal), height / (2.0 * vertical))
        return CameraModel(
            width=width, height=height, fx=focal, fy=focal, cx=(width - 1) / 2.0, cy=(height - 1) / 2.0
        )


def _view(horizontal: float, vertical: float) -> tuple[float, float]:
    return math.radians(horizontal), math.radians(vertical)


SENSORS: dict[str, Sensor] = {
    "sr300": Sensor(
        label="RealSense SR300",
        principle=Principle.TRIANGULATION,
        color_view=_view(73.0, 59.0),
        depth_size=(640, 480),
        depth_view=math.radians(73.0),
        nearest=0.2,
        farthest=1.5,
        baseline=0.047,
        error=0.06,
        disparity_step=0.0,
        step=0.000125,
        correlation=1.0,
        flying=0.05,
        dropout=0.004,
        grazing=0.12,
        sources="size, view, range: table of the device; step 1/8 mm: its driver's unit of depth; "
        "baseline and error: assumptions that give 1 mm at 0.6 m, the table's accuracy in the "
        "middle of its range",
    ),
    "d435": Sensor(
        label="RealSense D435",
        principle=Principle.TRIANGULATION,
        color_view=_view(69.4, 42.5),
        depth_size=(848, 480),
        depth_view=math.radians(87.0),
        nearest=0.2,
        farthest=10.0,
        baseline=0.050,
        error=0.08,
        disparity_step=1.0 / 32.0,
        correlation=3.0,
        flying=0.10,
        dropout=0.006,
        grazing=0.10,
        sources="view, range: table of the device; depth 848 x 480 and 87 deg, baseline 50 mm, "
        "disparities of 1/32 px, error of 0.08 px on a textured target: Intel, D400 data "
        "sheet and 'Best-known-methods for tuning RealSense D400'; the rest: assumptions",
    ),
    "kinect1": Sensor(
        label="Kinect 1",
        principle=Principle.TRIANGULATION,
        color_view=_view(57.0, 43.0),
        depth_size=(320, 240),
        depth_view=math.radians(57.0),
        nearest=0.4,
        farthest=4.5,
        baseline=0.075,
        error=0.0315,
        disparity_step=0.063,
        correlation=1.0,
        flying=0.05,
        dropout=0.01,
        grazing=0.20,
        sources="size, view, range: table of the device; baseline 75 mm, error 1.43 mm and step 2.85 "
        "mm at 1 m: Khoshelham and Elberink, Sensors 12(2), 2012; the rest: assumptions",
    ),
    "kinect2": Sensor(
        label="Kinect 2",
        principle=Principle.TIME_OF_FLIGHT,
        color_view=_view(70.0, 60.0),
        depth_size=(512, 424),
        depth_view=math.radians(70.0),
        nearest=0.5,
        farthest=4.5,
        baseline=0.0,
        error=0.0015,
        disparity_step=0.0,
        correlation=0.7,
        flying=0.5,
        dropout=0.003,
        grazing=0.08,
        sources="size, view, range: table of the device; error of 1 to 2 mm at 1 m that grows "
        "linearly and flying pixels: assumptions after Lachat and others, Remote Sens. 7(10), "
        "2015",
    ),
    "xtion": Sensor(
        label="Asus Xtion Pro Live",
        principle=Principle.TRIANGULATION,
        color_view=_view(58.0, 47.0),
        depth_size=(640, 480),
        depth_view=math.radians(58.0),
        nearest=0.8,
        farthest=3.5,
        baseline=0.075,
        error=0.0615,
        disparity_step=0.123,
        correlation=1.0,
        flying=0.05,
        dropout=0.01,
        grazing=0.20,
        sources="size, view, range: table of the device; the same chip as the Kinect 1 and so its "
        "law, see there",
    ),
    "leap": Sensor(
        label="Leap Motion",
        principle=Principle.TRIANGULATION,
        color_view=_view(135.0, 125.0),
        depth_size=(640, 480),
        depth_view=math.radians(135.0),
        nearest=0.025,
        farthest=0.6,
        baseline=0.040,
        error=0.1,
        disparity_step=0.0,
        step=0.00001,
        correlation=2.0,
        flying=0.0,
        dropout=0.01,
        grazing=0.15,
        mono=True,
        sources="view, range, step: table of the device, which gives out no depth image: one of 640 x "
        "480 stands for it; baseline 40 mm: its housing; error: assumption",
    ),
}


def sensor(name: str) -> Sensor:
    """Give a sensor by name, in capitals or not.

    Raises:
        SyntheticError: None has that name.
    """
    return named("sensor", name.lower(), SENSORS)


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
        """Prepare to measure for the colour image of `camera`, to which depth is aligned."""
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
        return given[self._row_of][:, self._column_of]

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
        return np.where(at_edge, near, depth)

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
            return depth * (1.0 + sensor.error * noise)
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
