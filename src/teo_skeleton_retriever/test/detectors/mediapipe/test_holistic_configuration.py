# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from pathlib import Path
from typing import Any

import mediapipe
import pytest
from mediapipe.tasks.metadata import schema_py_generated as schema
from refusals import refused

from teo_skeleton_retriever.detectors.mediapipe.holistic_configuration import without_output
from teo_skeleton_retriever.errors import RetrieverError

OUTLINE = (1, 256, 256, 1)


@pytest.fixture(scope="module")
def pose() -> bytes:
    return (Path(mediapipe.__file__).parent / "modules/pose_landmark/pose_landmark_full.tflite").read_bytes()


def graph_of(network: bytes) -> Any:
    return schema.Model.GetRootAs(network, 0).Subgraphs(0)


def outputs(network: bytes) -> list[tuple[int, ...]]:
    graph = graph_of(network)
    return [tuple(graph.Tensors(graph.Outputs(i)).ShapeAsNumpy()) for i in range(graph.OutputsLength())]


def test_the_other_outputs_stay_in_order_and_only_layers_that_they_need(pose: bytes) -> None:
    pruned = without_output(pose, OUTLINE)
    assert outputs(pruned) == [shape for shape in outputs(pose) if shape != OUTLINE]
    assert outputs(pruned) == [(1, 195), (1, 1), (1, 64, 64, 39), (1, 117)]
    graph = graph_of(pruned)
    layers = [graph.Operators(i) for i in range(graph.OperatorsLength())]
    read = {graph.Outputs(i) for i in range(graph.OutputsLength())}.union(
        *(x.InputsAsNumpy() for x in layers)
    )
    assert len(layers) < graph_of(pose).OperatorsLength()
    assert read.issuperset(tensor for layer in layers for tensor in layer.OutputsAsNumpy())


def test_an_output_that_is_not_there_or_not_the_only_one_is_refused(pose: bytes) -> None:
    for shape in ((1, 2, 3), ()):
        with pytest.raises(RetrieverError, match="195"):
            without_output(pose, shape)
    hand = (Path(mediapipe.__file__).parent / "modules/hand_landmark/hand_landmark_full.tflite").read_bytes()
    with pytest.raises(RetrieverError, match="63"):
        without_output(hand, (1, 63))  # landmarks in the image and in space


@pytest.mark.parametrize("content", [b"", b"TFL3", b"\0" * 100])
def test_what_is_no_network_is_refused(content: bytes) -> None:
    with refused("bad_network"):
        without_output(content, OUTLINE)
