# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From a message to arrays: all that can be judged without knowing where the robot is."""

from __future__ import annotations

import difflib
from collections import Counter
from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from teo_sim_driver.bezier import FloatArray
from teo_sim_driver.errors import Refusal, TrajectoryError
from teo_sim_driver.message import SECOND, PointLike, TimeLike, TrajectoryLike
from teo_sim_driver.rules import Rules


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


def read(message: TrajectoryLike, *, joints: Sequence[str], held: Collection[str], rules: Rules) -> Points:
    """Read a message into arrays.

    Args:
        message: As received.
        joints: Names that the driver commands, in its order.
        held: Names of joints that the robot has and the driver never moves, for a better answer.
        rules: Limits on the message.

    Raises:
        TrajectoryError: the message is malformed.
    """
    names = list(message.joint_names)
    columns = _columns(names, joints, held, rules)
    points = message.points
    if not len(points):
        raise TrajectoryError(Refusal.NO_POINTS, "expected at least one point, got none")
    if len(points) > rules.max_points:
        raise TrajectoryError(
            Refusal.TOO_MANY_POINTS,
            f"expected at most {rules.max_points} points, got {len(points)}: send fewer, or in parts",
        )
    _check_lengths(points, len(names))
    stamp = _nanoseconds(message.header.stamp, "header.stamp")
    times = _times(points, rules)
    with_velocities = np.array([len(point.velocities) > 0 for point in points])
    with_accelerations = np.array([len(point.accelerations) > 0 for point in points])
    read_points = Points(
        stamp=stamp or None,
        columns=columns,
        times=times,
        positions=np.array([point.positions for point in points], dtype=np.float64),
        velocities=_table([point.velocities for point in points], with_velocities, len(names)),
        accelerations=_table([point.accelerations for point in points], with_accelerations, len(names)),
        degrees=(1 + 2 * with_velocities + 2 * with_accelerations).astype(np.int8),
    )
    _check_finite(read_points, names)
    return read_points


def quoted(name: str) -> str:
    """A name as it came, short and printable whatever it holds."""
    return repr(name if len(name) <= 40 else name[:40] + "...")


def listed(names: Sequence[str], most: int = 6) -> str:
    """Names in a row, the first few of many."""
    shown = ", ".join(quoted(name) for name in names[:most])
    return shown if len(names) <= most else f"{shown} and {len(names) - most} more"


def _columns(
    names: list[str], joints: Sequence[str], held: Collection[str], rules: Rules
) -> NDArray[np.intp]:
    if not names:
        raise TrajectoryError(Refusal.NO_JOINTS, f"expected the names of {len(joints)} joints, got none")
    index = {name: i for i, name in enumerate(joints)}
    unknown = [name for name in names if name not in index]
    if unknown and unknown[0] in held:
        raise TrajectoryError(
            Refusal.HELD_JOINT,
            f"{quoted(unknown[0])} is held still by this driver: leave it out of the trajectory",
        )
    if unknown:
        near = difflib.get_close_matches(unknown[0][:40], joints, n=1)
        hint = f"did you mean {near[0]!r}?" if near else f"expected some of {', '.join(joints)}"
        raise TrajectoryError(Refusal.UNKNOWN_JOINT, f"no joint is called {listed(unknown)}: {hint}")
    given = set(names)
    if len(given) < len(names):
        twice = [name for name, count in Counter(names).items() if count > 1]
        raise TrajectoryError(
            Refusal.DUPLICATE_JOINT, f"expected each joint once, got more of {listed(twice)}"
        )
    missing = [name for name in joints if name not in given]
    if missing and not rules.allow_partial_joints_goal:
        raise TrajectoryError(
            Refusal.MISSING_JOINTS,
            f"expected all {len(joints)} joints, missing: {listed(missing)}; "
            "give them all, or set the parameter allow_partial_joints_goal",
        )
    return np.array([index[name] for name in names], dtype=np.intp)


def _check_lengths(points: Sequence[PointLike], count: int) -> None:
    for i, point in enumerate(points):
        if len(point.positions) != count:
            _refuse_length(i, "positions", len(point.positions), count)
        velocities, accelerations = len(point.velocities), len(point.accelerations)
        if velocities not in (0, count):
            _refuse_length(i, "velocities", velocities, count)
        if accelerations not in (0, count):
            _refuse_length(i, "accelerations", accelerations, count)
        if accelerations and not velocities:
            raise TrajectoryError(
                Refusal.ACCELERATIONS_WITHOUT_VELOCITIES,
                f"point {i} has accelerations and no velocities: give both (quintic) or velocities (cubic)",
            )
        if len(point.effort):
            raise TrajectoryError(
                Refusal.EFFORT_GIVEN,
                f"point {i} has {len(point.effort)} efforts: this driver commands positions, leave them out",
            )


def _refuse_length(point: int, field: str, got: int, expected: int) -> None:
    optional = "" if field == "positions" else ", or none"
    raise TrajectoryError(
        Refusal.WRONG_LENGTH,
        f"point {point}: expected {expected} {field}, one for each joint name{optional}; got {got}",
    )


def _nanoseconds(time: TimeLike, field: str) -> int:
    if not 0 <= time.nanosec < SECOND:
        raise TrajectoryError(
            Refusal.BAD_TIME, f"{field}: expected nanosec in 0..999999999, got {time.nanosec}"
        )
    return time.sec * SECOND + time.nanosec


def _times(points: Sequence[PointLike], rules: Rules) -> NDArray[np.int64]:
    times = np.array(
        [_nanoseconds(point.time_from_start, f"point {i} time_from_start") for i, point in enumerate(points)],
        dtype=np.int64,
    )
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
    return times


def _table(rows: list[Sequence[float]], given: NDArray[np.bool_], columns: int) -> FloatArray:
    """Rows of numbers, zeros where a row is not given."""
    table = np.zeros((len(rows), columns))
    if given.any():
        table[given] = [row for row in rows if len(row)]
    return table


def _check_finite(points: Points, names: list[str]) -> None:
    for field in ("positions", "velocities", "accelerations"):
        values = getattr(points, field)
        bad = np.argwhere(~np.isfinite(values))
        if len(bad):
            i, column = bad[0]
            raise TrajectoryError(
                Refusal.NOT_FINITE,
                f"point {i} {field}: expected a finite number for {names[column]}, got {values[i, column]}",
            )
