# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""MediaPipe's Holistic graph, driven directly.

`mediapipe.solutions.holistic.Holistic` drives the same graph but leaves lying what is needed here: the hands'
world landmarks, how sure it is of a hand and of the face, whether a body landmark is in the image at all, and
the chance to work on the next image while the hands of this one are still being looked at. All of these are
streams of the graph; naming them is enough to get them.
"""

from __future__ import annotations

import threading
from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from mediapipe.framework.formats.rect_pb2 import NormalizedRect
from mediapipe.python import CalculatorGraph, ImageFormat, Packet, packet_creator, packet_getter

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.detectors.detector import ImageArray
from teo_skeleton_retriever.detectors.mediapipe.holistic_configuration import (
    PERSON,
    PERSON_IS_TOLD,
    holistic_configuration,
    silenced,
)
from teo_skeleton_retriever.errors import RetrieverError

_LEFT = "handlandmarksleftandrightcpu__handlandmarksfromposecpu_1__handlandmarkcpu__"
_RIGHT = "handlandmarksleftandrightcpu__handlandmarksfromposecpu_2__handlandmarkcpu__"
_LANDMARKS = {
    "pose": "pose_landmarks",
    "left_hand": "left_hand_landmarks",
    "right_hand": "right_hand_landmarks",
    "face": "face_landmarks",
    "left_hand_world": f"{_LEFT}hand_world_landmarks",
    "right_hand_world": f"{_RIGHT}hand_world_landmarks",
}
_SCORES = {
    "left_hand": f"{_LEFT}hand_presence_score",
    "right_hand": f"{_RIGHT}hand_presence_score",
    "face": "facelandmarksfromposecpu__facelandmarkcpu__face_presence_score",
}
_SIDES = {"left_hand": f"{_LEFT}handedness", "right_hand": f"{_RIGHT}handedness"}
_STREAMS = (*_LANDMARKS.values(), *_SCORES.values(), *_SIDES.values())
# What the network calls hands: it takes images for those of a mirror.
_MIRRORED = {"left_hand": "Right", "right_hand": "Left"}
# Between two images on the graph's clock. It only orders them: nothing in the graph depends on time without
# the filter.
_FRAME_US = 33_333
# Sent where nobody is told of, for the graph waits for each stream; its fields must be filled.
_NOBODY = NormalizedRect(x_center=0.5, y_center=0.5, width=1.0, height=1.0)
# How often a wait looks whether the graph has failed.
_PATIENCE_S = 0.05


@dataclass(frozen=True, eq=False)
class HolisticLandmarks:
    """What the graph found in one image; None where it found nothing.

    Attributes:
        pose: x, y in [0, 1] of width and height, z, visibility, presence. Shape (33, 5).
        left_hand: x, y likewise, z. Shape (21, 3).
        right_hand: Likewise.
        face: Likewise. Shape (478, 3).
        left_hand_world: x, y, z [m] along the camera's axes. Shape (21, 3).
        right_hand_world: Likewise.
        left_hand_score: How sure it is that this is a hand, in [0, 1].
        right_hand_score: Likewise.
        face_score: Likewise.
        left_hand_side: How sure it is that this is a left hand, in [0, 1].
        right_hand_side: That it is a right one.
    """

    pose: FloatArray | None
    left_hand: FloatArray | None
    right_hand: FloatArray | None
    face: FloatArray | None
    left_hand_world: FloatArray | None
    right_hand_world: FloatArray | None
    left_hand_score: float
    right_hand_score: float
    face_score: float
    left_hand_side: float
    right_hand_side: float


@dataclass(eq=False)
class Pending:
    """What is known so far of an image that the graph works on."""

    packets: dict[str, Packet | None] = field(default_factory=dict)
    done: threading.Event = field(default_factory=threading.Event)

    def complete(self) -> bool:
        """Tell whether every stream has said what it has."""
        return len(self.packets) == len(_STREAMS)


class _Results:
    """Gathers what the graph gives, image by image.

    Apart from `HolisticGraph`, as the graph keeps whom it calls: were that its own owner, neither would ever
    be freed, nor the 65 MB of networks.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._pending: dict[int, Pending] = {}

    def expect(self, time_us: int) -> Pending:
        """Await an image; to be called before the graph gets it."""
        with self._lock:
            return self._pending.setdefault(time_us, Pending())

    def on_packet(self, stream: str, packet: Packet) -> None:
        """Take what one stream says; called from the graph's threads."""
        # A stream with nothing to say for several images may say so once, for the last of them.
        settled_us = packet.timestamp.value
        with self._lock:
            for time_us in [time_us for time_us in self._pending if time_us <= settled_us]:
                pending = self._pending[time_us]
                given = time_us == settled_us and not packet.is_empty()
                pending.packets.setdefault(stream, packet if given else None)
                if pending.complete():
                    del self._pending[time_us]
                    pending.done.set()


