# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Poses and motions as people write them: ``name=value`` or JSON for a pose, CSV for a motion.

A CSV file has a header line, then time [s] first and a column of positions [rad] for each joint.
"""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from teo_description.errors import DescriptionError
from teo_description.humanoid import Humanoid

# Positions written with six decimals may end this little outside a limit that they stand on [rad].
_LIMIT_TOLERANCE = 1e-5


@dataclass(frozen=True, kw_only=True, eq=False)
class Motion:
    """Joint positions over time, linear in between.

    Attributes:
        names: Joint names.
        times: Strictly increasing [s]. Shape (n,).
        positions: [rad]. Shape (n, number of joints).
    """

    names: tuple[str, ...]
    times: NDArray[np.float64]
    positions: NDArray[np.float64]

    @property
    def duration(self) -> float:
        """From the first time to the last [s]."""
        return float(self.times[-1] - self.times[0])

    def at(self, time: float) -> dict[str, float]:
        """Positions [rad] by joint at a time [s] after the first row; outside the motion its ends hold."""
        when = self.times[0] + time
        return {
            name: float(np.interp(when, self.times, column))
            for name, column in zip(self.names, self.positions.T, strict=True)
        }


def read_motion(path: Path, humanoid: Humanoid) -> Motion:
    """Read and check a motion of a robot.

    Raises:
        DescriptionError: ``unreadable_file``, ``empty_motion``, ``bad_header``, ``unknown_joint``,
            ``bad_row``, ``not_finite``, ``times_not_increasing`` or ``outside_limits``; the message names
            file and line.
    """
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            rows = [row for row in csv.reader(file) if row]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise DescriptionError("unreadable_file", f"expected a CSV file at {path}: {error}") from error
    if len(rows) < 2:
        raise DescriptionError(
            "empty_motion", f"{path.name}: expected a header and at least one row, got {len(rows)} lines"
        )
    names = _checked_header(path, [name.strip() for name in rows[0]], humanoid)
    table = np.array(
        [_numbers(path, line, row, len(names) + 1) for line, row in enumerate(rows[1:], start=2)]
    )
    late = np.flatnonzero(np.diff(table[:, 0]) <= 0.0)
    if late.size:
        line = int(late[0]) + 3
        raise DescriptionError(
            "times_not_increasing",
            f"{path.name}, row {line}: expected a time after {table[line - 3, 0]:g} s, "
            f"got {table[line - 2, 0]:g} s",
        )
    _check_limits(humanoid, names, table[:, 1:], path.name)
    return Motion(names=names, times=table[:, 0], positions=table[:, 1:])


def _check_limits(
    humanoid: Humanoid, names: tuple[str, ...], positions: NDArray[np.float64], where: str
) -> None:
    """Refuse positions [rad], a row for each moment, that a robot cannot reach; `where` names their source.

    Raises:
        DescriptionError: ``outside_limits``.
    """
    limits = humanoid.limits(names)
    outside = (positions < limits.lower - _LIMIT_TOLERANCE) | (positions > limits.upper + _LIMIT_TOLERANCE)
    if outside.any():
        row, column = (int(index) for index in np.argwhere(outside)[0])
        lower, upper, value = limits.lower[column], limits.upper[column], positions[row, column]
        raise DescriptionError(
            "outside_limits",
            f"{where}, row {row + 2}: expected {names[column]} within {lower:.4f} .. {upper:.4f} rad "
            f"({np.degrees(lower):.1f} .. {np.degrees(upper):.1f} deg), "
            f"got {value:.4f} rad ({np.degrees(value):.1f} deg)",
        )


def _checked_header(path: Path, header: list[str], humanoid: Humanoid) -> tuple[str, ...]:
    names = tuple(header[1:])
    if header[0] in humanoid.all_joints or not names:
        raise DescriptionError(
            "bad_header",
            f"{path.name}: expected a header with time first and then joint names, got {','.join(header)!r}",
        )
    humanoid.check_joint_names(names, f"{path.name}: ")
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise DescriptionError(
            "bad_header", f"{path.name}: expected each joint once, got several columns of {', '.join(twice)}"
        )
    return names


def _numbers(path: Path, line: int, row: list[str], count: int) -> list[float]:
    if len(row) != count:
        raise DescriptionError("bad_row", f"{path.name}, row {line}: expected {count} values, got {len(row)}")
    try:
        values = [float(value) for value in row]
    except ValueError as error:
        raise DescriptionError("bad_row", f"{path.name}, row {line}: expected numbers; {error}") from error
    if not np.isfinite(values).all():
        raise DescriptionError(
            "not_finite", f"{path.name}, row {line}: expected finite numbers, got NaN or infinity"
        )
    return values


def read_pose(arguments: Iterable[str], humanoid: Humanoid) -> dict[str, float]:
    """Read joint positions [rad] from arguments, the later ones over the earlier.

    Args:
        arguments: Each the path of a JSON file that holds an object from joint name to radians, or
            ``name=value`` with the value in radians, or in degrees when it ends in ``deg``.
        humanoid: Whose joints they are.

    Raises:
        DescriptionError: ``unreadable_file``, ``bad_pose``, ``unknown_joint``, ``not_finite`` or
            ``outside_limits``.
    """
    pose: dict[str, float] = {}
    for argument in arguments:
        name, equals, value = argument.partition("=")
        # A joint's name before the sign decides, so that a path may contain one.
        if equals and (name in humanoid.all_joints or not Path(argument).exists()):
            pose[name] = _radians(name, value)
        else:
            pose.update(_from_json(Path(argument)))
    humanoid.check_joint_names(pose)
    bad = [name for name, value in pose.items() if not math.isfinite(value)]
    if bad:
        raise DescriptionError(
            "not_finite", f"expected finite positions, got NaN or infinity for {', '.join(bad)}"
        )
    if pose:
        _check_limits(humanoid, tuple(pose), np.array([list(pose.values())]), "the pose")
    return pose


def _radians(name: str, text: str) -> float:
    try:
        if text.endswith("deg"):
            return math.radians(float(text.removesuffix("deg")))
        return float(text)
    except ValueError as error:
        raise DescriptionError(
            "bad_pose", f"expected a number in radians (or 90deg) for {name}, got {text!r}"
        ) from error


def _from_json(path: Path) -> dict[str, float]:
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError) as error:
        raise DescriptionError(
            "unreadable_file",
            f"expected name=value or a JSON file of joint positions, got {str(path)!r}: {error}",
        ) from error
    numbers = isinstance(content, dict) and all(
        isinstance(value, int | float) and not isinstance(value, bool) for value in content.values()
    )
    if not numbers or not content:
        raise DescriptionError(
            "bad_pose", f"{path.name}: expected an object from joint names to numbers [rad]"
        )
    return {str(name): float(value) for name, value in content.items()}
