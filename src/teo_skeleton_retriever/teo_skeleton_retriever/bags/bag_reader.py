# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Bags of ROS 1 and ROS 2: which topics they hold, and their messages, without ROS running."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator
from pathlib import Path
from typing import Any, NamedTuple, Protocol

from mcap.writer import MCAP0_MAGIC
from rosbags.rosbag1 import Reader as Ros1Reader
from rosbags.rosbag2 import Reader as Ros2Reader
from rosbags.typesys import Stores, get_typestore

from teo_skeleton_retriever.bags.bag_salvage import CutOff, RawMessage, salvage
from teo_skeleton_retriever.errors import RetrieverError

_SUFFIXES = (".mcap", ".db3", ".bag")


class BagMessage(NamedTuple):
    """One message: its topic, the time of its reception [ns], and its fields as attributes."""

    topic: str
    time: int
    message: Any


class _Source(Protocol):
    """Where the bytes come from. `problem` is filled in while it is read."""

    kinds: dict[str, str]
    counts: dict[str, int]
    problem: str

    def messages(self, topics: Collection[str]) -> Iterator[RawMessage]: ...


class Bag:
    """A bag that was opened for reading; may be read several times.

    Standard messages are read by their standard definitions, which have not changed since ROS 2 began.
    """

    def __init__(self, path: Path) -> None:
        """Open a ROS 2 bag (its folder, or one of its .mcap or .db3 files) or a ROS 1 bag (.bag).

        What was cut off is opened as well, up to the cut; `problem` says so.

        Raises:
            RetrieverError: It does not exist, is no bag, or nothing in it can be read.
        """
        self._path = path
        self._ros1 = path.suffix == ".bag"
        self._types = get_typestore(Stores.ROS1_NOETIC if self._ros1 else Stores.ROS2_JAZZY)
        self._source = _open(path)
        self._unreadable = ""

    @property
    def kinds(self) -> dict[str, str]:
        """Type of the messages of each topic, such as "sensor_msgs/msg/Image"."""
        return dict(self._source.kinds)

    @property
    def counts(self) -> dict[str, int]:
        """Number of messages of each topic."""
        return dict(self._source.counts)

    @property
    def problem(self) -> str:
        """What is wrong with the bag, as far as it was read; empty if nothing is."""
        return "; ".join(filter(None, (self._source.problem, self._unreadable)))

    def messages(self, topics: Collection[str]) -> Iterator[BagMessage]:
        """Give the messages of topics in the order of their reception, as far as they can be read."""
        for raw in self._source.messages(topics):
            try:
                message = self._read(raw)
            except Exception as error:  # the library raises what unpacking wrong bytes happens to raise
                self._unreadable = f"{raw.topic}: {len(raw.data)} bytes that are no {raw.kind}: {error}"
                continue
            yield BagMessage(raw.topic, raw.time, message)

    def first(self, topic: str) -> Any | None:
        """Give the first message of a topic; None if it has none."""
        return next((found.message for found in self.messages([topic])), None)

    def _read(self, raw: RawMessage) -> Any:
        if self._ros1:
            return self._types.deserialize_ros1(raw.data, raw.kind)
        return self._types.deserialize_cdr(raw.data, raw.kind)


def _open(path: Path) -> _Source:
    if not path.exists():
        raise RetrieverError("missing_bag", f"expected a bag, got {path}, which does not exist")
    if path.is_file() and path.suffix not in _SUFFIXES:
        raise RetrieverError(
            "no_bag", f"expected the folder of a bag or a file {', '.join(_SUFFIXES)}, got {path.name}"
        )
    try:
        if all(_is_finished(file) for file in _files(path)):
            return _Whole(path)
        reason = "an MCAP file does not end as it should"
    except Exception as error:  # likewise
        reason = f"{type(error).__name__} {error}".strip()
    source = _Salvaged(_files(path), reason)
    if not source.counts:
        raise RetrieverError("unreadable_bag", f"{path.name}: no message can be read: {source.problem}")
    return source


def _files(path: Path) -> list[Path]:
    if path.is_file():
        return [path]
    return sorted(file for file in path.iterdir() if file.suffix in _SUFFIXES)


def _is_finished(file: Path) -> bool:
    """Tell an MCAP file that was finished from one whose recorder died; takes other files as finished."""
    if file.suffix != ".mcap":
        return True
    with file.open("rb") as stream:
        size = stream.seek(0, 2)
        stream.seek(max(size - len(MCAP0_MAGIC), 0))
        return stream.read() == MCAP0_MAGIC and size > 2 * len(MCAP0_MAGIC)


class _Whole:
    """A bag with its index."""

    def __init__(self, path: Path) -> None:
        self._reader = Ros1Reader(path) if path.suffix == ".bag" else Ros2Reader(path)
        self._reader.open()
        self.kinds = {connection.topic: connection.msgtype for connection in self._reader.connections}
        self.counts = {topic: info.msgcount for topic, info in self._reader.topics.items()}
        self.problem = ""

    def messages(self, topics: Collection[str]) -> Iterator[RawMessage]:
        connections = [one for one in self._reader.connections if one.topic in topics]
        if not connections:
            return
        count = 0
        try:
            for connection, time, data in self._reader.messages(connections=connections):
                count += 1
                yield RawMessage(connection.topic, connection.msgtype, time, bytes(data))
        except Exception as error:  # a damaged chunk: whatever its unpacking happens to raise
            self.problem = f"damaged after {count} messages: {type(error).__name__} {error}".strip()


class _Salvaged:
    """A bag that was cut off: read from the front, once to learn what is in it."""

    def __init__(self, files: list[Path], reason: str) -> None:
        self._files = files
        self._faults: dict[Path, str] = {}
        self.kinds: dict[str, str] = {}
        counts: Counter[str] = Counter()
        for message in self.messages(()):
            counts[message.topic] += 1
            self.kinds[message.topic] = message.kind
        self.counts = dict(counts)
        reasons = "; ".join(dict.fromkeys((reason, *self._faults.values())))
        self.problem = f"cut off, {sum(counts.values())} messages can be read: {reasons}"

    def messages(self, topics: Collection[str]) -> Iterator[RawMessage]:
        for file in self._files:
            try:
                for message in salvage(file):
                    if not topics or message.topic in topics:
                        yield message
            except CutOff as fault:
                self._faults[file] = str(fault)  # the next file of the bag may be whole
