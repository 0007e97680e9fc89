# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Bags of ROS 1 and ROS 2: which topics they hold, and their messages, without ROS running.

Bags that were cut off are read as well, from the front up to the cut: a recorder that is killed leaves an
MCAP file without its summary, a ROS 1 bag without its index, an SQLite file with missing pages. What is
missing is not needed to read the messages before it.
"""

from __future__ import annotations

import bz2
import sqlite3
import struct
from collections import Counter
from collections.abc import Callable, Collection, Iterator
from functools import cache
from io import BytesIO
from pathlib import Path
from typing import Any, BinaryIO, NamedTuple

import lz4.frame
from ament_index_python.packages import get_package_share_directory
from mcap.writer import MCAP0_MAGIC
from rosbags.rosbag1 import Reader as Ros1Reader
from rosbags.rosbag2 import Reader as Ros2Reader
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore

from teo_common import mcap_salvage
from teo_common.mcap_salvage import McapContent
from teo_skeleton_retriever.errors import RetrieverError

_SKELETONS = (
    "teo_sign_msgs/msg/Keypoint3D",
    "teo_sign_msgs/msg/Skeleton3D",
    "teo_sign_msgs/msg/SkeletonArray",
)


@cache
def message_types() -> Typestore:
    """Give the types of messages of ROS 2 and that of the skeletons, for bags."""
    folder = Path(get_package_share_directory("teo_sign_msgs")) / "msg"
    store = get_typestore(Stores.ROS2_JAZZY)
    for name in _SKELETONS:
        text = (folder / f"{name.rpartition('/')[2]}.msg").read_text(encoding="utf-8")
        store.register(get_types_from_msg(text, name))
    return store


class _RawMessage(NamedTuple):
    """One message as stored: topic, type ("sensor_msgs/msg/Image"), time of reception [ns], and its bytes."""

    topic: str
    kind: str
    time: int
    data: bytes


class _CutOff(Exception):  # noqa: N818  not an error: the expected end of such a file
    """The file was not read whole; says why."""


def _scan_mcap(path: Path) -> Iterator[_RawMessage]:
    content = McapContent()
    try:
        for stored in mcap_salvage.salvage(path, content):
            yield _RawMessage(stored.topic, stored.type, stored.log_time, stored.data)
    except mcap_salvage.NotMcapError as error:
        raise _CutOff(str(error)) from None
    faults = [] if content.complete else [content.fault]
    if content.damaged_chunks:
        faults.append(f"{content.damaged_chunks} damaged chunks are left out")
    if faults:
        raise _CutOff("; ".join(faults))


# ROS 1, format 2.0. Source: http://wiki.ros.org/Bags/Format/2.0
_MAGIC = b"#ROSBAG V2.0\n"
_MESSAGE, _CHUNK, _CONNECTION = 2, 5, 7
_LENGTH = struct.Struct("<I")
_TIME = struct.Struct("<II")
_LONGEST = 1 << 31  # of a header or of data [bytes]; more is garbage


def _scan_ros1(path: Path) -> Iterator[_RawMessage]:
    with path.open("rb") as stream:
        if stream.read(len(_MAGIC)) != _MAGIC:
            raise _CutOff("not a ROS 1 bag of format 2.0")
        connections: dict[int, tuple[str, str]] = {}
        while True:
            header, data, whole = _record(stream)
            if header is None:
                return
            if _operation(header) == _CHUNK:
                yield from _records_of_chunk(_unpacked(header, data, whole), connections)
            elif _operation(header) == _CONNECTION and whole:
                _connect(header, data, connections)
            if not whole:
                raise _CutOff("the file ends within a record")


def _records_of_chunk(chunk: bytes, connections: dict[int, tuple[str, str]]) -> Iterator[_RawMessage]:
    stream = BytesIO(chunk)
    while True:
        header, data, whole = _record(stream)
        if header is None or not whole:
            return
        if _operation(header) == _CONNECTION:
            _connect(header, data, connections)
        elif _operation(header) == _MESSAGE:
            topic, kind = connections.get(_LENGTH.unpack(header[b"conn"])[0], ("", ""))
            seconds, nanoseconds = _TIME.unpack(header[b"time"])
            yield _RawMessage(topic, kind, seconds * 1_000_000_000 + nanoseconds, data)


def _record(stream: BinaryIO) -> tuple[dict[bytes, bytes] | None, bytes, bool]:
    """Read a record: header (None at the end), data, and whether the data are all there."""
    packed, whole = _sized(stream)
    if packed is None:
        return None, b"", True
    if not whole:
        raise _CutOff("the file ends within a record's header")
    data, whole = _sized(stream)
    return _fields(packed), data or b"", whole and data is not None


def _sized(stream: BinaryIO) -> tuple[bytes | None, bool]:
    length = stream.read(_LENGTH.size)
    if not length:
        return None, True
    if len(length) < _LENGTH.size:
        raise _CutOff("the file ends within a record's length")
    expected = _LENGTH.unpack(length)[0]
    if expected > _LONGEST:
        raise _CutOff(f"a record claims {expected} bytes")
    data = stream.read(expected)
    return data, len(data) == expected


def _fields(packed: bytes) -> dict[bytes, bytes]:
    fields, place = {}, 0
    while place + _LENGTH.size <= len(packed):
        (length,) = _LENGTH.unpack_from(packed, place)
        place += _LENGTH.size
        name, _, value = packed[place : place + length].partition(b"=")
        fields[name] = value
        place += length
    return fields


def _operation(header: dict[bytes, bytes]) -> int:
    return header.get(b"op", b"\0")[0]


def _connect(header: dict[bytes, bytes], data: bytes, connections: dict[int, tuple[str, str]]) -> None:
    package, _, name = _fields(data).get(b"type", b"").decode().partition("/")
    connections[_LENGTH.unpack(header[b"conn"])[0]] = (header[b"topic"].decode(), f"{package}/msg/{name}")


def _unpacked(header: dict[bytes, bytes], data: bytes, whole: bool) -> bytes:
    """Unpack a chunk; of one that was cut off only what was not packed can be used."""
    compression = header.get(b"compression", b"none")
    if compression == b"none":
        return data
    if not whole:
        return b""
    unpack: dict[bytes, Callable[[bytes], Any]] = {b"bz2": bz2.decompress, b"lz4": lz4.frame.decompress}
    try:
        return bytes(unpack[compression](data))
    except (KeyError, OSError, ValueError, RuntimeError) as error:
        raise _CutOff(f"a chunk cannot be unpacked: {type(error).__name__} {error}") from None


def _scan_sqlite(path: Path) -> Iterator[_RawMessage]:
    try:
        database = sqlite3.connect(f"file:{path}?immutable=1", uri=True)
        # Lets the file be shorter than its first page says; nothing is written, it is opened as immutable.
        database.execute("PRAGMA writable_schema=ON")
        topics = {i: (name, kind) for i, name, kind in database.execute("SELECT id, name, type FROM topics")}
        # In the order of the table, which is that of writing: the index may be among what is missing.
        for i, stamp, data in database.execute("SELECT topic_id, timestamp, data FROM messages"):
            yield _RawMessage(*topics.get(i, ("", "")), stamp, data)
    except sqlite3.DatabaseError as error:
        raise _CutOff(str(error)) from None


# What reads a file from the front, by its suffix: it raises `_CutOff` after the last message that can be
# read, if the file was not read whole.
_SCANS: dict[str, Callable[[Path], Iterator[_RawMessage]]] = {
    ".mcap": _scan_mcap,
    ".db3": _scan_sqlite,
    ".bag": _scan_ros1,
}


class BagMessage(NamedTuple):
    """One message: its topic, the time of its reception [ns], and its fields as attributes."""

    topic: str
    time: int
    message: Any


class Bag:
    """A bag that was opened for reading; may be read several times.

    Standard messages are read by their standard definitions, which have not changed since ROS 2 began, and
    skeletons by the installed ones.
    """

    def __init__(self, path: Path) -> None:
        """Open a ROS 2 bag (its folder, or one of its .mcap or .db3 files) or a ROS 1 bag (.bag).

        What was cut off is opened as well, up to the cut; `problem` says so.

        Raises:
            RetrieverError: It does not exist, is no bag, or nothing in it can be read.
        """
        self._ros1 = path.suffix == ".bag"
        self._types = get_typestore(Stores.ROS1_NOETIC) if self._ros1 else message_types()
        self._source = _open(path)
        self._unreadable = ""
        self.kinds = self._source.kinds
        """Type of the messages of each topic, such as "sensor_msgs/msg/Image"."""
        self.counts = self._source.counts
        """Number of messages of each topic."""
        self.begins = self._source.begins
        """When its first message was received [ns]."""

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

    def _read(self, raw: _RawMessage) -> Any:
        if self._ros1:
            return self._types.deserialize_ros1(raw.data, raw.kind)
        return self._types.deserialize_cdr(raw.data, raw.kind)


def _open(path: Path) -> _Whole | _Salvaged:
    if not path.exists():
        raise RetrieverError("missing_bag", f"expected a bag, got {path}, which does not exist")
    if path.is_file() and path.suffix not in _SCANS:
        raise RetrieverError(
            "no_bag", f"expected the folder of a bag or a file {', '.join(_SCANS)}, got {path.name}"
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
    return sorted(file for file in path.iterdir() if file.suffix in _SCANS)


def _is_finished(file: Path) -> bool:
    """Tell an MCAP file that was finished from one whose recorder died; takes other files as finished."""
    if file.suffix != ".mcap":
        return True
    with file.open("rb") as stream:
        size = stream.seek(0, 2)
        stream.seek(max(size - len(MCAP0_MAGIC), 0))
        return stream.read() == MCAP0_MAGIC and size > 2 * len(MCAP0_MAGIC)


class _Whole:
    """A bag with its index. `problem` is filled in while it is read."""

    def __init__(self, path: Path) -> None:
        self._reader = Ros1Reader(path) if path.suffix == ".bag" else Ros2Reader(path)
        self._reader.open()
        self.kinds = {connection.topic: connection.msgtype for connection in self._reader.connections}
        self.counts = {topic: info.msgcount for topic, info in self._reader.topics.items()}
        self.begins = self._reader.start_time
        self.problem = ""

    def messages(self, topics: Collection[str]) -> Iterator[_RawMessage]:
        connections = [one for one in self._reader.connections if one.topic in topics]
        if not connections:
            return
        count = 0
        try:
            for connection, time, data in self._reader.messages(connections=connections):
                count += 1
                yield _RawMessage(connection.topic, connection.msgtype, time, bytes(data))
        except Exception as error:  # a damaged chunk: whatever its unpacking happens to raise
            self.problem = f"damaged after {count} messages: {type(error).__name__} {error}".strip()


class _Salvaged:
    """A bag that was cut off: read from the front, once to learn what is in it."""

    def __init__(self, files: list[Path], reason: str) -> None:
        self._files = files
        self._faults: dict[Path, str] = {}
        self.kinds: dict[str, str] = {}
        self.begins = 0
        counts: Counter[str] = Counter()
        for message in self.messages(()):
            self.begins = min(self.begins or message.time, message.time)
            counts[message.topic] += 1
            self.kinds[message.topic] = message.kind
        self.counts = dict(counts)
        reasons = "; ".join(dict.fromkeys((reason, *self._faults.values())))
        self.problem = f"cut off, {sum(counts.values())} messages can be read: {reasons}"

    def messages(self, topics: Collection[str]) -> Iterator[_RawMessage]:
        for file in self._files:
            try:
                for message in _SCANS[file.suffix](file):
                    if not topics or message.topic in topics:
                        yield message
            except _CutOff as fault:
                self._faults[file] = str(fault)  # the next file of the bag may be whole
