# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a bag holds, as text for people."""

from __future__ import annotations

import time
from collections.abc import Sequence

from teo_ros2cli.bags.metadata import BagMetadata

_LABEL_WIDTH = 19
_SECOND = 1_000_000_000


def summary(metadata: BagMetadata, size: int) -> str:
    """Return the text that `ros2 bag info` prints.

    Args:
        metadata: What the bag holds.
        size: Size of its files [bytes].
    """
    start = metadata.start if metadata.messages else 0
    topics = [
        f"Topic: {topic.name} | Type: {topic.type} | Count: {count} | Serialization Format: "
        f"{topic.serialization_format}"
        for topic, count in metadata.topics
    ]
    entries: list[tuple[str, Sequence[str]]] = [
        ("Files:", [record.path for record in metadata.files]),
        ("Bag size:", [size_text(size)]),
        ("Storage id:", [metadata.storage]),
        ("ROS Distro:", [metadata.ros_distro or "unknown"]),
        ("Duration:", [f"{seconds_text(metadata.duration)}s"]),
        ("Start:", [moment_text(start)]),
        ("End:", [moment_text(start + metadata.duration)]),
        ("Messages:", [str(metadata.messages)]),
        ("Topic information:", topics),
    ]
    lines = [""]
    for label, values in entries:
        for i, value in enumerate(values or [""]):
            lines.append((label if i == 0 else "").ljust(_LABEL_WIDTH) + value)
    lines += ["Service:           0", "Service information: "]
    return "\n".join(lines)


def seconds_text(nanoseconds: int) -> str:
    """Return a time with nine decimals [s]."""
    return f"{nanoseconds // _SECOND}.{nanoseconds % _SECOND:09d}"


def moment_text(nanoseconds: int) -> str:
    """Return a moment [ns since the epoch] in local time, and in seconds since the epoch."""
    local = time.localtime(nanoseconds // _SECOND)
    date = time.strftime("%b %e %Y %H:%M:%S", local)
    return f"{date}.{nanoseconds % _SECOND:09d} ({seconds_text(nanoseconds)})"


def size_text(size: int) -> str:
    """Return a size [bytes] in the largest unit that leaves at least 1."""
    value = float(size)
    units = ("B", "KiB", "MiB", "GiB", "TiB")
    unit = 0
    while value >= 1024 and unit < len(units) - 1:
        value /= 1024
        unit += 1
    return f"{value:.{0 if unit == 0 else 1}f} {units[unit]}"
