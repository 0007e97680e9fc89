# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Triangles for the boxes, cylinders, spheres and mesh files of a robot description."""

from __future__ import annotations

import math
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from teo_description.errors import DescriptionError

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


def box(half_sizes: NDArray[np.float64]) -> Mesh:
    """A box about the origin with its edges taken off, so that they catch the light.

    Args:
        half_sizes: Half the edge lengths [m]. Shape (3,).
    """
    half = np.asarray(half_sizes, dtype=np.float64)
    bevel = min(0.006, 0.25 * float(half.min()))
    signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=np.float64)
    # Each corner has a vertex on each of its three faces.
    corners: dict[tuple[float, ...], int] = {}
    vertices: list[NDArray[np.float64]] = []
    faces: list[list[int]] = []
    for corner in signs:
        for axis in range(3):
            inner = half - bevel
            inner[axis] = half[axis]
            corners[(*corner, axis)] = len(vertices)
            vertices.append(corner * inner)
    for axis in range(3):
        one, two = (axis + 1) % 3, (axis + 2) % 3
        for side in (-1.0, 1.0):
            ring = []
            for first, second in ((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)):
                corner = np.empty(3)
                corner[axis], corner[one], corner[two] = side, first, second
                ring.append(corners[(*corner, axis)])
            faces.append(ring)
        for first in (-1.0, 1.0):  # the bevels along this axis
            for second in (-1.0, 1.0):
                ends = []
                for along in (-1.0, 1.0):
                    corner = np.empty(3)
                    corner[axis], corner[one], corner[two] = along, first, second
                    ends.append([corners[(*corner, one)], corners[(*corner, two)]])
                faces.append([ends[0][0], ends[0][1], ends[1][1], ends[1][0]])
    faces += [[corners[(*corner, axis)] for axis in range(3)] for corner in signs]
    return _flat(np.array(vertices), faces)


def cylinder(radius: float, half_length: float) -> Mesh:
    """A cylinder about the origin along z [m], with flat ends."""
    count = _segments(radius)
    angles = np.arange(count) * (2.0 * math.pi / count)
    circle = np.stack([np.cos(angles), np.sin(angles), np.zeros(count)], axis=1)
    up = np.array([0.0, 0.0, 1.0])
    following = (np.arange(count) + 1) % count
    here = np.arange(count)
    side = Mesh(
        np.concatenate([circle * radius - up * half_length, circle * radius + up * half_length]),
        np.concatenate([circle, circle]),
        np.concatenate(
            [
                np.stack([here, following, following + count], axis=1),
                np.stack([here, following + count, here + count], axis=1),
            ]
        ).astype(np.int32),
    )
    fan = np.stack([np.zeros(count - 2), here[1:-1], here[2:]], axis=1).astype(np.int32)
    top = Mesh(circle * radius + up * half_length, np.tile(up, (count, 1)), fan)
    bottom = Mesh(circle * radius - up * half_length, np.tile(-up, (count, 1)), fan[:, ::-1].copy())
    return joined(side, top, bottom)


def sphere(radius: float) -> Mesh:
    """A sphere about the origin [m]."""
    count = _segments(radius)
    rows = count // 2
    polar = np.linspace(0.0, math.pi, rows + 1)[:, None]
    around = (np.arange(count) * (2.0 * math.pi / count))[None, :]
    normals = np.stack(
        [
            np.sin(polar) * np.cos(around),
            np.sin(polar) * np.sin(around),
            np.broadcast_to(np.cos(polar), (rows + 1, count)),
        ],
        axis=-1,
    ).reshape(-1, 3)
    row, column = (index.ravel() for index in np.meshgrid(np.arange(rows), np.arange(count), indexing="ij"))
    upper, upper_next = row * count + column, row * count + (column + 1) % count
    lower, lower_next = upper + count, upper_next + count
    triangles = np.concatenate(
        [
            np.stack([upper, lower, lower_next], axis=1)[row < rows - 1],
            np.stack([upper, lower_next, upper_next], axis=1)[row > 0],
        ]
    )
    return Mesh(normals * radius, normals, triangles.astype(np.int32))


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
    """Lit as round where a triangle's normal is near the mean of those about its corner, else as flat."""
    corners = points[faces]
    flat = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    round_ = np.zeros_like(points)
    np.add.at(round_, faces, flat[:, None])  # by area: a normal is as long as its triangle is large
    flat, round_ = (n / np.maximum(np.linalg.norm(n, axis=1, keepdims=True), 1e-12) for n in (flat, round_))
    sharp = np.einsum("ij,ikj->ik", flat, round_[faces]) < _CREASE
    rows = faces.astype(np.int32)
    rows[sharp] = len(points) + np.arange(np.count_nonzero(sharp))
    own = np.repeat(flat, 3, axis=0)[sharp.ravel()]
    return Mesh(np.concatenate([points, corners[sharp]]), np.concatenate([round_, own]), rows)


def _segments(radius: float) -> int:
    """How many sides make a circle look round at its size on a picture; even."""
    return 12 if radius < 0.02 else 20 if radius < 0.06 else 32


def _flat(vertices: NDArray[np.float64], faces: list[list[int]]) -> Mesh:
    """Give each convex face about the origin vertices of its own, turned outwards."""
    points: list[NDArray[np.float64]] = []
    normals: list[NDArray[np.float64]] = []
    triangles: list[list[int]] = []
    for face in faces:
        ring = vertices[face]
        normal = np.cross(ring[1] - ring[0], ring[2] - ring[0])
        if normal @ ring.mean(axis=0) < 0.0:
            ring, normal = ring[::-1], -normal
        start = len(points)
        points += list(ring)
        normals += [normal / np.linalg.norm(normal)] * len(ring)
        triangles += [[start, start + index, start + index + 1] for index in range(1, len(ring) - 1)]
    return Mesh(np.array(points), np.array(normals), np.array(triangles, dtype=np.int32))
