# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from teo_skeleton_retriever.compat.compat_retriever import original_parameters_from
from teo_skeleton_retriever.compat.original_skeleton import OriginalParameters
from teo_skeleton_retriever.errors import RetrieverError


def test_what_is_not_named_has_the_default_of_the_code():
    got, default = original_parameters_from([""]), OriginalParameters()
    assert got.depth_filter is not None
    assert default.depth_filter is not None
    assert vars(got.depth_filter) == vars(default.depth_filter)
    assert got.tracking_threshold == 50.0
    assert got.filter_keypoint_order == 3


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
    ],
)
def test_what_is_no_option_is_refused(code, word):
    with pytest.raises(RetrieverError) as refused:
        original_parameters_from([word])
    assert refused.value.code == code
