# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a robot looks like, part by part: boxes, rods, balls and meshes of its URDF as triangles."""

from __future__ import annotations

import logging
import math
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from functools import cache
from itertools import product
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

from teo_description.errors import DescriptionError
from teo_description.robot import Robot

# Triangles that are left of a mesh longer than 8 cm, such as a trunk, and of a smaller one, such as a finger.
_LARGE, _TRIANGLES_LARGE, _TRIANGLES_SMALL = 0.08, 2000, 400

# Cosine of the angle to the surface about its corner up to which a mesh's triangle is shaded as round.
_CREASE = math.cos(math.radians(35.0))


class Mesh(NamedTuple):
    """A closed surface; triangles run counter-clockwise seen from outside."""

    vertices: NDArray[np.float64]
    """[m]. Shape (n, 3)."""
    normals: NDArray[np.float64]
    """Unit outward normal of each vertex. Shape (n, 3)."""
    triangles: NDArray[np.int32]
    """Vertex indices. Shape (m, 3)."""


def joined(*meshes: Mesh) -> Mesh:
    """Put several meshes into one."""
    offsets = np.cumsum([0] + [len(mesh.vertices) for mesh in meshes[:-1]])
    return Mesh(
        np.concatenate([mesh.vertices for mesh in meshes]),
        np.concatenate([mesh.normals for mesh in meshes]),
        np.concatenate(
            [mesh.triangles + offset for mesh, offset in zip(meshes, offsets, strict=True)]
        ).astype(np.int32),
    )


def moved(mesh: Mesh, rotation: NDArray[np.float64], translation: NDArray[np.float64]) -> Mesh:
    """Turn (shape (3, 3)) and shift (shape (3,) [m]) a mesh."""
    return Mesh(mesh.vertices @ rotation.T + translation, mesh.normals @ rotation.T, mesh.triangles)


@cache  # parts of both sides, and of several fingers, are alike
def box(*half_sizes: float) -> Mesh:
    """A box about the origin with its edges taken off, so that they catch the light.

    Args:
        half_sizes: Half the edge lengths along x, y and z [m].
    """
    bevel = min(0.006, 0.25 * min(half_sizes))
    # Each corner has a vertex on each of its three faces.
    signs = np.array(list(product((-1.0, 1.0), repeat=3)))
    halves = np.array(half_sizes)
    points = np.concatenate([signs * (halves - bevel * (1.0 - axis)) for axis in np.eye(3)])
    return _hull(points, np.zeros_like(points))


@cache
def cylinder(radius: float, half_length: float) -> Mesh:
    """A cylinder about the origin along z [m], with flat ends."""
    angles = _angles(radius)
    circle = np.stack([np.cos(angles), np.sin(angles), np.zeros_like(angles)], axis=1)
    up = np.array([0.0, 0.0, half_length])
    return _hull(np.concatenate([radius * circle - up, radius * circle + up]), np.tile(circle, (2, 1)))


@cache
def sphere(radius: float) -> Mesh:
    """A sphere about the origin [m]."""
    around = _angles(radius)
    polar = around[1 : len(around) // 2, None]  # between the poles
    rings = [np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around), np.cos(polar) + 0.0 * around]
    poles = [[0.0, 0.0, -1.0], [0.0, 0.0, 1.0]]
    normals = np.concatenate([np.stack(rings, axis=-1).reshape(-1, 3), poles])
    return _hull(radius * normals, normals)


def _hull(points: NDArray[np.float64], around: NDArray[np.float64]) -> Mesh:
    """The convex hull of points about the origin, shaded as `_shaded` says."""
    hull = ConvexHull(points)
    faces, flat = hull.simplices, hull.equations[:, :3]
    one, two, three = points[faces].transpose(1, 0, 2)
    inwards = np.einsum("ij,ij->i", np.cross(two - one, three - one), flat) < 0.0
    faces[inwards] = faces[inwards, ::-1]
    return _shaded(points, faces, flat, around)


def from_file(path: Path, scale: NDArray[np.float64]) -> Mesh:
    """A mesh file with so few triangles as its size on a picture asks for.

    Args:
        path: An STL, OBJ or DAE file.
        scale: What its coordinates are multiplied by for metres. Shape (3,).

    Raises:
        DescriptionError: ``bad_mesh``; ``meshes_unavailable`` without the libraries that read them.
    """
    try:
        import fast_simplification  # here: only robots with meshes need both
        import trimesh
    except ImportError as error:
        raise DescriptionError(
            "meshes_unavailable", f"expected {error.name} to draw {path.name}: make robots"
        ) from error
    try:
        read = trimesh.load_mesh(path)
        points, faces = np.asarray(read.vertices, np.float32) * scale, np.asarray(read.faces, np.int32)
    except Exception as error:  # the reader of each format has its own
        raise DescriptionError("bad_mesh", f"expected a mesh at {path}: {error}") from error
    if not len(faces):
        raise DescriptionError("bad_mesh", f"expected a mesh at {path}, got no triangle")
    wanted = _TRIANGLES_LARGE if np.ptp(points, axis=0).max() > _LARGE else _TRIANGLES_SMALL
    if len(faces) > wanted:  # by quadric error: Garland and Heckbert, 1997
        points, faces = fast_simplification.simplify(points, faces, target_count=wanted)
    return _smooth(points.astype(np.float64), faces)


