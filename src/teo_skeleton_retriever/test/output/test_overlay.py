# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import camera_take as take
import numpy as np
import pytest

from teo_skeleton_retriever.camera.rgbd_image import RgbdImage
from teo_skeleton_retriever.image_retriever import Retrieved
from teo_skeleton_retriever.layouts.skeleton_3d import SKELETON_PARTS, Keypoints3D, KeypointStatus, Skeleton
from teo_skeleton_retriever.output.overlay import STATUS_COLORS, Overlay


def image(scale: int = 1, stamp: float = 1.0) -> RgbdImage:
    grey = np.full((take.HEIGHT * scale, take.WIDTH * scale, 3), 90, dtype=np.uint8)
    return RgbdImage(stamp=stamp, color=grey, depth=take.depth(scale), camera=take.camera(scale))


def person(status: KeypointStatus, place: float = 0.0, is_signer: bool = True) -> Skeleton:
    """Two shoulders and a neck a metre and a half away."""
    body = Keypoints3D.lost(25)
    points, statuses, pixels = body.points.copy(), body.status.copy(), body.pixels.copy()
    for i, x in ((1, 0.0), (2, -0.3), (5, 0.3)):
        points[i], statuses[i] = (x + place, 0.0, 1.5), status
    if status is KeypointStatus.LOST:
        points[:] = np.nan
        pixels[1] = (100.0, 100.0)
    body = Keypoints3D(
        points=points, confidence=np.zeros(25), status=statuses, sigma=body.sigma, pixels=pixels
    )
    others = {
        part: Keypoints3D.lost(len(layout)) for part, layout in SKELETON_PARTS.items() if part != "body"
    }
    return Skeleton(track_id=4, is_signer=is_signer, body=body, body_frame=None, **others)


def drawn(*skeletons: Skeleton, scale: int = 1) -> np.ndarray:
    result = Retrieved((), skeletons, 1.0, 1.5, 0.02, 0.003)
    return Overlay().draw(image(scale), result)


def close_to(picture: np.ndarray, color: tuple[int, int, int]) -> np.ndarray:
    return np.abs(picture.astype(int) - color).max(axis=2) < 25


@pytest.mark.parametrize("status", [KeypointStatus.MEASURED, KeypointStatus.OPTIMISED, KeypointStatus.HELD])
def test_bones_have_the_colour_of_their_status_where_the_camera_images_them(status):
    found = close_to(drawn(person(status), scale=2), STATUS_COLORS[status])
    # From 0.3 m left to 0.3 m right at 1.5 m: 120 px to each side of the middle, at half the height.
    row = found[239]
    lined = row[200:438].mean()
    assert 0.3 < lined < 0.9 if status is KeypointStatus.HELD else lined > 0.9  # dashed where it is held
    assert not row[:190].any()
    assert not row[450:].any()


def test_the_signer_is_lined_in_white_and_others_are_not():
    white = (255, 255, 255)
    beside = (slice(113, 126), slice(100, 219))
    signer = close_to(drawn(person(KeypointStatus.MEASURED))[beside], white)
    other = close_to(drawn(person(KeypointStatus.MEASURED, is_signer=False))[beside], white)
    assert signer.sum() > 100
    assert other.sum() == 0


def test_a_keypoint_without_a_place_is_crossed_where_the_detector_saw_it():
    found = close_to(drawn(person(KeypointStatus.LOST)), STATUS_COLORS[KeypointStatus.LOST])
    assert found[98:103, 98:103].any()


def test_depth_is_shown_in_the_corner_with_holes_dark():
    holes = take.depth()
    holes[:, :] = np.nan
    blind = RgbdImage(stamp=1.0, color=image().color, depth=holes, camera=take.camera())
    corner = (slice(175, 200), slice(235, 300))
    assert Overlay().draw(blind, Retrieved((), (), 0.0, float("nan"), 0.0, 0.0))[corner].max() < 60
    seen = drawn()[corner]
    assert seen.max() > 100


def test_people_outside_the_picture_and_half_in_it_are_drawn_without_trouble():
    for place in (-500.0, -0.9, 0.9, 500.0):
        assert drawn(person(KeypointStatus.MEASURED, place)).shape == (take.HEIGHT, take.WIDTH, 3)
