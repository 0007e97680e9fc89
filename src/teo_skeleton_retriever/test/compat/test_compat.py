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
from hypothesis.extra.numpy import arrays
from refusals import refused
from scipy.ndimage import minimum_filter

from teo_skeleton_retriever.camera.camera_model import CameraModel
from teo_skeleton_retriever.compat.original_retriever import OriginalRetriever
from teo_skeleton_retriever.compat.original_skeleton import (
    SKELETON_STD,
    ContourDilation,
    OriginalParameters,
    OriginalSkeleton,
    detect,
    is_valid,
)
from teo_skeleton_retriever.layouts.layout import BODY_25, COCO_18
from teo_skeleton_retriever.layouts.person_2d import Person2D

CAMERA = CameraModel.from_field_of_view(width=320, height=240, horizontal=math.radians(55))
PARAMETERS = OriginalParameters(depth_filter=None)
INDEX = SKELETON_STD.index
# Someone upright at 2 m [m], in the camera's frame.
BODY = {
    "Nose": (0.0, -0.5), "Neck": (0.0, -0.3), "MidHip": (0.0, 0.2),
    "LShoulder": (0.2, -0.3), "LElbow": (0.3, -0.05), "LWrist": (0.35, 0.15),
    "RShoulder": (-0.2, -0.3), "RElbow": (-0.3, -0.05), "RWrist": (-0.35, 0.15),
    "LHip": (0.1, 0.2), "RHip": (-0.1, 0.2), "LKnee": (0.1, 0.55), "RKnee": (-0.1, 0.55),
    "LSmallToe": (0.15, 0.7), "RBigToe": (-0.15, 0.7), "RSmallToe": (-0.2, 0.7),
}  # fmt: skip


def person(shift: float = 0.0, without: tuple[str, ...] = (), confidence: float = 0.9) -> Person2D:
    """The person, moved sideways [m], as OpenPose sees them."""
    body = np.zeros((25, 3))
    for name, (x, y) in BODY.items():
        if name not in without:
            body[BODY_25.index[name]] = [*CAMERA.project(np.array([[x + shift, y, 2.0]]))[0], confidence]
    return Person2D(body=body)


def flat(depth: float = 2.0) -> np.ndarray:
    return np.full((240, 320), depth, np.float32)


def seen(someone: Person2D, depth: np.ndarray | None = None) -> OriginalSkeleton:
    return detect(someone, flat() if depth is None else depth, CAMERA, PARAMETERS)


def updated(skeleton: OriginalSkeleton) -> set[str]:
    return {tag for tag in INDEX if skeleton.updated[INDEX[tag]]}


def test_keypoints_are_put_in_space_under_the_originals_names() -> None:
    skeleton = seen(person())
    assert updated(skeleton) == set(INDEX) - {"ankleLeft", "ankleRight"}
    # Pixels are cut to whole ones: up to one pixel is lost, 7 mm here.
    np.testing.assert_allclose(skeleton.points[INDEX["handLeft"]], [0.35, 0.15, 2.0], atol=0.008)
    assert (skeleton.pixels[INDEX["handLeft"]] % 1.0 == 0.0).all()


def test_centres_that_are_not_seen_are_put_between_two_without_a_pixel() -> None:
    skeleton = seen(person(without=("Neck",)))
    assert skeleton.points[INDEX["shoulderCenter"]] == pytest.approx([0.0, -0.3, 2.0], abs=0.008)
    assert np.isnan(skeleton.pixels[INDEX["shoulderCenter"]]).all()
    assert np.isinf(skeleton.pivots()[0]).all()


@pytest.mark.parametrize("value", [0.0, math.nan])
def test_without_depth_or_confidence_nothing_is_seen(value: float) -> None:
    assert updated(seen(person(), np.full((240, 320), value, np.float32))) == set()
    assert updated(seen(person(confidence=0.29))) == set()
    assert updated(seen(Person2D())) == set()


