# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The images of a bag, each with its depth and camera, and which topics of the bag hold them."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple

from teo_skeleton_retriever.bags.bag_reader import Bag
from teo_skeleton_retriever.camera.image_decoding import BAYER, DEBAYER
from teo_skeleton_retriever.camera.rgbd_image import (
    CAMERA_INFO_TOPIC,
    COLOR_TOPIC,
    DEPTH_TOPIC,
    RgbdImage,
    image_of,
    shows_depth,
    stamp_of,
)
from teo_skeleton_retriever.camera.synchroniser import GREATEST_SLOP, NO_COLOR, NO_DEPTH, Pair, Synchroniser
from teo_skeleton_retriever.errors import RetrieverError, TopicError

_IMAGES = ("sensor_msgs/msg/Image", "sensor_msgs/msg/CompressedImage")
_TRANSPORTS = ("compressed", "compressedDepth")
_ALIGNED = ("aligned", "registered")  # in the names of drivers for depth that fits the colour image
_GREY = ("mono8", "8UC1")  # infrared images; colour only where there is no other


class Topics(NamedTuple):
    """Names of topics."""

    color: str
    depth: str
    camera_info: str


def choose_topics(bag: Bag, *, color: str = "", depth: str = "", camera_info: str = "") -> Topics:
    """Find the topics of a bag by the encodings of their first images, but for those that are named.

    Raises:
        TopicError: None or several may be meant.
        RetrieverError: One that is named is not there, or the only colour images are raw mosaics.
    """
    names = [topic for topic, kind in bag.kinds.items() if kind in _IMAGES and bag.counts.get(topic)]
    first = {topic: bag.first(topic) for topic in names}
    depths = [topic for topic in names if shows_depth(first[topic])]
    colors = [topic for topic in names if shows_depth(first[topic]) is False]
    encodings = {topic: str(getattr(first[topic], "encoding", "")) for topic in names}
    unread = [f"{topic} ({of})" for topic, of in encodings.items() if of.startswith(BAYER)]
    if unread and not colors and not color:
        sentence = f"expected a topic of color, got the raw mosaic of {', '.join(unread)}: {DEBAYER}"
        raise RetrieverError("no_color", sentence)
    coloured = [topic for topic in colors if encodings[topic] not in _GREY]
    infos = [topic for topic, kind in bag.kinds.items() if kind == "sensor_msgs/msg/CameraInfo"]
    chosen_color = _choose(bag, "color", color, COLOR_TOPIC, coloured or colors)
    beside = f"{_base(chosen_color).rpartition('/')[0]}/camera_info"
    aligned = [topic for topic in depths if any(word in topic for word in _ALIGNED)]
    return Topics(
        chosen_color,
        _choose(bag, "depth", depth, DEPTH_TOPIC, aligned or depths),
        _choose(bag, "camera_info", camera_info, CAMERA_INFO_TOPIC, [beside] if beside in infos else infos),
    )


def _choose(bag: Bag, what: str, told: str, usual: str, found: Sequence[str]) -> str:
    known = bag.kinds
    if told:
        for name in (told, f"/{told}"):
            if name in known:
                return name
        raise RetrieverError(
            "unknown_topic", f"expected one of {', '.join(sorted(known)) or 'none'}, got {told!r}"
        )
    for topic in _forms(f"/{usual}", found):
        return topic
    bases = {_base(topic) for topic in found}
    if len(bases) == 1:
        return next(iter(_forms(bases.pop(), found)))
    if not bases:
        sentence = f"expected a topic of {what}, got {', '.join(sorted(known)) or 'none'}"
        raise TopicError(f"no_{what}", sentence, f"{what}_topic")
    sentence = f"expected one topic of {what}, got {', '.join(sorted(found))}"
    raise TopicError(f"ambiguous_{what}", sentence, f"{what}_topic")


def _forms(base: str, found: Sequence[str]) -> list[str]:
    """Of what was found, a topic and its compressed forms, the best first."""
    return [name for name in (base, *(f"{base}/{form}" for form in _TRANSPORTS)) if name in found]


