# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import gzip
import re
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest

from teo_skeleton_retriever.compat.original_skeleton import SKELETON_STD

sys.path.insert(0, str(Path(__file__).parent))  # for helpers that several tests share

# The original's output on a recording of its own (test/data/README.md).
RECORDING = Path(__file__).parent / "data" / "skeleton_retriever_abduction_left.log.gz"
TOKEN = re.compile(r'\(|\)|"[^"]*"|[^\s()]+')


class Recording(NamedTuple):
    """What the original published, n times."""

    points: np.ndarray  # (n, 17, 3) [m]
    pixels: np.ndarray  # (n, 17, 2) [px]
    updated: np.ndarray  # (n, 17)
    sagittal: np.ndarray  # (n, 3)
    transverse: np.ndarray  # (n, 3)
    coronal: np.ndarray  # (n, 3)


def parse(line: str) -> list[Any]:
    """Read a line of nested lists."""
    stack: list[list[Any]] = [[]]
    for token in TOKEN.findall(line):
        if token == "(":
            stack.append([])
        elif token == ")":
            inner = stack.pop()
            stack[-1].append(inner)
        else:
            stack[-1].append(value(token))
    assert len(stack) == 1
    return stack[0]


def value(token: str) -> float | str:
    try:
        return float("nan" if token == "nan.0" else token)
    except ValueError:
        return token.strip('"')


def fields(pairs: list[Any]) -> dict[str, Any]:
    """A list of (key value) or (key value value ...)."""
    return {pair[0]: pair[1] if len(pair) == 2 else pair[1:] for pair in pairs}


def keypoints(tree: list[Any]) -> dict[str, dict[str, Any]]:
    found: dict[str, dict[str, Any]] = {}
    for node in map(fields, tree):
        found[node["tag"]] = node
        found |= keypoints(node.get("child", []))
    return found


@pytest.fixture(scope="session")
def recording() -> Recording:
    skeletons = [
        fields(parse(line)[3]) for line in gzip.decompress(RECORDING.read_bytes()).decode().splitlines()
    ]
    people = [keypoints(skeleton["skeleton"]) for skeleton in skeletons]
    columns = [
        np.array([[person[tag][key] for tag in SKELETON_STD.keypoints] for person in people])
        for key in ("position", "pixel", "status")
    ]
    planes = [
        np.array([skeleton[key] for skeleton in skeletons]) for key in ("sagittal", "transverse", "coronal")
    ]
    return Recording(columns[0], columns[1], columns[2] == "updated", *planes)


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
