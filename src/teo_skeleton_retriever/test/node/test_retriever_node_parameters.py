# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the node lets itself be told."""

from __future__ import annotations

from typing import Any

import camera_take as take
import numpy as np
import pytest
from rclpy.parameter import Parameter

from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.node.node_parameters import PARAMETERS
from teo_skeleton_retriever.node.retriever_node import RetrieverNode


def test_images_between_periods_are_left_out(start):
    bench = start(take.person(), period=0.1)
    bench.send_until(lambda: len(bench.arrays) > 3)
    stamps = np.array([m.header.stamp.sec + m.header.stamp.nanosec * 1e-9 for m in bench.arrays])
    assert np.diff(stamps).min() >= 0.1 - 1e-6


def test_every_parameter_has_a_description_and_a_range_and_wrong_values_are_refused(start):
    bench = start()
    for row in PARAMETERS:
        descriptor = bench.node.describe_parameter(row.name)
        assert descriptor.description
        value = bench.node.get_parameter(row.name).value
        assert (tuple(value) if isinstance(value, list) else value) == row.default
        if isinstance(row.default, float) or type(row.default) is int:
            assert len(descriptor.integer_range) + len(descriptor.floating_point_range) == 1

    def set_to(name: str, value: Any) -> bool:
        return bool(bench.node.set_parameters([Parameter(name, value=value)])[0].successful)

    assert not set_to("slop", 0.1)  # read-only
    assert not set_to("signer_rule", "tallest")
    assert not set_to("min_confidence", 1.5)
    assert not set_to("max_depth", 0.2)  # not above min_depth
    assert set_to("signer_rule", "central")
    assert set_to("period", 0.05)


@pytest.mark.parametrize(
    ("name", "value", "code"),
    [
        ("compat", "other", "unknown_choice"),
        ("detector", "guess", "unknown_choice"),
        ("detector_options", ["folder"], "bad_option"),
        ("detector_options", ["=x"], "bad_option"),
    ],
)
def test_a_wrong_parameter_stops_the_start_with_its_reason(context, name, value, code):
    with pytest.raises(RetrieverError) as refused:
        RetrieverNode(context=context, parameter_overrides=[Parameter(name, value=value)])
    assert refused.value.code == code
