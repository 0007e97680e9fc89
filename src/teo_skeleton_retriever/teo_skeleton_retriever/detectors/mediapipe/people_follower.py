# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Several people, each followed by a graph of their own; a look at the whole image finds who is new."""

from __future__ import annotations

import threading
from collections.abc import Callable
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
from teo_skeleton_retriever.detectors.mediapipe.holistic_graph import HolisticGraph, HolisticLandmarks
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
        """Tell whether this is the person of a pose, x, y in [0, 1] of width and height [px] and more."""
        off = (pose[_NOSE, :2] - self.face) * [width, height]
        return float(np.hypot(*off)) < _SAME_FACE * float(self.region.height) * height


class PeopleGraph:
    """Finds people in single images. Not to be used by two threads at once."""

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


# [images] between glances, each at another part: all of the image in half a second at 30 Hz, in which nobody
# walks in and signs.
LOOK_EVERY = 5
# Nose, shoulders and hips among the pose's landmarks.
_TRUNK = [0, 11, 12, 23, 24]
# Mean distance of these of two poses, in lengths of the trunk, below which they are of one person. Who stands
# right behind another is hidden.
_SAME = 0.3


class PeopleFollower:
    """Follows up to some people from image to image. May be used by several threads, each with an image."""

    def __init__(
        self,
        make_graph: Callable[[], HolisticGraph],
        finder: PeopleGraph,
        most: int,
        *,
        counts_more: bool = False,
    ) -> None:
        """Know nobody yet.

        Args:
            make_graph: Makes what follows one person; called as people come.
            finder: Tells who is there.
            most: People who are followed at once.
            counts_more: Whether to go on looking for more people than these, for `left_out`.
        """
        self._make_graph = make_graph
        self._finder = finder
        self._most = most
        self._counts_more = counts_more
        self._more: dict[str, tuple[int, int]] = {}  # by view, in its last two glances
        self._order = threading.Lock()
        self._looking = threading.Lock()
        self._followed: dict[HolisticGraph, FloatArray] = {}  # the pose that each last saw
        self._spare = [make_graph()]  # at once, as it takes a while
        self._images = 0
        self._closed = False

    @property
    def left_out(self) -> int:
        """People who are seen and not followed; those of two glances, as one may be mistaken."""
        with self._looking:
            return max((min(counts) for counts in self._more.values()), default=0)

    def follow(self, image: ImageArray) -> list[HolisticLandmarks]:
        """Look at one image; give everybody who is found in it.

        Args:
            image: RGB. Shape (height, width, 3).

        Raises:
            RetrieverError: A graph failed; none can be used any more.
        """
        with self._order:
            if self._closed:
                raise RetrieverError("closed", "the detector was closed before it came to this image")
            glance, rest = divmod(self._images, LOOK_EVERY)
            views: tuple[str, ...] = (VIEWS[glance % len(VIEWS)],) if rest == 0 else ()
            self._images += 1
            begun = [(graph, graph.begin(image)) for graph in self._followed]
        seen: dict[HolisticGraph, HolisticLandmarks] = {}
        for graph, one in begun:
            landmarks = graph.finish(one)
            if landmarks.pose is not None and not _is_double(landmarks.pose, seen, image):
                self._keep(graph, landmarks, seen)
            else:
                self._drop(graph)
        if len(seen) < len(begun) or not seen:  # somebody was lost, or nobody was there
            views = VIEWS
        for view in views:
            if len(seen) < self._most or self._counts_more:
                with self._looking:
                    more = self._look(image, view, seen)
                    self._more[view] = (self._more.get(view, (0, 0))[1], more)
        return list(seen.values())

    def close(self) -> None:
        """Finish the images at hand, then stop all graphs."""
        with self._order:
            self._closed = True
            graphs = [*self._followed, *self._spare]
        for graph in graphs:
            graph.close()
        with self._looking:
            self._finder.close()

    def _look(self, image: ImageArray, view: str, seen: dict[HolisticGraph, HolisticLandmarks]) -> int:
        """Add to those who are seen whom the finder sees besides; give how many there is no place for."""
        height, width = image.shape[:2]
        more = 0
        for sighting in self._finder.find(image, view):
            poses = [landmarks.pose for landmarks in seen.values() if landmarks.pose is not None]
            if any(sighting.is_of(pose, width=width, height=height) for pose in poses):
                continue
            if len(seen) >= self._most:
                more += 1
                continue
            graph = self._graph_for(sighting, seen, width, height)
            landmarks = graph.finish(graph.begin(image, sighting.region))
            if landmarks.pose is not None and not _is_double(landmarks.pose, seen, image):
                self._keep(graph, landmarks, seen)
            else:
                self._drop(graph)
        return more

    def _graph_for(
        self, sighting: Sighting, seen: dict[HolisticGraph, HolisticLandmarks], width: int, height: int
    ) -> HolisticGraph:
        """Choose who is to follow: the graph that did in an image worked on meanwhile, or a spare one."""
        with self._order:
            if self._closed:
                raise RetrieverError("closed", "the detector was closed before it came to this image")
            for graph, pose in self._followed.items():
                if graph not in seen and sighting.is_of(pose, width=width, height=height):
                    return graph
            graph = self._spare.pop() if self._spare else self._make_graph()
            # Known to `close` from here on, and fed with the images after this one.
            self._followed[graph] = np.full((1, 2), np.nan)
            return graph

    def _keep(
        self,
        graph: HolisticGraph,
        landmarks: HolisticLandmarks,
        seen: dict[HolisticGraph, HolisticLandmarks],
    ) -> None:
        assert landmarks.pose is not None
        seen[graph] = landmarks
        with self._order:
            self._followed[graph] = landmarks.pose
            if graph in self._spare:  # another image had lost the person meanwhile
                self._spare.remove(graph)

    def _drop(self, graph: HolisticGraph) -> None:
        with self._order:
            if self._followed.pop(graph, None) is not None:
                self._spare.append(graph)


def _is_double(pose: FloatArray, seen: dict[HolisticGraph, HolisticLandmarks], image: ImageArray) -> bool:
    """Tell whether a pose is that of somebody who is seen already."""
    size = np.array(image.shape[1::-1])
    trunk = pose[_TRUNK, :2] * size
    length = float(np.linalg.norm(trunk[1:3].mean(axis=0) - trunk[3:].mean(axis=0)))
    others = (other.pose[_TRUNK, :2] * size for other in seen.values() if other.pose is not None)
    return any(float(np.linalg.norm(trunk - other, axis=1).mean()) < _SAME * length for other in others)
