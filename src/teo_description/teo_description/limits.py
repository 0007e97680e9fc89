# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Joint limits, read from the URDF."""

from __future__ import annotations

import hashlib
import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from teo_common.package_files import package_path
from teo_description.errors import DescriptionError
from teo_description.hand_drives import DEFAULT_HAND_DRIVE
from teo_description.joints import COMMANDED_JOINTS, check_joint_names
from teo_description.urdf.urdf_writer import urdf


@dataclass(frozen=True, kw_only=True, eq=False)
class JointLimits:
    """Limits of some joints, in the order of `names`; the arrays are read-only.

    Attributes:
        names: Joint names.
        lower, upper: Position limits [rad]. Shape (n,).
        velocity: Greatest speed [rad/s]. Shape (n,).
    """

    names: tuple[str, ...]
    lower: NDArray[np.float64]
    upper: NDArray[np.float64]
    velocity: NDArray[np.float64]


def urdf_path() -> Path:
    """Path of ``teo.urdf``: in the source tree, or in the share folder of the prefix that holds this package.

    Raises:
        DescriptionError: ``urdf_missing``.
    """
    try:
        return package_path("teo_description", "urdf/teo.urdf")
    except FileNotFoundError as error:
        raise DescriptionError("urdf_missing", str(error)) from error


@cache
def urdf_text(hand_drive: str = DEFAULT_HAND_DRIVE) -> str:
    """TEO's URDF, with the velocity limits of a hand drive.

    Args:
        hand_drive: One of `HAND_DRIVES`. Only the default one stands in a file.

    Raises:
        DescriptionError: ``unknown_hand_drive``, ``urdf_missing``.
    """
    return urdf_path().read_text(encoding="utf-8") if hand_drive == DEFAULT_HAND_DRIVE else urdf(hand_drive)


@cache
def description_hash() -> str:
    """SHA-256, in hexadecimal, of what joint angles are made for: names the robot of a sign.

    It is that of the canonical URDF (C14N 2.0, UTF-8) without comments, white space and limits of velocity
    and effort: a sign looks the same on a robot that is faster or stronger.
    """
    text = ET.canonicalize(urdf_text(), strip_text=True, exclude_attrs=["velocity", "effort"])
    return hashlib.sha256(text.encode("utf-8")).hexdigest()


@cache
def _limits(hand_drive: str) -> Mapping[str, tuple[float, ...]]:
    limits = {}
    for joint in ET.fromstring(urdf_text(hand_drive)).iter("joint"):
        limit = joint.find("limit")
        if limit is not None and joint.find("mimic") is None:
            keys = ("lower", "upper", "velocity", "effort")
            limits[joint.attrib["name"]] = tuple(float(limit.attrib[key]) for key in keys)
    return limits


def joint_limits(
    names: Sequence[str] = COMMANDED_JOINTS, *, hand_drive: str = DEFAULT_HAND_DRIVE
) -> JointLimits:
    """Limits of the named joints.

    Args:
        names: Joints among `ALL_JOINTS`, in the order wanted.
        hand_drive: One of `HAND_DRIVES`.

    Raises:
        DescriptionError: ``unknown_joint``, ``unknown_hand_drive``.
    """
    check_joint_names(names)
    table = _limits(hand_drive)
    values = np.array([table[name][:3] for name in names], dtype=np.float64).reshape(-1, 3)
    values.setflags(write=False)
    return JointLimits(names=tuple(names), lower=values[:, 0], upper=values[:, 1], velocity=values[:, 2])


def effort_limits(names: Sequence[str] = COMMANDED_JOINTS) -> NDArray[np.float64]:
    """Greatest torques of the named joints [N m]. Shape (n,). Placeholders: none is published.

    Raises:
        DescriptionError: ``unknown_joint``.
    """
    check_joint_names(names)
    table = _limits(DEFAULT_HAND_DRIVE)
    return np.array([table[name][3] for name in names])
