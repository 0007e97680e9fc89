# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Boxes, cylinders and spheres as URDF knows them, made from the rows of the shape table."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from teo_description.teo.figures import Inertial, Shape, Vector


@dataclass(frozen=True, kw_only=True)
class Solid:
    """One URDF geometry in its link frame.

    Attributes:
        kind: ``"box"``, ``"cylinder"`` or ``"sphere"``.
        size: Box: edge lengths; cylinder: radius, length, 0; sphere: radius, 0, 0 [m].
        centre: Position [m].
        rpy: Roll, pitch, yaw [rad]; a cylinder's axis is its z.
        material: Name of a material, or empty.
    """

    kind: str
    size: Vector
    centre: Vector
    rpy: Vector = (0.0, 0.0, 0.0)
    material: str = ""

    def volume(self) -> float:
        """Volume [m^3]."""
        if self.kind == "box":
            return math.prod(self.size)
        if self.kind == "cylinder":
            return math.pi * self.size[0] ** 2 * self.size[1]
        return 4.0 / 3.0 * math.pi * self.size[0] ** 3

    def principal_inertia(self) -> Vector:
        """Diagonal of the inertia of one kilogram of it, about its centre and in its own axes [m^2]."""
        if self.kind == "box":
            a, b, c = (edge * edge / 12.0 for edge in self.size)
            return b + c, a + c, a + b
        if self.kind == "cylinder":
            across = self.size[0] ** 2 / 4.0 + self.size[1] ** 2 / 12.0
            return across, across, self.size[0] ** 2 / 2.0
        return (0.4 * self.size[0] ** 2,) * 3


def visual_solids(shapes: Iterable[Shape], link: str) -> tuple[Solid, ...]:
    """The visual geometries of a link; a capsule gives a cylinder and two spheres."""
    solids = []
    for shape in shapes:
        if shape.link == link and shape.use in ("visual", "both"):
            solids.append(_solid(shape))
            if shape.kind == "capsule":
                ends = (shape.start, shape.end)
                size = (shape.radius, 0.0, 0.0)
                solids += [
                    Solid(kind="sphere", size=size, centre=end, material=shape.material) for end in ends
                ]
    return tuple(solids)


def collision_solids(shapes: Iterable[Shape], link: str) -> tuple[Solid, ...]:
    """The collision geometries of a link; a capsule gives the cylinder that contains it."""
    return tuple(
        _solid(shape, over=shape.radius if shape.kind == "capsule" else 0.0, material="")
        for shape in shapes
        if shape.link == link and shape.use in ("collision", "both")
    )


def _solid(shape: Shape, over: float = 0.0, material: str | None = None) -> Solid:
    name = shape.material if material is None else material
    if shape.kind == "sphere":
        return Solid(kind="sphere", size=(shape.radius, 0.0, 0.0), centre=shape.start, material=name)
    start, end = np.array(shape.start), np.array(shape.end)
    x, y, z = (float(value) for value in (start + end) / 2.0)
    along = end - start
    if shape.kind == "box":
        a, b, c = (float(value) for value in np.abs(along))
        return Solid(kind="box", size=(a, b, c), centre=(x, y, z), material=name)
    length = float(np.linalg.norm(along)) + 2.0 * over
    pitch = math.atan2(math.hypot(along[0], along[1]), along[2])
    # A half turn about y and none are the same rod; so is a turn about its own axis.
    rpy = (0.0, 0.0, 0.0) if pitch in (0.0, math.pi) else (0.0, pitch, math.atan2(along[1], along[0]))
    return Solid(kind="cylinder", size=(shape.radius, length, 0.0), centre=(x, y, z), rpy=rpy, material=name)


def rotation(rpy: Vector) -> np.ndarray:
    """Rotation matrix of roll, pitch, yaw about fixed axes (URDF). Shape (3, 3)."""
    (cr, cp, cy), (sr, sp, sy) = np.cos(rpy), np.sin(rpy)
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )


def uniform_inertial(mass: float, solids: Iterable[Solid]) -> Inertial:
    """Inertial figures of a mass [kg] spread evenly over some solids; where they overlap it counts twice."""
    solids = tuple(solids)
    volumes = np.array([solid.volume() for solid in solids])
    masses = mass * volumes / volumes.sum()
    centres = np.array([solid.centre for solid in solids])
    centre = masses @ centres / mass
    total = np.zeros((3, 3))
    for part, solid in zip(masses, solids, strict=True):
        turned = rotation(solid.rpy)
        offset = np.array(solid.centre) - centre
        own = turned @ np.diag(solid.principal_inertia()) @ turned.T
        total += part * (own + offset @ offset * np.eye(3) - np.outer(offset, offset))
    x, y, z = centre.tolist()
    (ixx, ixy, ixz), (_, iyy, iyz), (_, _, izz) = total.tolist()
    return Inertial(mass=mass, centre=(x, y, z), inertia=(ixx, iyy, izz, ixy, ixz, iyz))
