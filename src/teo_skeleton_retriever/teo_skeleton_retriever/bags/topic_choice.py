# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which topics of a bag are colour, depth and camera_info: as told, by usual names, or the only ones."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from teo_skeleton_retriever.bags.bag_reader import Bag
from teo_skeleton_retriever.camera.image_messages import (
    CAMERA_INFO_TOPIC,
    COLOR_TOPIC,
    DEPTH_TOPIC,
    shows_depth,
)
from teo_skeleton_retriever.camera.raw_image import BAYER, DEBAYER
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
    """Find the topics of a bag by the encodings of their first images.

    Args:
        bag: To look into.
        color: Name of the topic; to be found if empty.
        depth: Likewise.
        camera_info: Likewise.

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
