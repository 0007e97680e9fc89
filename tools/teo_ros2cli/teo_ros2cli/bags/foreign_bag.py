# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Bags of ROS 1, and of ROS 2 in SQLite, read through the package `rosbags`."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

from teo_common.mcap_salvage import StoredMessage
from teo_ros2cli.bags.bag import Bag, open_bag, require_bag
from teo_ros2cli.bags.metadata import NO_START, BagMetadata, FileRecord, TopicRecord
from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.interfaces import Schema
from teo_ros2cli.qos import DURATIONS, QosRecord

# What a latched topic of ROS 1 offers in ROS 2.
_LATCHED = QosRecord(depth=1, durability="transient_local")


def _is_foreign(path: Path) -> bool:
    """Tell by the names of its files whether a bag is one of ROS 1 or in SQLite."""
    return path.suffix in (".bag", ".db3") or (path.is_dir() and any(path.glob("*.db3*")))


@dataclass(frozen=True)
class _ForeignBag(Bag):
    """A bag whose messages come as those of ROS 2 Jazzy, whatever they are stored as."""

    def schemas(self) -> dict[str, Schema]:
        """Return none: the messages come as those of the installed types."""
        return {}

    def messages(
        self,
        *,
        topics: Collection[str] | None = None,
        start: int = 0,
        on_problem: Callable[[str], object] = str,
    ) -> Iterator[StoredMessage]:
        """Yield the messages in the order of reception; the rest is as for `Bag.messages`.

        A message of ROS 1 gets the fields that its type has in ROS 2: of a header, all but the number.
        """
        from rosbags.convert.converter import generate_message_converter

        with _opened(self.path) as reader:
            store = _types(reader)
            converters: dict[str, Any] = {}
            wanted = [c for c in reader.connections if topics is None or c.topic in topics]
            if not wanted:
                return
            for connection, time, data in reader.messages(connections=wanted, start=start):
                kind = connection.msgtype
                try:
                    if kind not in converters:
                        with contextlib.redirect_stdout(sys.stderr):  # it prints which types differ
                            converters[kind] = generate_message_converter(
                                reader.typestore, store, kind, kind, {}, src_is2=reader.is2, dst_is2=True
                            )
                    message = bytes(converters[kind](data))
                except Exception as error:  # whatever rosbags meets in damaged bytes
                    on_problem(f"a message of '{connection.topic}' cannot be read: {error}")
                    continue
                yield StoredMessage(connection.topic, kind, time, time, message)


def open_any_bag(path: Path, *, verify: bool = False) -> Bag:
    """Open a bag of any kind: one of ROS 2 in MCAP as `open_bag` does, others as `_open_foreign`."""
    return _open_foreign(path) if _is_foreign(path) else open_bag(path, verify=verify)


def _open_foreign(path: Path) -> _ForeignBag:
    """Open a bag of ROS 1 (`.bag`), or of ROS 2 in SQLite (a directory or a `.db3`).

    Raises:
        Ros2CliError: `bag_missing`, `bag_unreadable`, or `rosbags_missing`: that package is not installed.
    """
    require_bag(path)
    with _opened(path) as reader:
        topics: dict[str, tuple[TopicRecord, int]] = {}
        for connection in reader.connections:
            offered = _offered(connection.ext)
            known, count = topics.get(
                connection.topic, (TopicRecord(connection.topic, connection.msgtype, offered_qos=offered), 0)
            )
            topics[connection.topic] = known, count + connection.msgcount
        count = reader.message_count
        start = reader.start_time if count else NO_START
        duration = reader.duration if count else 0
        metadata = BagMetadata(
            files=(FileRecord(path.name, start, duration, count),),
            topics=tuple(topics.values()),
            start=start,
            duration=duration,
            storage="sqlite3" if reader.is2 else "rosbag_v2",
            ros_distro="" if reader.is2 else "noetic",
        )
    files = tuple(sorted(path.glob("*.db3*"))) if path.is_dir() else (path,)
    return _ForeignBag(path, files, metadata, ())


@contextlib.contextmanager
def _opened(path: Path) -> Iterator[Any]:
    try:
        from rosbags.highlevel import AnyReader
        from rosbags.highlevel.anyreader import AnyReaderError
        from rosbags.typesys import Stores, get_typestore
    except ImportError as error:
        raise Ros2CliError(
            "rosbags_missing", f"'{path}' is read by the package rosbags: python -m pip install rosbags"
        ) from error
    try:
        with AnyReader([path], default_typestore=get_typestore(Stores.ROS2_JAZZY)) as reader:
            yield reader
    except (AnyReaderError, OSError) as error:
        raise Ros2CliError("bag_unreadable", f"'{path}' cannot be read: {error}") from error


def _types(reader: Any) -> Any:
    """Return the types that messages are passed on as: Jazzy's own, and the bag's for those it lacks."""
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS2_JAZZY)
    store.register({n: d for n, d in reader.typestore.fielddefs.items() if n not in store.fielddefs})
    return store


def _offered(ext: Any) -> tuple[QosRecord, ...]:
    if hasattr(ext, "latching"):
        return (_LATCHED,) if ext.latching else ()
    return tuple(_record(profile) for profile in ext.offered_qos_profiles)


def _record(profile: Any) -> QosRecord:
    tree: dict[str, Any] = {}
    for policy in fields(QosRecord):
        value = getattr(profile, policy.name)
        if policy.name in DURATIONS:
            value = {"sec": value.sec, "nsec": value.nsec}
        tree[policy.name] = value.name.lower() if hasattr(value, "name") else value
    return QosRecord.from_tree(tree)
