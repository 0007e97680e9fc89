# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A serialized trajectory_msgs/JointTrajectory as arrays, without an object for each point.

rclpy makes objects of a message while it holds Python's lock: 14 us a point, during which no joint state is
published. Here points that are alike are read as one block. The encoding is the plain CDR of DDS-XTypes 1.3,
section 7.4 (XCDR version 1), which ROS 2 uses: every value at a multiple of its size, counted after the four
bytes that name the encoding; a sequence is its length and its elements.
"""

from __future__ import annotations

import struct
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from teo_sim_driver.errors import Refusal, TrajectoryError
from teo_sim_driver.motion.bezier import FloatArray

FIELDS = ("positions", "velocities", "accelerations", "effort")

_ENCAPSULATION = 4  # [bytes]
_BYTE_ORDER = {b"\x00\x00": ">", b"\x00\x01": "<"}
_SMALLEST_POINT = 4 * len(FIELDS) + 8  # [bytes]: four empty sequences and a duration
_SMALLEST_STRING = 4  # [bytes]: its length
# Points that are looked at together, times those that were found alike.
_LEAP = 8


class _Block(NamedTuple):
    """Points that follow one another and are alike in the lengths of their fields."""

    first: int
    size: int
    """Number of points."""
    start: int
    """Of the first point [bytes after the encapsulation]."""
    stride: int
    """[bytes]"""
    lengths: tuple[int, ...]
    """Of each of `FIELDS`."""
    offsets: tuple[int, ...]
    """Of the lengths, of each of `FIELDS`, within a point [bytes]."""
    values: tuple[int, ...]
    """Of the first value of each of `FIELDS` within a point [bytes]."""
    time: int
    """Of time_from_start within a point [bytes]."""


class CdrTrajectory:
    """A message as it came over the wire: its head is read at once, its points when they are asked for."""

    def __init__(self, data: bytes) -> None:
        """Read the head.

        Raises:
            TrajectoryError: ``bad_encoding``, also from every other member.
        """
        order = _BYTE_ORDER.get(data[:2])
        if order is None:
            raise TrajectoryError(
                Refusal.BAD_ENCODING,
                f"expected plain CDR (00 00 or 00 01), got {data[:2].hex(' ') or 'nothing'}",
            )
        self._order = order
        self._data = memoryview(data)[_ENCAPSULATION:]
        self._at = 0
        seconds, nanoseconds = self._take("iI")
        self.stamp = (seconds, nanoseconds)
        self._string()  # frame_id
        names = self._count(_SMALLEST_STRING, "joint names")
        self.names = [self._string() for _ in range(names)]
        self.count = self._count(_SMALLEST_POINT, "points")

    @cached_property
    def lengths(self) -> NDArray[np.int64]:
        """Number of values of each of `FIELDS` at each point. Shape (n, 4)."""
        return np.repeat(
            np.array([block.lengths for block in self._blocks], dtype=np.int64).reshape(-1, len(FIELDS)),
            [block.size for block in self._blocks],
            axis=0,
        )

    @cached_property
    def times(self) -> NDArray[np.int64]:
        """time_from_start of each point [s], [ns]. Shape (n, 2)."""
        times = np.empty((self.count, 2), dtype=np.int64)
        for block in self._blocks:
            rows = slice(block.first, block.first + block.size)
            times[rows, 0] = self._column(block, block.time, "i4", 1)[:, 0]
            times[rows, 1] = self._column(block, block.time + 4, "u4", 1)[:, 0]
        return times

    def table(self, field: int) -> FloatArray:
        """One of `FIELDS`, 0 where a point does not give it; every point that gives it has the same number.

        Returns:
            Shape (n, joints).
        """
        table = np.zeros((self.count, len(self.names)))
        for block in self._blocks:
            if block.lengths[field]:
                table[block.first : block.first + block.size] = self._column(
                    block, block.values[field], "f8", block.lengths[field]
                )
        return table

    @cached_property
    def _blocks(self) -> list[_Block]:
        blocks: list[_Block] = []
        first = 0
        while first < self.count:
            block = self._block(first)
            blocks.append(block)
            first += block.size
            self._at = block.start + block.size * block.stride
        return blocks

    def _block(self, first: int) -> _Block:
        """The point at the present place, and all after it that are alike."""
        start = self._at
        lengths, offsets, values = [], [], []
        for _ in FIELDS:
            (length,) = self._take("I")
            offsets.append(self._at - 4 - start)
            if length:
                self._at += -self._at % 8
            values.append(self._at - start)
            self._skip(8 * length)
            lengths.append(length)
        self._take("iI")
        stride = self._at - start
        block = _Block(first, 1, start, stride, tuple(lengths), tuple(offsets), tuple(values), stride - 8)
        if stride % 8:
            return block  # the next point lies otherwise in the eight bytes of a number
        most = min(self.count - first, (len(self._data) - start) // stride)
        count = 1
        while count < most:  # by leaps, so that points that all differ cost no more than their number
            reach = min(_LEAP * count, most)
            alike = np.ones(reach, dtype=np.bool_)
            for length, offset in zip(lengths, offsets, strict=True):
                alike &= self._column(block._replace(size=reach), offset, "u4", 1)[:, 0] == length
            if not alike.all():
                return block._replace(size=int(np.argmin(alike)))
            count = reach
        return block._replace(size=count)

    def _column(self, block: _Block, offset: int, kind: str, width: int) -> NDArray[np.generic]:
        """Values at the same place of every point of a block. Shape (count, width)."""
        size = int(kind[1])
        return np.ndarray(
            (block.size, width),
            dtype=self._order + kind,
            buffer=self._data,
            offset=block.start + offset,
            strides=(block.stride, size),
        )

    def _take(self, kinds: str) -> tuple[int, ...]:
        """Numbers of four bytes."""
        self._at += -self._at % 4
        size = 4 * len(kinds)
        self._skip(size)
        return struct.unpack_from(self._order + kinds, self._data, self._at - size)

    def _skip(self, size: int) -> None:
        if self._at + size > len(self._data):
            raise TrajectoryError(
                Refusal.BAD_ENCODING,
                f"expected at least {self._at + size} bytes of message, got {len(self._data)}",
            )
        self._at += size

    def _string(self) -> str:
        (size,) = self._take("I")
        self._skip(size)
        return bytes(self._data[self._at - size : self._at]).rstrip(b"\0").decode(errors="replace")

    def _count(self, smallest: int, what: str) -> int:
        """Length of a sequence, of which the message must have room for."""
        (count,) = self._take("I")
        if count * smallest > len(self._data) - self._at:
            raise TrajectoryError(
                Refusal.BAD_ENCODING,
                f"expected room for {count} {what}, got {len(self._data) - self._at} bytes",
            )
        return count