def _base(topic: str) -> str:
    base, _, last = topic.rpartition("/")
    return base if last in _TRANSPORTS else topic


# In a recording nothing is late: this bounds the memory where a topic has long gaps.
_CAPACITY = 30
# Part of the colour images that may be without depth: those at the ends of a recording, and a frame lost.
_FEW = 0.1
# Part of the images without depth that the proposed bound is to pair.
_MOST = 0.9


class BagImage(NamedTuple):
    """One image of a bag."""

    image: RgbdImage
    stamp: int
    """Of the colour image [ns]."""
    time: int
    """Of the bag, when the image was complete [ns]."""
    frame_id: str
    """Of the camera's optical frame."""


class BagImages:
    """Reads a bag from its beginning to its end, and counts what could not be used."""

    def __init__(self, bag: Bag, topics: Topics, *, slop: int, rectified: bool = False) -> None:
        """Read nothing yet.

        Args:
            bag: To read.
            topics: Of it.
            slop: Greatest difference between the stamps of colour and depth [ns].
            rectified: See `camera_of`.
        """
        self._bag = bag
        self._topics = topics
        self._slop = slop
        self._rectified = rectified
        self.dropped: Counter[str] = Counter()
        """Colour images that could not be used, by reason."""
        self.reasons: dict[str, str] = {}
        """A sentence for the first of each reason."""
        self._paired = 0

    def images(self, on_message: Callable[[], None] = lambda: None) -> Iterator[BagImage]:
        """Give the images in order.

        Args:
            on_message: Called after each message that is read, to show progress.

        Raises:
            RetrieverError: There is no camera_info.
        """
        synchroniser = Synchroniser(slop=self._slop, capacity=_CAPACITY)
        # Where camera_info was recorded once, or begins late, it holds for the images before it as well.
        info = self._bag.first(self._topics.camera_info)
        if info is None:
            raise RetrieverError(
                "no_camera_info", f"expected a message on {self._topics.camera_info}, got none"
            )
        time = 0
        for topic, time, message in self._bag.messages(self._topics):
            on_message()
            if topic == self._topics.camera_info:
                info = message
                continue
            add = synchroniser.add_color if topic == self._topics.color else synchroniser.add_depth
            yield from self._usable(add(stamp_of(message), message), info, time)
        yield from self._usable(synchroniser.finish(), info, time)
        self._note_misses(synchroniser)
        self.dropped += Counter({k: n for k, n in synchroniser.dropped.items() if k != NO_COLOR})

    def _usable(self, pairs: list[Pair], info: Any, time: int) -> Iterator[BagImage]:
        for pair in pairs:
            self._paired += 1
            try:
                image = image_of(pair.color, pair.depth, info, rectified=self._rectified)
            except RetrieverError as error:
                self.drop(error)
                continue
            frame_id = pair.color.header.frame_id or info.header.frame_id
            yield BagImage(image, pair.stamp, time, frame_id)

    def _note_misses(self, synchroniser: Synchroniser) -> None:
        """Explain colour images without depth, unless they are as few as at the ends of any recording."""
        missed = synchroniser.dropped[NO_DEPTH]
        if missed <= _FEW * (missed + self._paired) or not synchroniser.misses:
            return
        gaps = sorted(synchroniser.misses)
        most = math.ceil(gaps[int(_MOST * (len(gaps) - 1))] * 1e-6) * 1e-3
        advice = f"--slop {most:.3f} pairs nine of ten, and what moves meanwhile is that much out of place"
        if most > GREATEST_SLOP:
            advice = "their stamps are of different clocks, and have to be mended in the recording"
        self.reasons[NO_DEPTH] = (
            f"expected a depth image within {self._slop * 1e-9:.3g} s of each colour image, got the nearest "
            f"{gaps[0] * 1e-9:.3f} s away; {advice}"
        )

    def drop(self, error: RetrieverError) -> None:
        """Count an image that could not be used."""
        self.dropped[error.code] += 1
        self.reasons.setdefault(error.code, error.sentence)
