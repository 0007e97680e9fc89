# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import camera_take as take
import numpy as np
import pytest
from refusals import refused
from sensor_msgs.msg import RegionOfInterest

from teo_skeleton_retriever.camera.rgbd_image import RgbdImage, camera_of, shows_depth


def test_distortion_is_kept_and_goes_where_the_images_are_rectified():
    info = take.camera_info(0, d=[0.1, -0.2, 0.001, 0.002, 0.05])
    info.p = [250.0, 0.0, 150.0, 0.0, 0.0, 251.0, 110.0, 0.0, 0.0, 0.0, 1.0, 0.0]
    np.testing.assert_allclose(camera_of(info).distortion[:5], [0.1, -0.2, 0.001, 0.002, 0.05])
    rectified = camera_of(info, rectified=True)
    assert (rectified.fx, rectified.fy, rectified.cx, rectified.cy) == (250.0, 251.0, 150.0, 110.0)
    assert not rectified.distortion.any()


def test_a_model_that_is_not_known_does_not_matter_without_coefficients():
    assert camera_of(take.camera_info(0, distortion_model="none")).fx == 300.0
    with refused("unknown_distortion"):
        camera_of(take.camera_info(0, distortion_model="fisheye", d=[0.1, 0.0, 0.0, 0.0]))


def test_a_region_and_binning_move_and_scale_the_image():
    info = take.camera_info(0, binning_x=2, binning_y=2)
    info.roi = RegionOfInterest(x_offset=20, y_offset=40, width=160, height=120)
    camera = camera_of(info)
    assert (camera.width, camera.height) == (80, 60)
    point = np.array([[0.1, -0.2, 2.0]])
    whole = camera_of(take.camera_info(0)).project(point)
    np.testing.assert_allclose(camera.project(point), (whole - [20, 40]) / 2)


def test_colour_and_depth_are_told_apart():
    assert shows_depth(take.depth_message(0))
    assert shows_depth(take.compressed_depth(0))
    assert shows_depth(take.color_message(0)) is False
    assert shows_depth(take.compressed_color(0)) is False
    assert shows_depth(take.color_message(0, encoding="bayer_grbg8")) is None


@pytest.mark.parametrize(("code", "depth", "camera"), [("depth_size", 2, 1), ("camera_info_size", 1, 2)])
def test_depth_and_camera_of_another_size_than_colour_are_refused(code: str, depth: int, camera: int):
    with refused(code):
        RgbdImage(stamp=0.0, color=take.color(), depth=take.depth(depth), camera=take.camera(camera))
