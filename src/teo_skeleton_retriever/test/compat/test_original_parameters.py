# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from refusals import refused
from scipy.ndimage import minimum_filter

from teo_skeleton_retriever.compat.compat_retriever import original_parameters_from
from teo_skeleton_retriever.compat.original_skeleton import ContourDilation


def test_the_shipped_configuration_can_be_given_by_its_own_names():
    got = original_parameters_from(
        [
            "skeleton::keys-acceptable-misses=10",
            "skeleton::tracking-threshold=200",
            "skeleton::time-to-live=3.0",
            "depth::kernel-size=8",
            "depth::iterations = 2",
            "depth::min-distance=0.6",
            "filtering::filter-keypoint-order=12",
            "filtering::optimize-limblength=false",
        ]
    )
    assert (got.keys_acceptable_misses, got.tracking_threshold, got.time_to_live) == (10, 200.0, 3.0)
    assert (got.filter_keypoint_order, got.optimize_limblength) == (12, False)
    assert got.depth_filter is not None
    assert original_parameters_from(["depth::enable=false"]).depth_filter is None


@pytest.mark.parametrize(
    ("code", "word"),
    [
        ("unknown_compat_option", "filter-keypoint-order=8"),  # the original ignores it without its group
        ("unknown_compat_option", "nonsense"),
        ("wrong_type", "filtering::filter-keypoint-order=many"),
        ("wrong_type", "depth::enable=perhaps"),
        ("out_of_range", "skeleton::time-to-live=-1"),
        ("out_of_range", "skeleton::time-to-live=nan"),
        ("out_of_range", "depth::kernel-size=0"),
        ("out_of_range", "depth::iterations=-1"),
        ("out_of_range", "depth::min-distance=nan"),
    ],
)
def test_what_is_no_option_is_refused(code, word):
    with refused(code):
        original_parameters_from([word])


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
