# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Graphs and networks of MediaPipe without the parts that do not feed the outputs in use.

MediaPipe's network of the pose also draws the person's outline, at the full resolution of its input. Nothing
here uses it, but TensorFlow Lite computes every output: without it the same landmarks, to the last bit, cost
9 ms of processor time instead of 14.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from typing import Any

import flatbuffers
from mediapipe.tasks.metadata import schema_py_generated as schema

from teo_skeleton_retriever.errors import RetrieverError


def only_for(configuration: Any, streams: Iterable[str]) -> Any:
    """Drop nodes of a graph that do not feed some streams.

    A node costs some microseconds in each image also where it has nothing to do.

    Args:
        configuration: A CalculatorGraphConfig without subgraphs.
        streams: By name.

    Returns:
        A new one, with the nodes in their order and without outputs: its streams are to be observed.

    Raises:
        RetrieverError: Nothing gives one of the streams.
    """
    wanted = set(streams)
    needed: set[int] = set()
    while more := {
        i
        for i, node in enumerate(configuration.node)
        if i not in needed and wanted & _names(node.output_stream, node.output_side_packet)
    }:
        needed |= more
        for i in more:
            node = configuration.node[i]
            wanted |= _names(node.input_stream, node.input_side_packet)
    given = _names(configuration.input_stream, configuration.input_side_packet)
    for i in needed:
        node = configuration.node[i]
        given |= _names(node.output_stream, node.output_side_packet)
    if missing := wanted - given:
        raise RetrieverError(
            "bad_graph", f"expected a graph that gives {sorted(missing)}, got one that does not"
        )
    pruned = type(configuration)()
    pruned.CopyFrom(configuration)
    del pruned.node[:], pruned.output_stream[:], pruned.input_side_packet[:]
    pruned.node.extend(configuration.node[i] for i in sorted(needed))
    pruned.input_side_packet.extend(
        packet for packet in configuration.input_side_packet if _names([packet]) & wanted
    )
    return pruned


def _names(*lists: Iterable[str]) -> set[str]:
    """Names of streams or side packets without the tags before them."""
    return {entry.rpartition(":")[2] for entries in lists for entry in entries}


# What a TensorFlow Lite file begins with, after the place of its root.
_IDENTIFIER = b"TFL3"


def without_output(network: bytes, shape: tuple[int, ...]) -> bytes:
    """Remove one output of a network and the layers that feed only it.

    Args:
        network: Content of a TensorFlow Lite file with one graph.
        shape: Of the output.

    Returns:
        The same, with the other outputs in their order.

    Raises:
        RetrieverError: It is no such file, or not exactly one of its outputs has this shape.
    """
    if network[4:8] != _IDENTIFIER:
        raise RetrieverError(
            "bad_network", f"expected a TensorFlow Lite file, got one that begins with {network[:8]!r}"
        )
    model = schema.ModelT.InitFromObj(schema.Model.GetRootAs(network, 0))
    (graph,) = model.subgraphs
    shapes = {output: tuple(int(n) for n in graph.tensors[output].shape) for output in graph.outputs}
    if list(shapes.values()).count(shape) != 1:
        raise RetrieverError(
            "bad_network", f"expected one output of shape {shape}, got outputs of {list(shapes.values())}"
        )
    graph.outputs = [output for output in graph.outputs if shapes[output] != shape]
    graph.operators = _needed(graph.operators, graph.outputs)
    model.signatureDefs = None  # name outputs for interpreters other than MediaPipe's
    builder = flatbuffers.Builder(len(network))
    builder.Finish(model.Pack(builder), _IDENTIFIER)
    return bytes(builder.Output())


def _needed(operators: list[Any], outputs: Collection[int]) -> list[Any]:
    """Operators that feed the outputs, in their order, in which each comes after those it reads from."""
    read = set(outputs)
    needed = []
    for operator in reversed(operators):
        if not read.isdisjoint(operator.outputs):
            read.update(operator.inputs)
            needed.append(operator)
    return needed[::-1]