def _smooth(points: NDArray[np.float64], faces: NDArray[np.int32]) -> Mesh:
    """A surface whose corners are as round as the mean of the triangles about them."""
    corners = points[faces]
    flat = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    around = np.zeros_like(points)
    np.add.at(around, faces, flat[:, None])  # by area: a normal is as long as its triangle is large
    flat, around = (n / np.maximum(np.linalg.norm(n, axis=1, keepdims=True), 1e-12) for n in (flat, around))
    return _shaded(points, faces, flat, around)


def _shaded(
    points: NDArray[np.float64],
    faces: NDArray[np.int32],
    flat: NDArray[np.float64],
    around: NDArray[np.float64],
) -> Mesh:
    """Lit as round where a triangle's normal (`flat`) is near that of its corner (`around`), else as flat."""
    sharp = np.einsum("ij,ikj->ik", flat, around[faces]) < _CREASE
    normals = np.where(sharp[:, :, None], flat[:, None], around[faces])
    corners = np.concatenate([points[faces], normals], axis=2).reshape(-1, 6)
    vertices, rows = np.unique(corners, axis=0, return_inverse=True)
    return Mesh(vertices[:, :3], vertices[:, 3:], rows.reshape(-1, 3).astype(np.int32))


def _angles(radius: float) -> NDArray[np.float64]:
    """Angles [rad] of a circle's corners: so many that it looks round at its size on a picture."""
    count = 12 if radius < 0.02 else 20 if radius < 0.06 else 32
    return np.linspace(0.0, 2.0 * math.pi, count, endpoint=False)


_log = logging.getLogger(__name__)

# Colour of what has none.
_GREY = (0.7, 0.7, 0.7, 1.0)


class Part(NamedTuple):
    """A coloured surface that a joint moves."""

    link: str
    """The link that it belongs to."""
    joint: int
    """Pinocchio's index of it."""
    mesh: Mesh
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
    for link in root.findall("link"):
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
        link = robot.model.frames[item.parentFrame].name
        if links is None or link in links:
            colour = item.meshColor[:3] if kind == pin.GeometryType.VISUAL else _GREY[:3]
            yield Part(link, item.parentJoint, _shape(item), tuple(colour))


def _shape(item: Any) -> Mesh:
    shape, placement = item.geometry, item.placement
    kind = type(shape).__name__  # by name: the module is called coal or hppfcl, by the age of Pinocchio
    if kind == "Box":
        made = box(*shape.halfSide.tolist())
    elif kind == "Cylinder":
        made = cylinder(shape.radius, shape.halfLength)
    elif kind == "Sphere":
        made = sphere(shape.radius)
    else:
        raise DescriptionError(
            "unknown_shape", f"expected boxes, cylinders, spheres and meshes in the URDF, got {kind}"
        )
    return moved(made, placement.rotation, placement.translation)


def _mesh_part(robot: Robot, link: str, visual: ET.Element, path: Path) -> Part:
    frame = robot.model.frames[robot.model.getFrameId(link, pin.FrameType.BODY)]
    colour = visual.find("material/color")
    rgba = _GREY if colour is None else _numbers(colour.attrib["rgba"])
    return Part(
        link,
        frame.parentJoint,
        moved(visual_mesh(visual, path), frame.placement.rotation, frame.placement.translation),
        (float(rgba[0]), float(rgba[1]), float(rgba[2])),
    )


def visual_mesh(visual: ET.Element, path: Path) -> Mesh:
    """The mesh of a URDF's ``visual`` in the frame of its link.

    Raises:
        DescriptionError: As `from_file`.
    """
    origin, file = visual.find("origin"), visual.find("geometry/mesh")
    at = {} if origin is None else origin.attrib
    xyz, rpy = (_numbers(at.get(key, "0 0 0")) for key in ("xyz", "rpy"))
    scale = _numbers("1 1 1" if file is None else file.get("scale", "1 1 1"))
    return moved(from_file(path, scale), pin.rpy.rpyToMatrix(*rpy), xyz)


def _numbers(text: str) -> NDArray[np.float64]:
    return np.array(text.split(), dtype=np.float64)
