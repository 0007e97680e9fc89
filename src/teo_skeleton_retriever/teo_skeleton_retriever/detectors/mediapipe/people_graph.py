# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Everybody in an image at a glance: MediaPipe's detector of people, whose first Holistic takes alone."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from mediapipe.framework.formats.rect_pb2 import NormalizedRect
from mediapipe.python import CalculatorGraph, ImageFormat, packet_creator, packet_getter

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.detectors.detector import ImageArray
from teo_skeleton_retriever.detectors.mediapipe.holistic_configuration import (
    PEOPLE_STREAMS,
    people_configuration,
    silenced,
)
from teo_skeleton_retriever.errors import RetrieverError

_NOSE = 0  # among the pose's landmarks
# [sides of the region] from the middle of the face within which the nose of the same person is: the region
# holds the whole body, and this is a head's breadth.
_SAME_FACE = 0.1
VIEWS = ("whole", "left", "right")


class Sighting(NamedTuple):
    """Somebody whom the detector of people saw."""

    region: NormalizedRect
    """where the network of the pose is to look for them"""
    face: FloatArray
    """middle of the face's box, in [0, 1] of width and height. Shape (2,)"""

    def is_of(self, pose: FloatArray, *, width: int, height: int) -> bool:
        """Tell whether this is the person of a pose.

        Args:
            pose: Its first columns are x, y in [0, 1] of width and height. Shape (33, k).
            width: Of the image [px].
            height: Likewise.
        """
        off = (pose[_NOSE, :2] - self.face) * [width, height]
        return float(np.hypot(*off)) < _SAME_FACE * float(self.region.height) * height


class PeopleGraph:
    """Finds people in single images. Not to be used by two threads at once.

    Args:
        min_detection_confidence: Below which a person does not count.
    """

    def __init__(self, *, min_detection_confidence: float) -> None:
        self._found: dict[str, Any] = {}
        self._time_us = 0
        configuration, side_packets = people_configuration(min_detection_confidence)
        self._graph = CalculatorGraph(graph_config=configuration)
        found = self._found
        for stream in PEOPLE_STREAMS:
            self._graph.observe_output_stream(stream, lambda name, packet: found.update({name: packet}))
        with silenced():
            self._graph.start_run(side_packets)
            self._graph.wait_until_idle()

    def find(self, image: ImageArray, view: str = "whole") -> list[Sighting]:
        """Find everybody in an image, the largest first.

        The network sees 224 x 224 pixels: in the left or the right square of a wide image, people are larger.

        Args:
            image: RGB. Shape (height, width, 3).
            view: Of `VIEWS`, where to look.

        Raises:
            RetrieverError: The graph failed and cannot be used any more.
        """
        height, width = image.shape[:2]
        start, end = {"whole": (0, width), "left": (0, height), "right": (width - height, width)}[view]
        start, end = max(start, 0), min(end, width)
        frame = packet_creator.create_image_frame(
            np.ascontiguousarray(image[:, start:end]), image_format=ImageFormat.SRGB
        )
        self._found.clear()
        self._time_us += 1
        try:
            self._graph.add_packet_to_input_stream("image", frame.at(self._time_us))
            self._graph.wait_until_idle()
        except (RuntimeError, ValueError) as error:
            raise RetrieverError("failed", f"MediaPipe refused an image: {error}") from error
        detections, regions = (
            packet_getter.get_proto_list(self._found[stream]) if stream in self._found else []
            for stream in PEOPLE_STREAMS
        )
        seen = [
            _sighting(detection, region, start / width, (end - start) / width)
            for detection, region in zip(detections, regions, strict=True)
        ]
        return sorted(seen, key=lambda one: -one.region.height)

    def close(self) -> None:
        """Stop the graph and its threads."""
        self._graph.close()


def _sighting(detection: Any, region: NormalizedRect, start: float, share: float) -> Sighting:
    """Bring what was seen in a part of the image's width to the whole."""
    box = detection.location_data.relative_bounding_box
    face = np.array([start + share * (box.xmin + box.width / 2.0), box.ymin + box.height / 2.0])
    region.x_center, region.width = start + share * region.x_center, share * region.width
    return Sighting(region, face)
