# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

sys.path.insert(0, str(Path(__file__).parent))  # for helpers that several tests share


@pytest.fixture
def bag(tmp_path: Path) -> Path:
    """A recording of ten images."""
    import bag_take

    return bag_take.write_ros2(tmp_path / "take", list(bag_take.messages(10)))


@pytest.fixture
def keypoints(tmp_path: Path) -> Path:
    """What OpenPose sees in it."""
    import bag_take

    return bag_take.write_keypoints(tmp_path / "keypoints", 10)


@pytest.fixture
def context(domain_id: int) -> Iterator[Any]:
    """ROS, for one test alone."""
    import rclpy  # here, as most tests do without

    context = rclpy.Context()
    rclpy.init(context=context, domain_id=domain_id)
    yield context
    rclpy.try_shutdown(context=context)


@pytest.fixture
def start(context: Any) -> Iterator[Callable[..., Any]]:
    """Starts the node, a NodeBench, with a detector that sees some people from an image on."""
    from node_bench import NodeBench, replay

    benches: list[NodeBench] = []

    def run(*people: Any, begin: int = 0, **parameters: Any) -> NodeBench:
        benches.append(NodeBench(context, replay(*people, begin=begin), **parameters))
        return benches[-1]

    yield run
    for bench in benches:
        bench.close()
