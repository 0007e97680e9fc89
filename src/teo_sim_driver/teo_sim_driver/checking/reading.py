# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From a serialized trajectory_msgs/JointTrajectory to checked arrays, without an object for each point.

What is judged here needs neither the robot's limits nor where it is.

rclpy makes objects of a message while it holds Python's lock: 14 us a point, during which no joint state is
published. Here points that are alike are read as one block. The encoding is the plain CDR of DDS-XTypes 1.3,
section 7.4 (XCDR version 1), which ROS 2 uses: every value at a multiple of its size, counted after the four
bytes that name the encoding; a sequence is its length and its elements.
"""

from __future__ import annotations

import difflib
import struct
from collections import Counter
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from teo_sim_driver.motion.bezier import FloatArray
from teo_sim_driver.motion.path_time import SECOND
from teo_sim_driver.rules import Refusal, Rules, TrajectoryError

FIELDS = ("positions", "velocities", "accelerations", "effort")

_ENCAPSULATION = 4  # [bytes]
_BYTE_ORDER = {b"\x00\x00": ">", b"\x00\x01": "<"}
_SMALLEST_POINT = 4 * len(FIELDS) + 8  # [bytes]: four empty sequences and a duration
_SMALLEST_STRING = 4  # [bytes]: its length
# Points that are looked at together, times those that were found alike.
_LEAP = 8


class _Block(NamedTuple):
    """Points that follow one another and are alike in the lengths of their fields."""

    rows: slice
    """Which of the message's points."""
    lengths: tuple[int, ...]
    """Of each of `FIELDS`."""
    points: NDArray[np.void]
    """With `sec` and `nanosec` of time_from_start, and those of `FIELDS` that are given. Shape (n,)."""


@lru_cache(maxsize=64)  # making one takes longer than reading a point: a message has few
def _point_type(layout: tuple[tuple[str, str, int], ...]) -> np.dtype[np.void]:
    """Of a point's members: name, format, and place in the point [bytes]."""
    names, formats, offsets = zip(*layout, strict=True)
    return np.dtype({"names": names, "formats": formats, "offsets": offsets})


# A header's name is shown up to this length [bytes]: many times as long as any that is in use.
_LONGEST_FRAME_ID = 256


