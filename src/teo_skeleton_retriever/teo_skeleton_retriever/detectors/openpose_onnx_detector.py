# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""OpenPose's method with a network that the user brings: part affinity fields, several people.

OpenCV runs the network: it is there already, and is as fast as ONNX Runtime on such a network (a VGG trunk at
176 x 240 on one core: 0.30 s against 0.27 s), which would be 70 MB more.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import cv2
import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.detectors.detector import ImageArray, check_image
from teo_skeleton_retriever.detectors.part_affinity import (
    CAREFUL,
    GENEROUS,
    PAF_MODELS,
    MapArray,
    PafModel,
    assemble,
    find_limbs,
    find_peaks,
)
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.layouts.person_2d import Person2D, as_body_25


class Maps(NamedTuple):
    """What the network gives for an image."""

    model: PafModel
    parts: MapArray
    """confidence, without the background's. Shape (parts, rows, columns)"""
    fields: MapArray
    """Shape (channels, rows, columns)"""


class PoseNetwork:
    """Runs the network.

    It takes blue, green, red as value / 256 - 0.5, shape (1, 3, height, width), as OpenPose's do. It gives
    either one output, maps and then fields, or several, of which the last with as many channels as the maps
    of a model and the last with as many as its fields count.

    Args:
        path: Of the ONNX file.

    Raises:
        RetrieverError: There is no such file, or OpenCV cannot read it.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        if not path.is_file():
            raise RetrieverError(
                "no_model", f"{path}: expected an ONNX file of an OpenPose network; convert or fetch one"
            )
        try:
            self._network = cv2.dnn.readNetFromONNX(str(path))
            self._outputs = self._network.getUnconnectedOutLayersNames()
        except cv2.error as error:
            raise RetrieverError(
                "bad_model", f"{path}: expected a readable ONNX file: {error.err}"
            ) from error

    def run(self, image: ImageArray) -> Maps:
        """Run it on one image.

        Args:
            image: RGB, in the size that the network is to see. Shape (height, width, 3).

        Raises:
            RetrieverError: The network does not take an image of this size, or gives something else.
        """
        blob = cv2.dnn.blobFromImage(image, 1.0 / 256.0, mean=(128.0, 128.0, 128.0), swapRB=True)
        try:
            self._network.setInput(blob)
            outputs = self._network.forward(self._outputs)
        except cv2.error as error:
            height, width = image.shape[:2]
            raise RetrieverError(
                "wrong_model",
                f"{self._path}: expected a network that takes (1, 3, {height}, {width}); if it takes one "
                f"size only, give that as net_resolution: {error.err}",
            ) from error
        return self._maps([np.asarray(output, dtype=np.float32) for output in outputs], image.shape[:2])

    def _maps(self, outputs: list[MapArray], size: tuple[int, ...]) -> Maps:
        by_channels = {output.shape[1]: output[0] for output in outputs if _shows(output, size)}
        for model in PAF_MODELS:
            maps, fields = model.map_channels, model.field_channels
            if maps + fields in by_channels:
                both = by_channels[maps + fields]
                return Maps(model, both[: maps - 1], both[maps:])
            if maps in by_channels and fields in by_channels:
                return Maps(model, by_channels[maps][:-1], by_channels[fields])
        expected = " or ".join(
            f"{model.map_channels} maps and {model.field_channels} field channels ({model.layout.name})"
            for model in PAF_MODELS
        )
        raise RetrieverError(
            "wrong_model",
            f"{self._path}: expected {expected}, in one output or two, in the shape of {size}, got shapes "
            f"{', '.join(str(output.shape) for output in outputs)}",
        )


def _shows(output: MapArray, size: tuple[int, ...]) -> bool:
    """Whether this may be maps of one image of this height and width."""
    if output.ndim != 4 or len(output) != 1:
        return False
    rows, columns = output.shape[2:]
    return bool(rows > 0 and rows * size[1] == columns * size[0])


# OpenPose's networks take sizes that are multiples of this.
_MULTIPLE = 16
# To 1: beyond, a free side would ask for more memory than there may be.
_WIDEST = 8
# A side of the net resolution that follows from the other and from the image's shape.
_FREE = -1


class OpenPoseOnnxDetector:
    """Finds bodies with a BODY_25 or COCO network of OpenPose's kind; no hands, no faces.

    Method: Cao et al., "OpenPose: Realtime Multi-Person 2D Pose Estimation using Part Affinity Fields"
    (TPAMI 2021). Not for two threads at once.

    Args:
        model: The ONNX file; OpenPose's own weights may not be used commercially.
        net_resolution: Width, height [px] that the image is fitted into for the network, multiples of 16; -1
            for a side that is to follow from the image's shape. OpenPose's default.
        maximize_positives: Rather see somebody who is not there than miss somebody; as in OpenPose.

    Raises:
        RetrieverError: No or no fitting network, or a resolution that is none.
    """

    name = "openpose_onnx"
    images_at_once = 1

    def __init__(
        self,
        *,
        model: str | Path,
        net_resolution: Sequence[int] = (_FREE, 368),
        maximize_positives: bool = False,
    ) -> None:
        self._resolution = _checked_resolution(net_resolution)
        self._thresholds = GENEROUS if maximize_positives else CAREFUL
        self._network: PoseNetwork | None = PoseNetwork(Path(model))
        if _FREE not in self._resolution:  # what it gives shows only when it runs: tell now
            self._network.run(np.zeros((self._resolution[1], self._resolution[0], 3), np.uint8))

    def detect(self, image: ImageArray, stamp: float) -> tuple[Person2D, ...]:
        """Find the people; see `Detector.detect`."""
        if self._network is None:
            raise RetrieverError("closed", "expected an open detector, got one that was closed")
        check_image(image, stamp)
        height, width = image.shape[:2]
        net_width, net_height = self._net_size(width, height)
        factor = min(net_width / width, net_height / height)
        fitted = max(round(width * factor), 1), max(round(height * factor), 1)
        # Fitted into the upper left corner; black fills the rest.
        padded = np.zeros((net_height, net_width, 3), np.uint8)
        method = cv2.INTER_AREA if factor < 1.0 else cv2.INTER_CUBIC
        padded[: fitted[1], : fitted[0]] = cv2.resize(image, fitted, interpolation=method)
        bodies = self._bodies(self._network.run(padded), (net_width, net_height))
        scale = np.array([width, height]) / np.array(fitted)
        return tuple(Person2D(body=as_body_25(_in_image(body, scale))) for body in bodies)

    def close(self) -> None:
        """Let go of the network."""
        self._network = None

    def _net_size(self, width: int, height: int) -> tuple[int, int]:
        if max(width, height) > _WIDEST * min(width, height):
            raise RetrieverError(
                "bad_image",
                f"expected sides no more than {_WIDEST} to 1, got an image of {width} x {height} px",
            )
        net_width, net_height = self._resolution
        if net_width == _FREE:
            net_width = _multiple(net_height * width / height)
        elif net_height == _FREE:
            net_height = _multiple(net_width * height / width)
        return net_width, net_height

    def _bodies(self, maps: Maps, size: tuple[int, int]) -> tuple[FloatArray, ...]:
        peaks = find_peaks(maps.parts, size, self._thresholds.peak)
        limbs = find_limbs(peaks, maps.fields, size, maps.model, self._thresholds)
        return assemble(peaks, limbs, maps.model, self._thresholds)


def _checked_resolution(resolution: Sequence[int]) -> tuple[int, int]:
    sides = tuple(resolution)
    fine = len(sides) == 2 and all(
        side == _FREE or (isinstance(side, int) and side > 0 and side % _MULTIPLE == 0) for side in sides
    )
    if not fine or sides == (_FREE, _FREE):
        raise RetrieverError(
            "bad_resolution",
            f"net_resolution: expected width, height, multiples of {_MULTIPLE}, one of them possibly "
            f"{_FREE}, got {resolution!r}",
        )
    return sides[0], sides[1]


def _multiple(side: float) -> int:
    return max(round(side / _MULTIPLE), 1) * _MULTIPLE


def _in_image(body: FloatArray, scale: FloatArray) -> FloatArray:
    # A pixel's centre is half a pixel from its edge in both sizes.
    placed = np.column_stack([(body[:, :2] + 0.5) * scale - 0.5, body[:, 2]])
    return np.where(body[:, 2:] > 0.0, placed, 0.0)
