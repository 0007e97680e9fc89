# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A graph keeps what its streams follow from, and nothing else."""

from __future__ import annotations

import pytest
from google.protobuf import text_format
from mediapipe.framework import calculator_pb2

from teo_skeleton_retriever.detectors.mediapipe.holistic_configuration import only_for
from teo_skeleton_retriever.errors import RetrieverError

GRAPH = """
    input_stream: "image"
    input_side_packet: "SIZE:size"
    input_side_packet: "SPEED:speed"
    output_stream: "FACE:face"
    node { calculator: "Crop" input_stream: "IMAGE:image" input_stream: "before" output_stream: "crop"
           input_side_packet: "SIZE:size" }
    node { calculator: "Previous" input_stream: "LOOP:hand" output_stream: "PREVIOUS:before" }
    node { calculator: "Hand" input_stream: "crop" output_stream: "HAND:hand" output_stream: "side"
           input_side_packet: "MODEL:model" }
    node { calculator: "Model" output_side_packet: "MODEL:model" }
    node { calculator: "Face" input_stream: "image" output_stream: "FACE:face" input_side_packet: "speed" }
    node { calculator: "Smile" input_stream: "FACE:face" output_stream: "smile" }
"""


def graph() -> calculator_pb2.CalculatorGraphConfig:
    return text_format.Parse(GRAPH, calculator_pb2.CalculatorGraphConfig())


@pytest.mark.parametrize(
    ("streams", "nodes", "side_packets"),
    [
        (["side"], ["Crop", "Previous", "Hand", "Model"], ["SIZE:size"]),  # round the loop
        (["face"], ["Face"], ["SPEED:speed"]),
        (
            ["crop", "smile"],
            ["Crop", "Previous", "Hand", "Model", "Face", "Smile"],
            ["SIZE:size", "SPEED:speed"],
        ),
        ([], [], []),
    ],
)
def test_what_a_stream_follows_from_stays(
    streams: list[str], nodes: list[str], side_packets: list[str]
) -> None:
    pruned = only_for(graph(), streams)
    assert [node.calculator for node in pruned.node] == nodes
    assert list(pruned.input_side_packet) == side_packets
    assert list(pruned.input_stream) == ["image"]
    assert list(pruned.output_stream) == []


def test_the_graph_that_was_given_stays_whole() -> None:
    whole = graph()
    only_for(whole, ["face"])
    assert whole == graph()


def test_a_stream_that_nothing_gives_is_named() -> None:
    with pytest.raises(RetrieverError, match="tail") as caught:
        only_for(graph(), ["face", "tail"])
    assert caught.value.code == "bad_graph"
