"""A part-affinity-field network in an ONNX file, run by OpenCV.

OpenCV is there already, and is as fast as ONNX Runtime on such a network (a VGG trunk at 176 x 240 on one
core: 0.30 s against 0.27 s), which would be 70 MB more.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import cv2
import numpy as np

from teo_skeleton_retriever.detectors.detector import ImageArray
from teo_skeleton_retriever.detectors.paf.paf_model import PAF_MODELS, PafModel
from teo_skeleton_retriever.detectors.paf.paf_peaks import MapArray
from teo_skeleton_retriever.errors import DetectorError


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
        path: of the ONNX file.

    Raises:
        DetectorError: there is no such file, or OpenCV cannot read it.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        if not path.is_file():
            raise DetectorError(
                "no_model", f"{path}: expected an ONNX file of an OpenPose network; convert or fetch one"
            )
        try:
            self._network = cv2.dnn.readNetFromONNX(str(path))
            self._outputs = self._network.getUnconnectedOutLayersNames()
        except cv2.error as error:
            raise DetectorError("bad_model", f"{path}: expected a readable ONNX file: {error.err}") from error

    def run(self, image: ImageArray) -> Maps:
        """Run it on one image.

        Args:
            image: RGB, in the size that the network is to see. Shape (height, width, 3).

        Raises:
            DetectorError: the network does not take an image of this size, or gives something else.
        """
        blob = cv2.dnn.blobFromImage(image, 1.0 / 256.0, mean=(128.0, 128.0, 128.0), swapRB=True)
        try:
            self._network.setInput(blob)
            outputs = self._network.forward(self._outputs)
        except cv2.error as error:
            height, width = image.shape[:2]
            raise DetectorError(
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
        raise DetectorError(
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
