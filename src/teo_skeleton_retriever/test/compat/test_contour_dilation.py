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
from scipy.ndimage import minimum_filter

from teo_skeleton_retriever.compat.original_parameters import ContourDilation
from teo_skeleton_retriever.errors import RetrieverError

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


def test_the_defaults_are_the_originals() -> None:
    assert ContourDilation() == ContourDilation(
        kernel_size=4, iterations=3, min_distance=1.0, max_distance=4.0
    )


def scene() -> np.ndarray:
    """A person at 2 m with a hole, before a wall at 3.5 m; specks of noise at 0.3 m."""
    depth = np.full((60, 80), 3.5, np.float32)
    depth[20:50, 30:50] = 2.0
    depth[30:33, 38:41] = math.nan
    depth[5, 5] = 0.3
    return depth


def test_holes_in_a_person_are_filled() -> None:
    assert ContourDilation().apply(scene())[31, 39] == 2.0


def test_a_keypoint_just_beside_the_silhouette_lands_on_the_person() -> None:
    assert scene()[35, 28] == 3.5
    assert ContourDilation().apply(scene())[35, 28] == 2.0


def test_noise_before_the_nearest_distance_does_not_grow() -> None:
    assert ContourDilation().apply(scene())[5, 5] == 3.5


def test_what_is_too_far_becomes_unknown() -> None:
    filtered = ContourDilation(max_distance=3.0).apply(scene())
    assert np.isnan(filtered[0, 70])
    assert filtered[35, 40] == 2.0


@pytest.mark.parametrize("value", [0.0, math.nan])
def test_an_image_without_depth_stays_without(value: float) -> None:
    assert np.isnan(ContourDilation().apply(np.full((8, 8), value, np.float32))).all()


@pytest.mark.parametrize(
    "changes",
    [
        {"kernel_size": 0},
        {"iterations": -1},
        {"min_distance": 4.0},
        {"min_distance": math.nan},
        {"max_distance": math.nan},
    ],
)
def test_values_that_make_no_filter_are_refused(changes: dict[str, Any]) -> None:
    with pytest.raises(RetrieverError):
        ContourDilation(**changes)
