# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What each ray hits first: Embree's ray casting over the triangles of one image."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import NDArray

from teo_skeleton_retriever.arrays import FloatArray


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