def frame_id(data: bytes) -> str:
    """The frame_id of a message's header, without looking at the rest; empty if it cannot be read."""
    order = _BYTE_ORDER.get(data[:2])
    begin = _ENCAPSULATION + 12  # after the stamp and the length
    if order is None or len(data) < begin:
        return ""
    (size,) = struct.unpack_from(order + "I", data, begin - 4)
    return data[begin : begin + min(size, _LONGEST_FRAME_ID)].rstrip(b"\0").decode(errors="replace")


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
            [len(block.points) for block in self._blocks],
            axis=0,
        )

    @cached_property
    def times(self) -> NDArray[np.int64]:
        """time_from_start of each point [s], [ns]. Shape (n, 2)."""
        times = np.empty((self.count, 2), dtype=np.int64)
        for block in self._blocks:
            times[block.rows, 0] = block.points["sec"]
            times[block.rows, 1] = block.points["nanosec"]
        return times

    def table(self, field: int) -> FloatArray:
        """One of `FIELDS`, 0 where a point does not give it; every point that gives it has the same number.

        Returns:
            Shape (n, joints).
        """
        table = np.zeros((self.count, len(self.names)))
        for block in self._blocks:
            if block.lengths[field]:
                table[block.rows] = block.points[FIELDS[field]]
        return table

    @cached_property
    def _blocks(self) -> list[_Block]:
        blocks: list[_Block] = []
        read = 0
        while read < self.count:
            blocks.append(self._block(read))
            read = blocks[-1].rows.stop
        return blocks

    def _block(self, first: int) -> _Block:
        """The point at the present place, and all after it that are alike."""
        start = self._at
        lengths, layout = [], []
        for field in FIELDS:
            (length,) = self._take("I")
            lengths.append(length)
            layout.append((f"length of {field}", self._order + "u4", self._at - 4 - start))
            if length:
                self._at += -self._at % 8
                layout.append((field, f"({length},){self._order}f8", self._at - start))
            self._skip(8 * length)
        self._take("iI")
        stride = self._at - start
        layout += [("sec", self._order + "i4", stride - 8), ("nanosec", self._order + "u4", stride - 4)]
        point, size = _point_type(tuple(layout)), 1
        # Where a point's size is no multiple of eight, the next one's numbers lie at other places in it.
        most = 1 if stride % 8 else min(self.count - first, (len(self._data) - start) // stride)
        while size < most:  # by leaps, so that points that all differ cost no more than their number
            reach = min(_LEAP * size, most)
            points = np.frombuffer(self._data, point, reach, start)
            alike = np.all(
                [points[f"length of {field}"] == n for field, n in zip(FIELDS, lengths, strict=True)], axis=0
            )
            size = reach if alike.all() else int(np.argmin(alike))
            if size < reach:
                break
        points = np.frombuffer(self._data, point, size, start)
        self._at = start + points.nbytes
        return _Block(slice(first, first + size), tuple(lengths), points)

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


@dataclass(frozen=True, eq=False)
class Points:
    """A well-formed message as arrays.

    Attributes:
        stamp: Scheduled start [ns on the message's clock], None for now.
        columns: Which of the driver's joints each column is about. Shape (joints,).
        times: From the start [ns], strictly increasing, the first >= 0. Shape (n,), n >= 1.
        positions: [rad]. Shape (n, joints).
        velocities: [rad/s], 0 where not given. Shape (n, joints).
        accelerations: [rad/s^2], 0 where not given. Shape (n, joints).
        degrees: Of the polynomial that each point's fields allow: 1, 3 or 5. Shape (n,).
    """

    stamp: int | None
    columns: NDArray[np.intp]
    times: NDArray[np.int64]
    positions: FloatArray
    velocities: FloatArray
    accelerations: FloatArray
    degrees: NDArray[np.int8]


def read(
    message: CdrTrajectory,
    *,
    joints: Sequence[str],
    held: Collection[str],
    rules: Rules,
    group: Collection[str] = (),
) -> Points:
    """Read a message into checked arrays.

    Args:
        message: As it came.
        joints: Names that the driver commands, in its order.
        held: Names of joints that the robot has and the driver never moves, for a better answer.
        rules: Limits on the message.
        group: Names of the joints that the message is to be about; all of `joints` if empty.

    Raises:
        TrajectoryError: the message is malformed.
    """
    names = message.names
    columns = _columns(names, joints, held, rules, group or joints)
    if not message.count:
        raise TrajectoryError(Refusal.NO_POINTS, "expected at least one point, got none")
    check_count(message.count, rules)
    _check_lengths(message.lengths, len(names))
    stamp = _stamp(message.stamp)
    times = _times(message.times, rules)
    positions, velocities, accelerations = (message.table(field) for field in range(3))
    given = message.lengths > 0
    read_points = Points(
        stamp=stamp or None,
        columns=columns,
        times=times,
        positions=positions,
        velocities=velocities,
        accelerations=accelerations,
        degrees=(1 + 2 * given[:, 1] + 2 * given[:, 2]).astype(np.int8),
    )
    _check_finite(read_points, names)
    return read_points


def check_count(count: int, rules: Rules) -> None:
    """Refuse a message of too many points.

    Raises:
        TrajectoryError: ``too_many_points``.
    """
    if count > rules.max_points:
        raise TrajectoryError(
            Refusal.TOO_MANY_POINTS,
            f"expected at most {rules.max_points} points, got {count}: send fewer, or in parts",
        )


def quoted(name: str) -> str:
    """A name as it came, short and printable whatever it holds."""
    return repr(name if len(name) <= 40 else name[:40] + "...")


def _listed(names: Sequence[str], most: int = 6) -> str:
    """Names in a row, the first few of many."""
    shown = ", ".join(quoted(name) for name in names[:most])
    return shown if len(names) <= most else f"{shown} and {len(names) - most} more"


def _columns(
    names: list[str], joints: Sequence[str], held: Collection[str], rules: Rules, group: Collection[str]
) -> NDArray[np.intp]:
    if not names:
        raise TrajectoryError(Refusal.NO_JOINTS, f"expected the names of {len(group)} joints, got none")
    index = {name: i for i, name in enumerate(joints)}
    unknown = [name for name in names if name not in index]
    if unknown and unknown[0] in held:
        raise TrajectoryError(
            Refusal.HELD_JOINT,
            f"{quoted(unknown[0])} is held still by this driver: leave it out of the trajectory",
        )
    if unknown:
        near = difflib.get_close_matches(unknown[0][:40], joints, n=1)
        if len(unknown) > 1:  # more than a slip: a motion of another robot
            hint = (
                f"expected some of {', '.join(joints)}; a motion of another robot is driven with the "
                "parameter robot that it was made for, or signed anew by an executor of this one"
            )
        else:
            hint = f"did you mean {near[0]!r}?" if near else f"expected some of {', '.join(joints)}"
        raise TrajectoryError(Refusal.UNKNOWN_JOINT, f"no joint is called {_listed(unknown)}: {hint}")
    if others := [name for name in names if name not in group]:
        raise TrajectoryError(
            Refusal.OTHER_GROUP,
            f"expected some of {', '.join(group)}, got {_listed(others)}: send it to their group",
        )
    given = set(names)
    if len(given) < len(names):
        twice = [name for name, count in Counter(names).items() if count > 1]
        raise TrajectoryError(
            Refusal.DUPLICATE_JOINT, f"expected each joint once, got more of {_listed(twice)}"
        )
    missing = [name for name in group if name not in given]
    if missing and not rules.allow_partial_joints_goal:
        raise TrajectoryError(
            Refusal.MISSING_JOINTS,
            f"expected all {len(group)} joints, missing: {_listed(missing)}; "
            "give them all, or set the parameter allow_partial_joints_goal",
        )
    return np.array([index[name] for name in names], dtype=np.intp)


def _check_lengths(lengths: NDArray[np.int64], count: int) -> None:
    """Refuse the first point that has another number of values than there are joints."""
    wrong = lengths != count
    wrong[:, 1:3] &= lengths[:, 1:3] != 0
    wrong[:, 3] = lengths[:, 3] != 0
    lone = (lengths[:, 2] != 0) & (lengths[:, 1] == 0)
    bad = wrong.any(axis=1) | lone
    if not bad.any():
        return
    i = int(np.argmax(bad))
    for field in range(3):
        if wrong[i, field]:
            optional = ", or none" if field else ""
            raise TrajectoryError(
                Refusal.WRONG_LENGTH,
                f"point {i}: expected {count} {FIELDS[field]}, one for each joint name{optional}; "
                f"got {lengths[i, field]}",
            )
    if lone[i]:
        raise TrajectoryError(
            Refusal.ACCELERATIONS_WITHOUT_VELOCITIES,
            f"point {i} has accelerations and no velocities: give both (quintic) or velocities (cubic)",
        )
    raise TrajectoryError(
        Refusal.EFFORT_GIVEN,
        f"point {i} has {lengths[i, 3]} efforts: this driver commands positions, leave them out",
    )


def _stamp(stamp: tuple[int, int]) -> int:
    """Scheduled start [ns]; 0 for now."""
    seconds, nanoseconds = stamp
    if not 0 <= nanoseconds < SECOND:
        raise TrajectoryError(
            Refusal.BAD_TIME, f"header.stamp: expected nanosec in 0..999999999, got {nanoseconds}"
        )
    return seconds * SECOND + nanoseconds


def _times(parts: NDArray[np.int64], rules: Rules) -> NDArray[np.int64]:
    bad = (parts[:, 1] < 0) | (parts[:, 1] >= SECOND)
    if bad.any():
        i = int(np.argmax(bad))
        raise TrajectoryError(
            Refusal.BAD_TIME,
            f"point {i} time_from_start: expected nanosec in 0..999999999, got {parts[i, 1]}",
        )
    times = parts[:, 0] * SECOND + parts[:, 1]
    if times[0] < 0:
        raise TrajectoryError(
            Refusal.NEGATIVE_TIME, f"point 0: expected time_from_start >= 0 s, got {times[0] / SECOND:.9g} s"
        )
    back = np.nonzero(np.diff(times) <= 0)[0]
    if len(back):
        i = int(back[0]) + 1
        raise TrajectoryError(
            Refusal.TIMES_NOT_INCREASING,
            f"expected time_from_start to grow from point to point, got {times[i - 1] / SECOND:.9g} s at "
            f"point {i - 1} and {times[i] / SECOND:.9g} s at point {i}",
        )
    if times[-1] > rules.max_duration * SECOND:
        raise TrajectoryError(
            Refusal.TOO_LONG,
            f"expected a duration of at most {rules.max_duration:g} s, got {times[-1] / SECOND:.9g} s: "
            "send it in parts, or raise the parameter max_duration",
        )
    return np.asarray(times)


def _check_finite(points: Points, names: list[str]) -> None:
    for field in ("positions", "velocities", "accelerations"):
        values = getattr(points, field)
        bad = ~np.isfinite(values)
        if bad.any():
            i, column = divmod(int(np.argmax(bad)), values.shape[1])
            raise TrajectoryError(
                Refusal.NOT_FINITE,
                f"point {i} {field}: expected a finite number for {names[column]}, got {values[i, column]}",
            )
