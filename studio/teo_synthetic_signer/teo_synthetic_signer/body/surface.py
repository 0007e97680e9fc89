# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Triangles with what is needed to paint them, and what rays hit first of them."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from typing import NamedTuple

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import NDArray

from teo_skeleton_retriever.arrays import FloatArray
from teo_synthetic_signer.body.body_data import IntArray


class Material(IntEnum):
    """How a triangle is painted."""

    PLAIN = 0
    """in the colours of its corners"""
    EYE = 1
    """white, with iris and pupil where it looks"""
    CLOTH = 2
    """likewise with a fine weave, and in other colours below the waist and above the collar"""
    HAIR = 3
    """like PLAIN, with strands"""
    WOOD = 4
    """like PLAIN, with grain"""
    TILES = 5
    """like PLAIN, with joints every 0.3 m"""
    PLASTER = 6
    """like PLAIN, with soft stains"""


@dataclass(frozen=True, eq=False)
class Surface:
    """A set of triangles.

    Attributes:
        triangles: Indices of vertices. Shape (t, 3).
        colors: Of each vertex, 0 to 1. Shape (n, 3).
        patterns: Where each vertex is in its material's pattern [m]. Shape (n, 3).
        below: Colours of cloth where its pattern's z is below 0: trousers. Shape (n, 3).
        above: Colours of cloth where its pattern's z is above 1: bare skin. Shape (n, 3).
        materials: Of each triangle, `Material`. Shape (t,).
        bones: Index of the bone that moves each triangle most, -1 for furniture. Shape (t,).
    """

    triangles: IntArray
    colors: FloatArray
    patterns: FloatArray
    below: FloatArray
    above: FloatArray
    materials: NDArray[np.int8]
    bones: NDArray[np.int16]


def vertex_normals(vertices: FloatArray, triangles: IntArray) -> FloatArray:
    """Give the direction in which the surface faces at each vertex. Shape (n, 3)."""
    a, b, c = (vertices[triangles[:, i]] for i in range(3))
    facing = np.cross(b - a, c - a)
    normals = np.zeros_like(vertices)
    for axis in range(3):
        for corner in range(3):
            normals[:, axis] += np.bincount(
                triangles[:, corner], weights=facing[:, axis], minlength=len(vertices)
            )
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    return normals / np.where(length > 0.0, length, 1.0)


class Hits(NamedTuple):
    """What rays hit.

    Args:
        triangle: Index of the nearest triangle, -1 where there is none. Shape (n,).
        distance: To it, in lengths of the ray's direction; infinite where there is none. Shape (n,).
        shares: Of the triangle's three corners at that place. Shape (n, 3).
    """

    triangle: NDArray[np.int32]
    distance: NDArray[np.float32]
    shares: NDArray[np.float32]

    def of(self, rays: NDArray[np.int64]) -> Hits:
        """Give the hits of some of the rays."""
        return Hits(self.triangle[rays], self.distance[rays], self.shares[rays])


class RayCaster:
    """The triangles of one image, seen from the origin."""

    def __init__(self, corners: FloatArray) -> None:
        """Sort triangles for fast search.

        Args:
            corners: Of each triangle [m]. Shape (n, 3, 3).
        """
        self._scene = EmbreeScene()
        self._mesh = TriangleMesh(self._scene, np.ascontiguousarray(corners, dtype=np.float32))

    def cast(self, directions: NDArray[np.float32]) -> Hits:
        """Follow rays from the origin. Directions need no length of 1. Shape (n, 3)."""
        origins = np.zeros_like(directions)
        found = self._scene.run(origins, np.ascontiguousarray(directions), output=1)
        triangle = found["primID"]
        u, v = found["u"], found["v"]
        distance = np.where(triangle >= 0, found["tfar"], np.inf).astype(np.float32)
        return Hits(triangle, distance, np.column_stack([1.0 - u - v, u, v]))