class HolisticGraph:
    """The running graph; follows one person from image to image.

    Calls from several threads are worked on together: the pose of one image while the hands of the one before
    are still being looked at. Images are taken in the order of the calls. For the options see
    `holistic_configuration`.
    """

    def __init__(self, *, min_tracking_confidence: float, lite_hands: bool) -> None:
        self._input_lock = threading.Lock()
        self._results = _Results()
        self._closed = False
        self._time_us = 0
        configuration, side_packets = holistic_configuration(
            _STREAMS, min_tracking_confidence=min_tracking_confidence, lite_hands=lite_hands
        )
        self._graph = CalculatorGraph(graph_config=configuration)
        for stream in _STREAMS:
            # With bounds, a stream also says that it has nothing for an image.
            self._graph.observe_output_stream(stream, self._results.on_packet, True)
        with silenced():  # each model announces itself as it is loaded
            self._graph.start_run(side_packets)
            self._graph.wait_until_idle()

    def begin(self, image: ImageArray, person: NormalizedRect | None = None) -> Pending:
        """Start to look at one image.

        Args:
            image: RGB. Shape (height, width, 3).
            person: Where somebody is who is to be followed from now on; None goes on with whom the image
                before showed.

        Returns:
            What `finish` wants.

        Raises:
            RetrieverError: The graph failed and cannot be used any more.
        """
        frame = packet_creator.create_image_frame(np.ascontiguousarray(image), image_format=ImageFormat.SRGB)
        with self._input_lock:
            if self._closed:
                raise RetrieverError("closed", "the detector was closed before it came to this image")
            self._time_us += _FRAME_US
            pending = self._results.expect(self._time_us)
            try:
                told = packet_creator.create_bool(person is not None).at(self._time_us)
                place = packet_creator.create_proto(person or _NOBODY).at(self._time_us)
                self._graph.add_packet_to_input_stream(PERSON_IS_TOLD, told)
                self._graph.add_packet_to_input_stream(PERSON, place)
                self._graph.add_packet_to_input_stream("image", frame.at(self._time_us))
            except (RuntimeError, ValueError) as error:
                raise RetrieverError("failed", f"MediaPipe refused an image: {error}") from error
        return pending

    def finish(self, pending: Pending) -> HolisticLandmarks:
        """Wait for what is found in an image.

        Raises:
            RetrieverError: The graph failed and cannot be used any more.
        """
        while not pending.done.wait(_PATIENCE_S):
            if self._graph.has_error():
                raise RetrieverError("failed", "MediaPipe's graph stopped with an error")
        return _landmarks(pending.packets)

    def close(self) -> None:
        """Finish the images at hand, then stop the graph and its threads."""
        with self._input_lock:  # the graph does not survive being closed while it is being fed
            self._closed = True
            with suppress(RuntimeError):  # a graph that has failed says so once more
                self._graph.wait_until_idle()
                self._graph.close()


def _landmarks(packets: Mapping[str, Packet | None]) -> HolisticLandmarks:
    def table(part: str) -> FloatArray | None:
        packet = packets[_LANDMARKS[part]]
        return None if packet is None else _table(packet_getter.get_proto(packet).landmark, part)

    def score(part: str) -> float:
        packet = packets[_SCORES[part]]
        return 0.0 if packet is None else float(packet_getter.get_float(packet))

    def side(part: str) -> float:
        packet = packets[_SIDES[part]]
        if packet is None:
            return 0.0
        best = packet_getter.get_proto(packet).classification[0]
        return float(best.score if best.label == _MIRRORED[part] else 1.0 - best.score)

    found: dict[str, Any] = {part: table(part) for part in _LANDMARKS}
    found |= {f"{part}_score": score(part) for part in _SCORES}
    found |= {f"{part}_side": side(part) for part in _SIDES}
    return HolisticLandmarks(**found)


def _table(landmarks: Iterable[Any], part: str) -> FloatArray:
    if part == "pose":
        return np.array([(mark.x, mark.y, mark.z, mark.visibility, mark.presence) for mark in landmarks])
    return np.array([(mark.x, mark.y, mark.z) for mark in landmarks])
