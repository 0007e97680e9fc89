# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import numpy as np
import pytest

from teo_skeleton_retriever.depth.skin import FOREARM_LEAST_SINE, along_ray

RAY = np.array([[0.0, 0.0, 1.0]])


def behind(limb: list[float], cap: float = 1.0) -> float:
    return float(along_ray(np.array([0.04]), np.array([limb]), RAY, np.array([cap]))[0])


def test_of_a_limb_that_comes_slanting_towards_the_camera_it_is_farther() -> None:
    """The ray cuts a cylinder that leans by 30 deg from the view along an ellipse."""
    assert behind([math.cos(math.pi / 6), 0.0, -math.sin(math.pi / 6)]) == pytest.approx(
        0.04 / math.cos(math.pi / 6)
    )


def test_the_way_out_of_a_forearm_that_points_at_the_camera_ends_at_its_hand() -> None:
    """Steps along the ray from the elbow until it is 0.035 m from the axis, or beyond the hand."""
    for lean in (1.2, 0.4, 0.17, 0.05):
        axis = np.array([math.sin(lean), 0.0, -math.cos(lean)])
        inside = next(
            step
            for step in np.arange(0.0, 1.0, 1e-4)
            if step * math.sin(lean) >= 0.035 or step * math.cos(lean) >= 0.236
        )
        found = along_ray(np.array([0.035]), axis[None], RAY, np.ones(1), least_sine=FOREARM_LEAST_SINE)
        assert float(found[0]) == pytest.approx(inside, abs=0.003)


def test_of_a_limb_that_leads_away_the_ray_meets_the_round_end() -> None:
    """The point of half an ellipsoid of half axes 0.04 and 0.02 m that the ray through its middle meets."""
    assert behind([0.0, 0.0, 0.3], cap=0.5) == pytest.approx(0.02)
    slant = 0.7
    met = behind([math.sin(slant), 0.0, math.cos(slant)], cap=0.5)
    along, across = met * math.cos(slant), met * math.sin(slant)
    assert (along / 0.02) ** 2 + (across / 0.04) ** 2 == pytest.approx(1.0)
    # A ball is as thick anywhere.
    assert behind([math.sin(slant), 0.0, math.cos(slant)]) == pytest.approx(0.04)
