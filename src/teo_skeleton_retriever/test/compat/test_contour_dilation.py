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

from teo_skeleton_retriever.compat.original_skeleton import ContourDilation
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
