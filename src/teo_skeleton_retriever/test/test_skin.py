from __future__ import annotations

import math

import numpy as np
import pytest

from teo_skeleton_retriever.skin import BODY_DEPTHS, HAND_DEPTHS, along_ray

RAY = np.array([[0.0, 0.0, 1.0]])


def behind(axis: list[float]) -> float:
    return float(along_ray(np.array([0.04]), np.array([axis]), RAY)[0])


def test_the_axis_of_a_limb_across_the_ray_is_its_radius_behind_the_skin() -> None:
    assert behind([0.3, 0.1, 0.0]) == pytest.approx(0.04)


def test_of_a_slanted_limb_it_is_farther() -> None:
    """The ray cuts a cylinder that leans by 30 deg from the view along an ellipse."""
    assert behind([math.cos(math.pi / 6), 0.0, math.sin(math.pi / 6)]) == pytest.approx(
        0.04 / math.cos(math.pi / 6)
    )


def test_of_a_limb_that_points_at_the_camera_it_is_no_more_than_twice_the_radius() -> None:
    assert behind([0.0, 0.0, -1.0]) == pytest.approx(0.08)


@pytest.mark.parametrize("axis", [[math.nan] * 3, [0.0] * 3])
def test_of_a_limb_of_unknown_direction_it_is_the_radius(axis: list[float]) -> None:
    assert behind(axis) == pytest.approx(0.04)


def test_every_keypoint_has_a_depth_a_body_can_have() -> None:
    assert BODY_DEPTHS.shape == (25,)
    assert (np.abs(BODY_DEPTHS) < 0.2).all()
    assert ((HAND_DEPTHS > 0.0) & (HAND_DEPTHS < 0.03)).all()
