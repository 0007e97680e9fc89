# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Any

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from refusals import refused

from teo_skeleton_retriever.camera.camera_model import CameraModel

PLUMB_BOB = np.array([0.12, -0.25, 0.001, -0.0008, 0.08])  # about a D435's colour camera
RATIONAL = np.array([0.43, -2.6, 0.0006, -0.0003, 1.5, 0.31, -2.4, 1.4])  # about an Azure Kinect's


def camera(**changes: Any) -> CameraModel:
    values: dict[str, Any] = {
        "width": 640, "height": 480, "fx": 615.0, "fy": 612.0, "cx": 322.5, "cy": 237.1,
    }  # fmt: skip
    return CameraModel(**{**values, **changes})


CAMERAS = {
    "pinhole": camera(),
    "plumb_bob": camera(distortion_model="plumb_bob", distortion=PLUMB_BOB),
    "rational": camera(distortion_model="rational_polynomial", distortion=RATIONAL),
}


@pytest.mark.parametrize("name", CAMERAS)
@given(st.floats(0, 639), st.floats(0, 479), st.floats(0.1, 10))
@settings(max_examples=40, deadline=None)
def test_a_pixel_with_a_depth_comes_back_as_itself(name: str, x: float, y: float, depth: float) -> None:
    model = CAMERAS[name]
    point = model.unproject(np.array([[x, y]]), np.array([depth]))
    assert point[0, 2] == depth
    np.testing.assert_allclose(model.project(point), [[x, y]], atol=1e-6)


@pytest.mark.parametrize("name", CAMERAS)
def test_points_are_imaged_where_opencv_images_them(name: str) -> None:
    model = CAMERAS[name]
    points = np.random.default_rng(3).uniform([-0.4, -0.3, 0.8], [0.4, 0.3, 3.0], (50, 3))
    matrix = np.array([[model.fx, 0, model.cx], [0, model.fy, model.cy], [0, 0, 1]])
    truth, _ = cv2.projectPoints(points, np.zeros(3), np.zeros(3), matrix, np.array(model.distortion))
    np.testing.assert_allclose(model.project(points), truth[:, 0], atol=1e-9)


def test_the_field_of_view_spans_the_image() -> None:
    model = CameraModel.from_field_of_view(width=320, height=240, horizontal=math.radians(54.7282))
    assert model.fx == model.fy == pytest.approx(309.145, abs=1e-3)
    assert (model.cx, model.cy) == (159.5, 119.5)
    edges = model.rays(np.array([[-0.5, 119.5], [319.5, 119.5]]))[:, 0]
    assert np.degrees(np.arctan(edges[1]) - np.arctan(edges[0])) == pytest.approx(54.7282)


def test_points_that_are_not_before_the_camera_have_no_pixel() -> None:
    pixels = camera().project(np.array([[0, 0, 1.0], [0, 0, 0], [0, 0, -1], [0, 0, math.nan]]))
    assert np.isfinite(pixels).all(axis=1).tolist() == [True, False, False, False]


def test_where_a_lens_images_nothing_there_is_no_ray() -> None:
    barrel = camera(distortion_model="plumb_bob", distortion=np.array([-0.4, 0.0, 0.0, 0.0, 0.0]))
    rays = barrel.rays(np.array([[322.5, 237.1], [5000.0, 237.1]]))
    assert np.isfinite(rays[0]).all()
    assert np.isnan(rays[1, :2]).all()


def test_an_image_reaches_half_a_pixel_beyond_its_pixel_centres() -> None:
    pixels = np.array([[-0.5, 0], [-0.51, 0], [639.49, 479.49], [639.5, 0], [math.nan, 0]])
    assert camera().contains(pixels).tolist() == [True, False, True, False, False]


@pytest.mark.parametrize(
    ("changes", "code"),
    [
        ({"fx": 0.0}, "no_focal_length"),
        ({"fy": -1.0}, "no_focal_length"),
        ({"cx": math.nan}, "not_finite"),
        ({"width": 0}, "bad_size"),
        ({"distortion_model": "fisheye"}, "unknown_distortion"),
        ({"distortion_model": "plumb_bob", "distortion": np.zeros(3)}, "wrong_distortion"),
        ({"distortion_model": "plumb_bob", "distortion": np.full(5, math.nan)}, "not_finite"),
        ({"distortion": np.zeros(5)}, "wrong_distortion"),
    ],
)
def test_numbers_that_make_no_camera_are_refused(changes: dict[str, Any], code: str) -> None:
    with refused(code):
        camera(**changes)
