# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Poses as binary frames: the time [s] as a float64, then a float32 for each joint [rad], little-endian.

Thirty a second go to every page: as JSON they would be ten times as long.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence


def encode_pose(stamp: float, positions: Sequence[float]) -> bytes:
    """Write a pose.

    Args:
        stamp: When it was measured, by the node's clock [s].
        positions: Of the joints in the order of the last `Welcome` [rad].
    """
    return struct.pack(f"<d{len(positions)}f", stamp, *positions)


def decode_pose(frame: bytes) -> tuple[float, tuple[float, ...]]:
    """Read a pose: its time [s], and the positions [rad]."""
    stamp, *positions = struct.unpack(f"<d{(len(frame) - 8) // 4}f", frame)
    return stamp, tuple(positions)
