# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import numpy as np
import pytest
from capsule_person import face, pose

from teo_skeleton_retriever.depth.depth_lookup import Surfaces
from teo_skeleton_retriever.depth.head_depth import FaceDepths, HeadDepths, face_depths, head_depths

EYES = 1.5  # [m]
# Nose, eyes and ears of a head that faces the camera; the skin is where they are.
DEPTHS = EYES + np.array([-0.02, 0.0, 0.0, 0.085, 0.085])
UNKNOWN = np.full(5, math.nan)


def surfaces(*layers: np.ndarray) -> Surfaces:
    depth = np.full((len(layers[0]), 3), math.nan)
    depth[:, : len(layers)] = np.column_stack(layers)
    return Surfaces(depth, np.where(np.isfinite(depth), 0.004, math.nan), np.isfinite(depth) / len(layers))


def look(head: Surfaces, face: Surfaces, *, neck: float = EYES + 0.12, before: bool = False) -> HeadDepths:
    return head_depths(head, np.zeros(5), face, neck=neck, expected=DEPTHS if before else UNKNOWN)


@pytest.mark.parametrize("before", [False, True])
def test_a_hand_before_most_of_the_face_is_not_the_face(before: bool) -> None:
    nearer = DEPTHS.copy()
    nearer[:4] = 1.22
    face = np.where(np.arange(70) < 50, 1.22, EYES)
    found = look(surfaces(nearer), surfaces(face), before=before)
    assert found.hidden.tolist() == [True] * 4 + [False]
    np.testing.assert_allclose(found.depths, DEPTHS, atol=0.02)
    assert (found.sigma[:4] > 3.0 * found.sigma[4]).all()


def test_what_is_seen_of_the_face_beside_a_finger_is_taken() -> None:
    found = look(surfaces(np.full(5, 1.3), DEPTHS), surfaces(np.full(70, 1.3), np.full(70, EYES)))
    np.testing.assert_allclose(found.depths, DEPTHS)
    assert not found.hidden.any()


def test_a_head_that_is_wholly_hidden_stays_where_it_was_or_where_the_shoulders_are() -> None:
    nothing = surfaces(np.full(5, math.nan)), surfaces(np.full(70, math.nan))
    for before in (True, False):
        found = look(*nothing, before=before)
        np.testing.assert_allclose(found.depths, DEPTHS, atol=0.03)
        assert found.hidden.all()
    assert np.isnan(look(*nothing, neck=math.nan).depths).all()


FACE = face(pose((-0.2, 0.3, -0.1), (0.2, 0.3, -0.1)))
FACE_DEPTHS = FACE[:, 2]


def look_at_face(depths: np.ndarray, expected: float = math.nan) -> FaceDepths:
    return face_depths(FACE[:, :2] / FACE[:, 2:], surfaces(depths), expected)


def test_a_hand_before_a_third_of_the_face_is_looked_through() -> None:
    depths = FACE_DEPTHS.copy()
    hidden = FACE[:, 0] > np.quantile(FACE[:, 0], 0.67)
    depths[hidden] -= 0.08
    found = look_at_face(depths, expected=float(np.median(FACE_DEPTHS)))
    assert np.abs(found.depths - FACE_DEPTHS).mean() < 0.012
    assert not found.measured[hidden].any()


def test_the_wall_beside_the_jaw_is_not_the_face() -> None:
    depths = FACE_DEPTHS.copy()
    depths[-15:] = 3.0
    found = look_at_face(depths)
    assert np.abs(found.depths - FACE_DEPTHS).max() < 0.03
    assert found.measured[:-15].mean() > 0.9


def test_a_face_of_which_almost_nothing_was_measured_is_unknown() -> None:
    depths = np.full(70, math.nan)
    depths[:5] = FACE_DEPTHS[:5]
    assert np.isnan(look_at_face(depths).depths).all()
