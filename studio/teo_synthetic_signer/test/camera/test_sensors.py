# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import numpy as np
import pytest

from teo_synthetic_signer.camera.sensors import SENSORS, DepthModel, Principle, sensor

SIZE, WALL = (640, 480), (320, 240)


def measured(name: str, depth: np.ndarray | float, cosine: float = 1.0) -> np.ndarray:
    """What a sensor gives for a depth image, or for a wall; the cosine says how it faces the sensor."""
    device = sensor(name)
    camera = device.camera(*(WALL if np.ndim(depth) == 0 else SIZE))
    there = np.broadcast_to(np.float32(depth), (camera.height, camera.width)).astype(np.float32)
    model = DepthModel(device, camera, np.random.default_rng(0))
    return model.measure(there, np.full_like(there, cosine))


@pytest.mark.parametrize(
    ("name", "distance"),
    [(name, z) for name in SENSORS for z in (0.8, 2.5) if SENSORS[name].nearest < z < SENSORS[name].farthest],
)
def test_noise_on_a_wall_has_the_stated_size(name: str, distance: float) -> None:
    device = sensor(name)
    depth = measured(name, distance)
    steps = [device.step]
    if device.disparity_step:
        steps.append(distance**2 * device.disparity_step / (device.depth_focal * device.baseline))
    expected = math.hypot(device.sigma(distance), *(step / math.sqrt(12.0) for step in steps))
    assert float(np.nanstd(depth)) == pytest.approx(expected, rel=0.12)
    assert float(np.nanmean(depth)) == pytest.approx(distance, abs=0.5 * expected)


@pytest.mark.parametrize(("name", "ratio"), [("d435", 4.0), ("xtion", 4.0), ("kinect2", 2.0)])
def test_noise_grows_with_the_square_of_the_distance_or_for_time_of_flight_with_the_distance(
    name: str, ratio: float
) -> None:
    near, far = (np.nanstd(measured(name, z)) for z in (1.2, 2.4))
    assert far / near == pytest.approx(ratio, rel=0.12)


def test_kinect_1_has_the_published_errors_and_steps() -> None:
    # Khoshelham and Elberink 2012: standard deviation 1.5 cm and resolution 2.5 cm at 3 m, within rounding.
    device = sensor("kinect1")
    assert device.sigma(3.0) == pytest.approx(0.0129, abs=0.002)
    values = np.unique(measured("kinect1", 3.0))
    assert np.median(np.diff(values[np.isfinite(values)])) == pytest.approx(0.0256, abs=0.004)


@pytest.mark.parametrize("name", SENSORS)
def test_nothing_is_given_outside_the_range_or_of_grazing_surfaces_and_good_ones_have_few_holes(
    name: str,
) -> None:
    device = sensor(name)
    distance = min(1.2, 0.8 * device.farthest)
    assert np.isnan(measured(name, device.nearest * 0.8)).all()
    assert np.isnan(measured(name, device.farthest * 1.3)).mean() > 0.99
    assert np.isnan(measured(name, math.inf)).all()
    assert np.isnan(measured(name, distance, cosine=0.01)).all()
    assert 0.2 * device.dropout < np.isnan(measured(name, distance)).mean() < 3.0 * device.dropout


def board(near: float, far: float) -> np.ndarray:
    depth = np.full((SIZE[1], SIZE[0]), far, dtype=np.float32)
    depth[:, 250:400] = near
    return depth


def test_a_board_throws_a_shadow_as_wide_as_the_parallax_on_the_side_away_from_the_second_eye() -> None:
    device = sensor("d435")
    camera = device.camera(*SIZE)
    near, far = 1.0, 2.0
    depth = measured("d435", board(near, far))
    rows = slice(100, 380)
    lost_left = np.isnan(depth[rows, 200:250]).sum(axis=1).mean()
    lost_right = np.isnan(depth[rows, 403:450]).sum(axis=1).mean()
    expected = camera.fx * device.baseline * (1.0 / near - 1.0 / far)
    assert lost_left == pytest.approx(expected, abs=3.5)
    assert lost_right < 2.0


def test_time_of_flight_has_no_shadow_and_flying_pixels_between_both_depths() -> None:
    assert sensor("kinect2").principle is Principle.TIME_OF_FLIGHT
    depth = measured("kinect2", board(1.0, 2.0))
    assert np.isnan(depth[:, 200:245]).mean() < 0.02
    edge = depth[:, 246:254]
    assert ((edge > 1.1) & (edge < 1.9)).mean() > 0.03
    assert not ((depth[:, 280:380] > 1.1) & (depth[:, 280:380] < 1.9)).any()


@pytest.mark.parametrize(
    ("name", "size", "view"),
    [
        ("sr300", (1920, 1440), (73.0, None)),
        ("d435", (1920, 1080), (69.4, 42.5)),
        ("kinect1", (640, 480), (57.0, 43.0)),
        ("xtion", (1280, 1024), (58.0, 47.0)),
    ],
)
def test_the_camera_sees_the_angle_of_the_table(
    name: str, size: tuple[int, int], view: tuple[float, float | None]
) -> None:
    camera = sensor(name).camera(*size)
    for pixels, focal, angle in ((size[0], camera.fx, view[0]), (size[1], camera.fy, view[1])):
        if angle is not None:
            assert np.degrees(2.0 * math.atan(pixels / 2.0 / focal)) == pytest.approx(angle, abs=1.6)
    # realsense2_camera gives 640x480 colour of the D435, a narrower picture, a focal length of 600 to 620 px.
    assert 600.0 < sensor("D435").camera(640, 480).fx < 625.0
