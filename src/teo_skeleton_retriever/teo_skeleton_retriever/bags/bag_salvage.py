# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Reading bags that were cut off: all whole messages before the cut, one record after the other.

A recorder that is killed leaves an MCAP file without its summary, a ROS 1 bag without its index, an SQLite
file with missing pages. None needs what is missing to be read from the front.
"""

from __future__ import annotations

import bz2
import sqlite3
import struct
from collections.abc import Callable, Iterator
from io import BytesIO
from pathlib import Path
from typing import Any, BinaryIO, NamedTuple

import lz4.frame

from teo_common import mcap_salvage
from teo_common.mcap_salvage import McapContent


class RawMessage(NamedTuple):
    """One message as stored: topic, type ("sensor_msgs/msg/Image"), time of reception [ns], and its bytes."""

    topic: str
    kind: str
    time: int
    data: bytes


class CutOff(Exception):  # noqa: N818  not an error: the expected end of such a file
    """The file was not read whole; says why."""


def salvage(path: Path) -> Iterator[RawMessage]:
    """Read a file from the front.

    Raises:
        CutOff: After the last message that can be read, if the file was not read whole.
    """
    scans: dict[str, Callable[[Path], Iterator[RawMessage]]] = {
        ".mcap": _scan_mcap,
        ".bag": _scan_ros1,
        ".db3": _scan_sqlite,
    }
    yield from scans[path.suffix](path)


def _scan_mcap(path: Path) -> Iterator[RawMessage]:
    content = McapContent()
    try:
        for stored in mcap_salvage.salvage(path, content):
            yield RawMessage(stored.topic, stored.type, stored.log_time, stored.data)
    except mcap_salvage.NotMcapError as error:
        raise CutOff(str(error)) from None
    faults = [] if content.complete else [content.fault]
    if content.damaged_chunks:
        faults.append(f"{content.damaged_chunks} damaged chunks are left out")
    if faults:
        raise CutOff("; ".join(faults))


# ROS 1, format 2.0. Source: http://wiki.ros.org/Bags/Format/2.0
_MAGIC = b"#ROSBAG V2.0\n"
_MESSAGE, _CHUNK, _CONNECTION = 2, 5, 7
_LENGTH = struct.Struct("<I")
_TIME = struct.Struct("<II")
_LONGEST = 1 << 31  # of a header or of data [bytes]; more is garbage


def _scan_ros1(path: Path) -> Iterator[RawMessage]:
    with path.open("rb") as stream:
        if stream.read(len(_MAGIC)) != _MAGIC:
            raise CutOff("not a ROS 1 bag of format 2.0")
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
                raise CutOff("the file ends within a record")


def _records_of_chunk(chunk: bytes, connections: dict[int, tuple[str, str]]) -> Iterator[RawMessage]:
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
            yield RawMessage(topic, kind, seconds * 1_000_000_000 + nanoseconds, data)


def _record(stream: BinaryIO) -> tuple[dict[bytes, bytes] | None, bytes, bool]:
    """Read a record: header (None at the end), data, and whether the data are all there."""
    packed, whole = _sized(stream)
    if packed is None:
        return None, b"", True
    if not whole:
        raise CutOff("the file ends within a record's header")
    data, whole = _sized(stream)
    return _fields(packed), data or b"", whole and data is not None


def _sized(stream: BinaryIO) -> tuple[bytes | None, bool]:
    length = stream.read(_LENGTH.size)
    if not length:
        return None, True
    if len(length) < _LENGTH.size:
        raise CutOff("the file ends within a record's length")
    expected = _LENGTH.unpack(length)[0]
    if expected > _LONGEST:
        raise CutOff(f"a record claims {expected} bytes")
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
        raise CutOff(f"a chunk cannot be unpacked: {type(error).__name__} {error}") from None


def _scan_sqlite(path: Path) -> Iterator[RawMessage]:
    try:
        database = sqlite3.connect(f"file:{path}?immutable=1", uri=True)
        # Lets the file be shorter than its first page says; nothing is written, it is opened as immutable.
        database.execute("PRAGMA writable_schema=ON")
        topics = {i: (name, kind) for i, name, kind in database.execute("SELECT id, name, type FROM topics")}
        # In the order of the table, which is that of writing: the index may be among what is missing.
        for i, stamp, data in database.execute("SELECT topic_id, timestamp, data FROM messages"):
            yield RawMessage(*topics.get(i, ("", "")), stamp, data)
    except sqlite3.DatabaseError as error:
        raise CutOff(str(error)) from None
