# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import numpy as np
import pytest
from capsule_person import CAMERA
from hypothesis import given, settings
from hypothesis import strategies as st

from teo_skeleton_retriever.depth.depth_lookup import DepthLookup, Surfaces, viewing_rays

FOCAL = 600.0


def wall(distance: float = 3.5) -> np.ndarray:
    return np.full((120, 160), distance, np.float32)


def with_arm(depth: np.ndarray, distance: float = 2.0) -> np.ndarray:
    """An arm 20 px wide, in columns 70 to 89."""
    depth[:, 70:90] = distance
    return depth


def surfaces_at(depth: np.ndarray, pixels: np.ndarray) -> Surfaces:
    lookup = DepthLookup(nearest=0.2, farthest=5.0)
    return lookup.surfaces(
        depth, pixels, focal=FOCAL, distance=np.full(len(pixels), 2.0), radius=0.03, gap=0.06
    )


def look(depth: np.ndarray, x: float, y: float, *, expected: float | None = None) -> float:
    """Depth at one pixel."""
    surfaces = surfaces_at(depth, np.array([[x, y]]))
    found = surfaces.nearest() if expected is None else surfaces.closest(np.array([expected]))
    return float(found.depth[0])


def test_on_a_surface_it_gives_its_depth() -> None:
    found = surfaces_at(with_arm(wall()), np.array([[80, 60]]))
    assert found.depth[0, 0] == pytest.approx(2.0)
    assert found.support[0, 0] == 1.0
    assert found.sigma[0, 0] == pytest.approx(0.008)  # 2 mm at 1 m, four times that at 2 m


@pytest.mark.parametrize("outside", [1, 3, 5])
def test_just_beside_an_arm_it_gives_the_arm_not_the_wall(outside: int) -> None:
    assert look(with_arm(wall()), 89 + outside, 60) == pytest.approx(2.0)


def test_a_hand_before_the_elbow_is_nearer_unless_the_elbow_is_expected() -> None:
    depth = with_arm(wall())
    depth[50:70, 70:78] = 1.7
    assert look(depth, 78, 60) == pytest.approx(1.7)
    assert look(depth, 78, 60, expected=2.02) == pytest.approx(2.0)


def test_flying_pixels_between_arm_and_wall_are_not_believed() -> None:
    depth = with_arm(wall())
    depth[:, 90] = np.linspace(2.2, 3.3, 120, dtype=np.float32)
    depth[60, 88] = 1.2
    assert look(depth, 89, 60) == pytest.approx(2.0)


def test_a_slope_is_read_at_the_keypoint() -> None:
    depth = np.tile(2.0 + 0.002 * np.arange(160, dtype=np.float32), (120, 1))
    assert look(depth, 80, 60) == pytest.approx(2.16, abs=0.003)


@given(st.floats(-1e6, 1e6), st.floats(-1e6, 1e6), st.one_of(st.none(), st.floats()))
@settings(max_examples=60)
def test_no_pixel_and_no_expectation_breaks_it(x: float, y: float, expected: float | None) -> None:
    depth = with_arm(wall())
    found = look(depth, x, y, expected=expected)
    inside = -0.5 <= x < 159.5 and -0.5 <= y < 119.5
    assert math.isnan(found) != inside
    assert not inside or any(abs(found - distance) < 1e-6 for distance in (2.0, 3.5))


def test_keypoints_that_are_unsure_absent_or_outside_the_image_are_not_seen() -> None:
    keypoints = np.array([[10.0, 10.0, 8.3], [10.0, 10.0, 0.2], [0.0, 0.0, 0.0], [-5.0, 10.0, 0.9]])
    seen = viewing_rays(keypoints, CAMERA, 0.3)
    assert seen.seen.tolist() == [True, False, False, False]
    assert np.isnan(seen.rays[1:]).all()
    assert seen.confidence.tolist() == [1.0, 0.0, 0.0, 0.0]  # a logit is no confidence
