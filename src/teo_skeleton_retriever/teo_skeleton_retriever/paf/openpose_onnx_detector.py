# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""OpenPose's method with a network that the user brings: part affinity fields, several people."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import cv2
import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.detectors.detector import ImageArray, check_image
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.layouts.person_2d import Person2D, as_body_25
from teo_skeleton_retriever.paf.part_affinity import (
    CAREFUL,
    GENEROUS,
    assemble,
    find_limbs,
    find_peaks,
)
from teo_skeleton_retriever.paf.pose_network import Maps, PoseNetwork

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
