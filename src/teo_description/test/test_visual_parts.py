# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections import Counter

import numpy as np
import pytest

from teo_description.pictures import visual_parts

SOLIDS = {
    "box": (visual_parts.box(0.1, 0.2, 0.3), 8 * 0.1 * 0.2 * 0.3),
    "cylinder": (visual_parts.cylinder(0.1, 0.2), np.pi * 0.1**2 * 0.4),
    "sphere": (visual_parts.sphere(0.1), 4 / 3 * np.pi * 0.1**3),
}


@pytest.mark.parametrize("name", SOLIDS)
def test_surface_is_closed_and_turned_outwards(name):
    made, volume = SOLIDS[name]
    corners = made.vertices[made.triangles]
    # By the divergence theorem: the signed volume is right only when all triangles face outwards.
    signed = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6
    assert signed == pytest.approx(volume, rel=0.03)
    assert signed < volume
    edges = Counter()
    for triangle in corners.round(9) + 0.0:
        for first, second in ((0, 1), (1, 2), (2, 0)):
            if not np.array_equal(triangle[first], triangle[second]):
                edges[tuple(triangle[first]), tuple(triangle[second])] += 1
    assert all(edges[second, first] == count for (first, second), count in edges.items())


@pytest.mark.parametrize("name", SOLIDS)
def test_normals_are_unit_and_point_outwards(name):
    made, _ = SOLIDS[name]
    assert np.linalg.norm(made.normals, axis=1) == pytest.approx(1.0)
    assert (np.einsum("ij,ij->i", made.normals, made.vertices) > 0).all()
