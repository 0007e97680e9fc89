# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
from capsule_person import ROW, pose

from teo_skeleton_retriever.depth.body_depth import BodyDepth
from teo_skeleton_retriever.depth.depth_lookup import Surfaces, ViewingRays
from teo_skeleton_retriever.depth.skin import BODY_DEPTHS
from teo_skeleton_retriever.retriever_parameters import RetrieverParameters
from teo_skeleton_retriever.tracking.body_size import BodySize
from teo_skeleton_retriever.tracking.keypoint_filter import FilterOutput


def test_an_elbow_that_another_arm_was_taken_for_is_found_again_once_it_is_seen_beside_it() -> None:
    """The elbow is expected 30 cm too near, where the other arm is; both are seen around its keypoint."""
    truth = pose((-0.4, 0.45, -0.05), (0.4, 0.45, -0.05)).body
    n, elbow = len(truth), ROW["RElbow"]
    rays = truth[:, :2] / np.where(truth[:, 2:] > 0.0, truth[:, 2:], 1.0)
    seen = ViewingRays(500.0 * rays, rays, np.full(n, 0.99), np.ones(n, dtype=bool))
    skin = truth[:, 2] - BODY_DEPTHS
    surfaces = Surfaces(np.full((n, 3), np.nan), np.full((n, 3), 0.008), np.ones((n, 3)))
    surfaces.depth[:, 0] = skin
    surfaces.depth[elbow, :2] = skin[elbow] - 0.3, skin[elbow]
    expected = truth[:, 2].copy()
    expected[elbow] -= 0.3
    sigma = np.full((n, 3), 0.03)
    before = FilterOutput(rays, expected, sigma, np.zeros(n), np.ones(n, dtype=bool))
    found = BodyDepth(RetrieverParameters(detector="other")).find(
        seen, surfaces, before, BodySize(), wrists={}
    )
    assert abs(found.depths[elbow] - truth[elbow, 2]) < 0.03
    assert not found.optimised[elbow]
