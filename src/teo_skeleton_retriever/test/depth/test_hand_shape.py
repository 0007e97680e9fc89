# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import numpy as np
from capsule_person import pose
from scipy.spatial.transform import Rotation

from teo_skeleton_retriever.depth.hand_shape import CHILD, PARENT, laid, turned

HAND = pose((-0.25, 0.05, -0.35), (0.25, 0.05, -0.2), curl=0.9).right_hand
BONES = HAND[CHILD] - HAND[PARENT]
LENGTHS = np.linalg.norm(BONES, axis=1)
BENDS = HAND / HAND[:, 2:]


def test_a_hand_is_turned_back_as_it_was_turned() -> None:
    way = Rotation.from_rotvec([0.5, -1.1, 0.3]).as_matrix()
    back = turned((BONES @ way)[None], BONES[None], np.ones((1, 20)))
    np.testing.assert_allclose(back[0], BONES, atol=1e-12)


def test_a_hand_is_never_mirrored() -> None:
    mirrored = BONES * [-1.0, 1.0, 1.0]
    shape = turned(mirrored[None], BONES[None], np.ones((1, 20)))[0]
    way, *_ = np.linalg.lstsq(mirrored, shape, rcond=None)
    assert math.isclose(np.linalg.det(way), 1.0, rel_tol=1e-9)


def test_a_hand_imagined_leaning_the_wrong_way_is_laid_onto_its_depths() -> None:
    wrong = BONES @ Rotation.from_rotvec([0.9, 0.0, 0.0]).as_matrix()
    depths = laid(wrong[None], BENDS[None], HAND[None, :, 2], np.ones((1, 21)))[0]
    np.testing.assert_allclose(depths, HAND[:, 2], atol=1e-6)


def test_depths_of_something_else_do_not_pull_a_hand() -> None:
    measured = HAND[:, 2].copy()
    measured[[8, 12, 16, 20]] += 0.15  # what is behind four fingertips
    depths = laid(BONES[None], BENDS[None], measured[None], np.ones((1, 21)))[0]
    np.testing.assert_allclose(depths, HAND[:, 2], atol=0.006)