def test_with_coco_the_hip_centre_is_put_between_the_hips_in_space() -> None:
    body = person().body
    coco = Person2D(body=np.array([body[BODY_25.index[name]] for name in COCO_18.keypoints]))
    skeleton = seen(coco)
    hips = skeleton.points[[INDEX["hipLeft"], INDEX["hipRight"]]]
    np.testing.assert_array_equal(skeleton.points[INDEX["hipCenter"]], hips.mean(axis=0))
    assert np.isnan(skeleton.pixels[INDEX["hipCenter"]]).all()
    assert is_valid(skeleton, PARAMETERS)


def test_a_body_in_a_layout_that_is_not_known_is_refused() -> None:
    with refused("wrong_layout"):
        seen(Person2D(body=np.ones((15, 3))))


@pytest.mark.parametrize(
    ("without", "valid"),
    [
        ((), True),
        (("Neck",), True),
        (("Neck", "MidHip"), False),  # the midpoints that stand in are no pivots
        (tuple(name for name in BODY if name not in ("Neck", "Nose", "MidHip", "LHip")), False),  # 4 of 17
    ],
)
def test_who_is_a_person_is_decided_as_in_the_original(without: tuple[str, ...], valid: bool) -> None:
    assert is_valid(seen(person(without=without)), PARAMETERS) is valid


def retriever(**changes: Any) -> OriginalRetriever:
    parameters = OriginalParameters(**{"depth_filter": None, **changes})
    return OriginalRetriever(CAMERA, parameters)


def test_a_keypoint_is_held_for_some_images_then_stale() -> None:
    original = retriever(keys_acceptable_misses=2)
    original.step(0.0, [person()], flat())
    states = [
        original.step(0.1 * i, [person(without=("LWrist",))], flat())[0].updated[INDEX["handLeft"]]
        for i in range(1, 5)
    ]
    assert states == [True, True, False, False]


def test_points_are_frozen_for_three_images_then_the_median_of_four() -> None:
    original = retriever()
    depths = [2.0, 2.1, 2.2, 2.3, 2.4]
    heads = [
        original.step(0.1 * i, [person()], flat(depth))[0].points[INDEX["head"], 2]
        for i, depth in enumerate(depths)
    ]
    np.testing.assert_allclose(heads, [2.0, 2.0, 2.0, 2.15, 2.25], atol=1e-6)


def test_a_jump_beyond_the_threshold_is_someone_else() -> None:
    original = retriever()
    original.step(0.0, [person(-0.5)], flat())
    assert set(original.step(0.1, [person(0.5)], flat())) == {0, 1}


def test_someone_not_seen_is_forgotten_after_their_time_to_live() -> None:
    original = retriever()
    original.step(0.0, [person()], flat())
    assert set(original.step(0.9, [], flat())) == {0}
    assert set(original.step(1.0, [], flat())) == set()
    assert set(original.step(1.1, [person()], flat())) == {1}


images = arrays(
    np.float32,
    st.tuples(st.integers(1, 14), st.integers(1, 14)),
    elements=st.one_of(st.floats(0, 6, width=32), st.just(math.nan)),
)


def described(depth: np.ndarray, dilation: ContourDilation) -> np.ndarray:
    """The filter in the words of its description, with another library's minimum filter."""
    near = np.where(np.nan_to_num(depth, nan=0.0) >= np.float32(dilation.min_distance), depth, np.inf)
    size = dilation.kernel_size
    window = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (size, size)).astype(bool)
    for _ in range(dilation.iterations):
        near = minimum_filter(near, footprint=window, mode="constant", cval=np.inf)
    return np.where((near <= np.float32(dilation.max_distance)) & (near > 0), near, math.nan)


@given(images, st.integers(1, 6), st.integers(0, 3))
@settings(max_examples=60, deadline=None)
def test_it_is_an_elliptical_minimum_filter_between_two_distances(
    depth: np.ndarray, kernel: int, iterations: int
) -> None:
    dilation = ContourDilation(kernel_size=kernel, iterations=iterations)
    np.testing.assert_array_equal(dilation.apply(depth), described(depth, dilation).astype(np.float32))
