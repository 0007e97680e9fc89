# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A part-affinity-field network in an ONNX file, run by OpenCV, and what its channels mean.

OpenCV is there already, and is as fast as ONNX Runtime on such a network (a VGG trunk at 176 x 240 on one
core: 0.30 s against 0.27 s), which would be 70 MB more. The channels are those of `poseParameters.cpp` of
OpenPose 1.7.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from teo_skeleton_retriever.detectors.detector import ImageArray
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.layouts.layout import BODY_25, COCO_18, Layout

IntArray = NDArray[np.intp]
MapArray = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class PafModel:
    """A network's output: a confidence map for each part and one of the background, then limb fields.

    Attributes:
        layout: The parts, in the order of their maps.
        limbs: The two parts that each limb's field leads from and to. Shape (limbs, 2).
        fields: For each limb the channels of its field's x and y, counted among the fields. Shape (limbs, 2).
    """

    layout: Layout
    limbs: IntArray
    fields: IntArray

    @property
    def map_channels(self) -> int:
        """Number of confidence maps, that of the background included."""
        return len(self.layout) + 1

    @property
    def field_channels(self) -> int:
        """Number of channels of all fields."""
        return 2 * len(self.limbs)


def _pairs(text: str) -> IntArray:
    array = np.array(text.replace("-", " ").split(), dtype=np.intp).reshape(-1, 2)
    array.flags.writeable = False
    return array


BODY_25_MODEL = PafModel(
    BODY_25,
    _pairs(
        "1-8 1-2 1-5 2-3 3-4 5-6 6-7 8-9 9-10 10-11 8-12 12-13 13-14 1-0 0-15 15-17 0-16 16-18 2-17 5-18 "
        "14-19 19-20 14-21 11-22 22-23 11-24"
    ),
    _pairs(
        "0-1 14-15 22-23 16-17 18-19 24-25 26-27 6-7 2-3 4-5 8-9 10-11 12-13 30-31 32-33 36-37 34-35 38-39 "
        "20-21 28-29 40-41 42-43 44-45 46-47 48-49 50-51"
    ),
)
COCO_18_MODEL = PafModel(
    COCO_18,
    _pairs("1-2 1-5 2-3 3-4 5-6 6-7 1-8 8-9 9-10 1-11 11-12 12-13 1-0 0-14 14-16 0-15 15-17 2-16 5-17"),
    _pairs(
        "12-13 20-21 14-15 16-17 22-23 24-25 0-1 2-3 4-5 6-7 8-9 10-11 28-29 30-31 34-35 32-33 36-37 "
        "18-19 26-27"
    ),
)
PAF_MODELS = (BODY_25_MODEL, COCO_18_MODEL)


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
