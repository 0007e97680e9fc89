# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A pose as people write it on a command line: ``name=value`` or a JSON file."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from teo_description.errors import DescriptionError
from teo_description.humanoid import Humanoid
from teo_description.motion_csv import check_limits


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
        check_limits(humanoid, tuple(pose), np.array([list(pose.values())]), "the pose")
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
