# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a robot looks like, part by part: boxes, rods, balls and meshes of its URDF as triangles."""

from __future__ import annotations

import logging
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from teo_description.errors import DescriptionError
from teo_description.pictures import mesh
from teo_description.robot import Robot

_log = logging.getLogger(__name__)

# Colour of what has none.
_GREY = (0.7, 0.7, 0.7, 1.0)


class Part(NamedTuple):
    """A coloured surface that a joint moves."""

    joint: int
    """Pinocchio's index of it."""
    mesh: mesh.Mesh
    """In the joint's frame."""
    colour: tuple[float, float, float]
    """Red, green, blue in 0..1."""


def visual_parts(robot: Robot) -> list[Part]:
    """Everything that is seen of a robot.

    A link whose mesh is not on this machine is drawn as its collision shapes are, and a warning says what
    would bring the mesh.

    Raises:
        DescriptionError: ``unknown_shape``, or ``bad_mesh``.
    """
    root = ET.fromstring(robot.humanoid.urdf_text())
    parts, bare = [], set()
    for link in root.iter("link"):
        for visual in link.findall("visual"):
            file = visual.find("geometry/mesh")
            if file is None:
                continue
            link.remove(visual)
            path = robot.humanoid.mesh_path(file.attrib["filename"])
            if path is None:
                bare.add(link.attrib["name"])
            else:
                parts.append(_mesh_part(robot, link.attrib["name"], visual, path))
    if bare:
        name, meshes = robot.humanoid.name, robot.humanoid.file.meshes
        how = "" if meshes is None else f": {meshes.install}"
        _log.warning("%s is drawn as plain shapes, without the meshes of %d links%s", name, len(bare), how)
    shapes = list(_shape_parts(robot, ET.tostring(root, encoding="unicode"), pin.GeometryType.VISUAL))
    if bare:
        shapes += _shape_parts(robot, robot.humanoid.urdf_text(), pin.GeometryType.COLLISION, bare)
    return shapes + parts


def _shape_parts(
    robot: Robot, urdf: str, kind: pin.GeometryType, links: set[str] | None = None
) -> Iterator[Part]:
    geometry = pin.buildGeomFromUrdfString(robot.model, urdf, kind)
    for item in geometry.geometryObjects:
        if links is None or robot.model.frames[item.parentFrame].name in links:
            colour = item.meshColor[:3] if kind == pin.GeometryType.VISUAL else _GREY[:3]
            yield Part(item.parentJoint, _shape(item), tuple(colour))


def _shape(item: Any) -> mesh.Mesh:
    shape, placement = item.geometry, item.placement
    kind = type(shape).__name__  # by name: the module is called coal or hppfcl, by the age of Pinocchio
    if kind == "Box":
        made = mesh.box(shape.halfSide)
    elif kind == "Cylinder":
        made = mesh.cylinder(shape.radius, shape.halfLength)
    elif kind == "Sphere":
        made = mesh.sphere(shape.radius)
    else:
        raise DescriptionError(
            "unknown_shape", f"expected boxes, cylinders, spheres and meshes in the URDF, got {kind}"
        )
    return mesh.moved(made, placement.rotation, placement.translation)


def _mesh_part(robot: Robot, link: str, visual: ET.Element, path: Path) -> Part:
    frame = robot.model.frames[robot.model.getFrameId(link, pin.FrameType.BODY)]
    origin, file = visual.find("origin"), visual.find("geometry/mesh")
    at = {} if origin is None else origin.attrib
    xyz, rpy = (_numbers(at.get(key, "0 0 0")) for key in ("xyz", "rpy"))
    scale = _numbers("1 1 1" if file is None else file.get("scale", "1 1 1"))
    placement = frame.placement * pin.SE3(pin.rpy.rpyToMatrix(*rpy), xyz)
    surface = mesh.from_file(path, scale)
    colour = visual.find("material/color")
    rgba = _GREY if colour is None else _numbers(colour.attrib["rgba"])
    return Part(
        frame.parentJoint,
        mesh.moved(surface, placement.rotation, placement.translation),
        (float(rgba[0]), float(rgba[1]), float(rgba[2])),
    )


def _numbers(text: str) -> NDArray[np.float64]:
    return np.array(text.split(), dtype=np.float64)
