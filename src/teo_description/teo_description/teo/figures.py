# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The figures from which the URDF is built: CSV tables in ``data/``, each naming its sources in its head.

Tables describe the body as published; hands, fixed frames and shapes are listed for the right side and
mirrored here about y = 0.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from importlib import resources

from teo_description.humanoid import load_humanoid

Vector = tuple[float, float, float]

_mirrored_name = load_humanoid("teo").mirrored_name

AXES: dict[str, Vector] = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}


@dataclass(frozen=True, kw_only=True)
class JointRow:
    """A revolute joint; its child link is ``<name>_link`` and its frame is parallel to the parent's at zero.

    Attributes:
        origin: Position in the parent link frame [m].
        axis: Unit vector in that frame.
        lower, upper: Limits [rad].
        follows: Joint that this one follows, or None.
        multiplier, offset: Its value is multiplier times the other's plus offset [rad], if it follows.
    """

    name: str
    parent: str
    origin: Vector
    axis: Vector
    lower: float
    upper: float
    follows: str | None = None
    multiplier: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True, kw_only=True)
class Inertial:
    """Mass [kg], its centre [m] in the link frame and ixx, iyy, izz, ixy, ixz, iyz [kg m^2] about that."""

    mass: float
    centre: Vector
    inertia: tuple[float, float, float, float, float, float]


@dataclass(frozen=True, kw_only=True)
class FixedFrame:
    """A frame fixed to a link: position [m] and roll, pitch, yaw [rad] in the parent."""

    name: str
    parent: str
    origin: Vector
    rpy: Vector


@dataclass(frozen=True, kw_only=True)
class Shape:
    """A box (two opposite corners), rod, capsule (two axis points and a radius) or sphere of a link [m]."""

    link: str
    use: str
    kind: str
    material: str
    radius: float
    start: Vector
    end: Vector


def _rows(table: str) -> Iterator[dict[str, str]]:
    text = resources.files("teo_description").joinpath("teo", "data", table).read_text(encoding="utf-8")
    yield from csv.DictReader(line for line in text.splitlines() if line and not line.startswith("#"))


def _vector(row: dict[str, str], *keys: str) -> Vector:
    x, y, z = (float(row[key] or 0.0) for key in keys)
    return x, y, z


def _mirrored(vector: Vector) -> Vector:
    return vector[0], -vector[1] + 0.0, vector[2]  # + 0.0: no "-0.0" in the file


def _mirrored_axial(vector: Vector) -> Vector:
    """Mirror an axis of rotation (or roll, pitch, yaw): turns about x and z change their sense."""
    return -vector[0] + 0.0, vector[1], -vector[2] + 0.0


def _joint(row: dict[str, str], name: str, parent: str) -> JointRow:
    return JointRow(
        name=name,
        parent=parent,
        origin=_vector(row, "x", "y", "z"),
        axis=AXES[row["axis"]],
        lower=math.radians(float(row["lower_deg"])),
        upper=math.radians(float(row["upper_deg"])),
    )


def body_joints() -> tuple[JointRow, ...]:
    """The 28 joints of trunk, head, arms and legs."""
    return tuple(_joint(row, row["joint"], row["parent"]) for row in _rows("joints.csv"))


def hand_joints(side: str) -> tuple[JointRow, ...]:
    """The 15 joints of the Dextra hand of a side, ``"Left"`` or ``"Right"``.

    A joint that follows goes through its range as the joint that it follows goes through its own.
    """
    joints: dict[str, JointRow] = {}
    for row in _rows("hand_joints.csv"):
        joint = _joint(row, side + row["joint"], f"{side}{row['parent']}_link")
        if side == "Left":
            joint = replace(joint, origin=_mirrored(joint.origin), axis=_mirrored_axial(joint.axis))
        if row["follows"]:
            joint = _following(joint, joints[side + row["follows"]])
        joints[joint.name] = joint
    return tuple(joints.values())


def _following(joint: JointRow, leader: JointRow) -> JointRow:
    multiplier = (joint.upper - joint.lower) / (leader.upper - leader.lower)
    offset = joint.lower - multiplier * leader.lower
    return replace(joint, follows=leader.name, multiplier=multiplier, offset=offset)


def inertials() -> dict[str, Inertial]:
    """Published inertial figures of the body links, by link."""
    table = {}
    for row in _rows("inertials.csv"):
        ixx, iyy, izz, ixy, ixz, iyz = (float(row[key]) for key in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz"))
        table[row["link"]] = Inertial(
            mass=float(row["mass"]),
            centre=_vector(row, "x", "y", "z"),
            inertia=(ixx, iyy, izz, ixy, ixz, iyz),
        )
    return table


def fixed_frames() -> tuple[FixedFrame, ...]:
    """Palms, finger tips, sensor plates, soles, camera and IMU, both sides."""
    frames = []
    for row in _rows("fixed_frames.csv"):
        frame = FixedFrame(
            name=row["frame"],
            parent=row["parent"],
            origin=_vector(row, "x", "y", "z"),
            rpy=_vector(row, "roll", "pitch", "yaw"),
        )
        frames.append(frame)
        if _mirrored_name(frame.name) != frame.name:
            name, parent = (
                _mirrored_name(frame.name),
                _mirrored_name(frame.parent),
            )
            origin, rpy = _mirrored(frame.origin), _mirrored_axial(frame.rpy)
            frames.append(FixedFrame(name=name, parent=parent, origin=origin, rpy=rpy))
    return tuple(frames)


def shapes() -> tuple[Shape, ...]:
    """Collision and visual shapes of every link, both sides."""
    found = []
    for row in _rows("shapes.csv"):
        shape = Shape(
            link=row["link"],
            use=row["use"],
            kind=row["shape"],
            material=row["material"],
            radius=float(row["radius"] or 0.0),
            start=_vector(row, "x", "y", "z"),
            end=_vector(row, "x2", "y2", "z2"),
        )
        found.append(shape)
        link = _mirrored_name(shape.link)
        if link != shape.link:
            found.append(replace(shape, link=link, start=_mirrored(shape.start), end=_mirrored(shape.end)))
    return tuple(found)


def materials() -> dict[str, Vector]:
    """Colour (red, green, blue in 0..1) by material name."""
    return {row["material"]: _vector(row, "red", "green", "blue") for row in _rows("materials.csv")}
