# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import numpy as np
from capsule_person import face, pose

from teo_skeleton_retriever.depth.depth_lookup import Surfaces
from teo_skeleton_retriever.depth.head_depth import FaceDepths, face_depths

FACE = face(pose((-0.2, 0.3, -0.1), (0.2, 0.3, -0.1)))
DEPTHS = FACE[:, 2]


def look(depths: np.ndarray, expected: float = math.nan) -> FaceDepths:
    layers = np.full((70, 3), math.nan)
    layers[:, 0] = depths
    surfaces = Surfaces(layers, np.where(np.isfinite(layers), 0.003, math.nan), np.isfinite(layers) * 1.0)
    return face_depths(FACE[:, :2] / FACE[:, 2:], surfaces, expected)


def test_a_hand_before_a_third_of_the_face_is_looked_through() -> None:
    depths = DEPTHS.copy()
    hidden = FACE[:, 0] > np.quantile(FACE[:, 0], 0.67)
    depths[hidden] -= 0.08
    found = look(depths, expected=float(np.median(DEPTHS)))
    assert np.abs(found.depths - DEPTHS).mean() < 0.012
    assert not found.measured[hidden].any()


def test_the_wall_beside_the_jaw_is_not_the_face() -> None:
    depths = DEPTHS.copy()
    depths[-15:] = 3.0
    found = look(depths)
    assert np.abs(found.depths - DEPTHS).max() < 0.03
    assert found.measured[:-15].mean() > 0.9


def test_a_face_of_which_almost_nothing_was_measured_is_unknown() -> None:
    depths = np.full(70, math.nan)
    depths[:5] = DEPTHS[:5]
    assert np.isnan(look(depths).depths).all()
