# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Configurations of MediaPipe's graphs: the packaged Holistic one, cut to what is asked of it.

Its detector of people is a graph of its own here: it sees everybody, of whom Holistic takes the first. The
network of the pose loses its output that draws the person's outline, which nothing here uses: the same
landmarks, to the last bit, then cost 9 ms of processor time instead of 14.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Collection, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import flatbuffers
import mediapipe
from mediapipe.calculators.core.split_vector_calculator_pb2 import SplitVectorCalculatorOptions
from mediapipe.calculators.tensor.tensors_to_detections_calculator_pb2 import (
    TensorsToDetectionsCalculatorOptions,
)
from mediapipe.calculators.util.thresholding_calculator_pb2 import ThresholdingCalculatorOptions
from mediapipe.framework import calculator_pb2
from mediapipe.framework.tool.switch_container_pb2 import SwitchContainerOptions
from mediapipe.python import Packet, ValidatedGraphConfig, packet_creator, resource_util
from mediapipe.tasks.metadata import schema_py_generated as schema

from teo_skeleton_retriever.errors import RetrieverError

# Input streams beside that of images: where somebody is who is to be followed from now on, and whether this
# is told of this image.
PERSON = "person"
PERSON_IS_TOLD = "person_is_told"
_FOLDER = Path(mediapipe.__file__).parent
_POSE = "poselandmarkcpu__"
_POSE_BY_ROI = f"{_POSE}poselandmarkbyroicpu__"
_POSE_TENSORS = f"{_POSE_BY_ROI}tensorstoposelandmarksandsegmentation__"
_DETECTION_NODE = f"{_POSE}posedetectioncpu__TensorsToDetectionsCalculator"
# Everybody who is seen, and where the network of the pose is to look for each.
PEOPLE_STREAMS = (f"{_POSE}pose_detections", "people")
_TRACKING_NODE = f"{_POSE_TENSORS}ThresholdingCalculator"
_HAND_MODEL_SWITCH = "handlandmarkmodelloader__switchcontainer"
_POSE_NETWORK = "pose_network"
# Of all outputs of the pose's network, what draws the person's outline.
_OUTLINE = (1, 256, 256, 1)
# Two more than MediaPipe takes, which is one a core: while they tell Python what they found, for which they
# may have to wait, networks go on.
_THREADS = (os.cpu_count() or 1) + 2
_SIDE_INPUTS = {
    # The only pose model that comes with the package; the two others would be downloaded.
    "model_complexity": packet_creator.create_int(1),
    # A filter over the pose makes the hands' crops trail: at 1.5 m/s the pose's wrist comes 0.2 frames
    # late with twice the error, and the hand is lost in 3 of 60 frames; without it in none.
    "smooth_landmarks": packet_creator.create_bool(False),
    "use_prev_landmarks": packet_creator.create_bool(True),
    # Gives the pupils, and finer eyes and lips, for less than a millisecond.
    "refine_face_landmarks": packet_creator.create_bool(True),
}


def holistic_configuration(
    streams: Iterable[str], *, min_tracking_confidence: float, lite_hands: bool
) -> tuple[Any, dict[str, Packet]]:
    """Configure the graph that follows one person, told where they are by the stream `PERSON`.

    Args:
        streams: Names of the output streams that will be observed.
        min_tracking_confidence: Below which a followed person counts as lost.
        lite_hands: Look at hands with the smaller of the two networks.

    Returns:
        The CalculatorGraphConfig, and the side packets that it is to be started with.
    """
    configuration = _packaged()
    for node in configuration.node:
        _rename(node.input_stream, f"{_POSE}pose_rect_from_detection", "told_person")
        if node.name == _TRACKING_NODE:
            node.options.Extensions[ThresholdingCalculatorOptions.ext].threshold = min_tracking_confidence
        elif _HAND_MODEL_SWITCH in node.name and node.calculator.startswith("Switch"):
            node.options.Extensions[SwitchContainerOptions.ext].select = 0 if lite_hands else 1
        elif node.calculator == "LandmarkProjectionCalculator":
            # The same result, and no warning that crops must be square: they are.
            node.input_stream.append(f"IMAGE_DIMENSIONS:{_POSE}image_size")
    configuration.input_stream.extend([PERSON, PERSON_IS_TOLD])
    gate = configuration.node.add(calculator="GateCalculator")
    gate.input_stream.extend([PERSON, f"ALLOW:{PERSON_IS_TOLD}"])
    gate.output_stream.append("told_person")
    configuration.num_threads = _THREADS
    _leave_out_the_outline(configuration)
    network = (_FOLDER / "modules/pose_landmark/pose_landmark_full.tflite").read_bytes()
    side_packets = _SIDE_INPUTS | {
        _POSE_NETWORK: packet_creator.create_string(without_output(network, _OUTLINE))
    }
    return only_for(configuration, streams), side_packets


def people_configuration(min_detection_confidence: float) -> tuple[Any, dict[str, Packet]]:
    """Configure the graph that finds everybody in an image; its outputs are `PEOPLE_STREAMS`.

    Args:
        min_detection_confidence: Below which a person does not count.

    Returns:
        The CalculatorGraphConfig, and the side packets that it is to be started with.
    """
    configuration = _packaged()
    detections, regions = PEOPLE_STREAMS
    for node in configuration.node:
        # In every image, not only in those in which nobody is followed.
        _rename(node.input_stream, f"{_POSE}image_for_pose_detection", "image")
        _rename(node.input_stream, f"{_POSE}image_size_for_pose_detection", f"{_POSE}image_size")
        _rename(node.output_stream, f"{_POSE}pose_rect_from_detection", regions)
        if node.name == _DETECTION_NODE:
            options = node.options.Extensions[TensorsToDetectionsCalculatorOptions.ext]
            options.min_score_thresh = min_detection_confidence
        elif node.name.startswith(f"{_POSE}posedetectiontoroi__"):
            # For each detection, not only for the first.
            for streams in (node.input_stream, node.output_stream):
                for i, entry in enumerate(streams):
                    entry = entry.replace("DETECTION:pose_detection", f"DETECTIONS:{detections}")
                    streams[i] = entry.replace("NORM_RECT:", "NORM_RECTS:")
    configuration.num_threads = 1
    return only_for(configuration, PEOPLE_STREAMS), {}


def _packaged() -> Any:
    """Read the packaged graph; without executors, which stands for threads of its own."""
    resource_util.set_resource_dir(str(_FOLDER.parent))  # the models' paths in the graph start above
    packaged = ValidatedGraphConfig()
    packaged.initialize(
        binary_graph_path=str(_FOLDER / "modules/holistic_landmark/holistic_landmark_cpu.binarypb")
    )
    configuration = calculator_pb2.CalculatorGraphConfig()
    configuration.ParseFromString(packaged.binary_config)
    del configuration.executor[:]
    return configuration


def _leave_out_the_outline(configuration: Any) -> None:
    """Remove the output of the pose network that draws the person's outline; the others keep their order."""
    nodes = {node.name: node for node in configuration.node}
    loader = nodes[f"{_POSE_BY_ROI}poselandmarkmodelloader__TfLiteModelCalculator"]
    loader.input_side_packet[:] = [f"MODEL_BLOB:{_POSE_NETWORK}"]
    configuration.input_side_packet.append(_POSE_NETWORK)
    split = nodes[f"{_POSE_TENSORS}SplitTensorVectorCalculator"]
    split.output_stream.remove(f"{_POSE_TENSORS}segmentation_tensor")
    # A range of one output for each stream, in order: without the outline there is one less.
    del split.options.Extensions[SplitVectorCalculatorOptions.ext].ranges[-1]
    gate = nodes[f"{_POSE_TENSORS}GateCalculator_1"]
    gate.input_stream.remove(f"{_POSE_TENSORS}segmentation_tensor")
    gate.output_stream.remove(f"{_POSE_TENSORS}ensured_segmentation_tensor")


def _rename(streams: Any, name: str, new: str) -> None:
    """Let a node read or write another stream under the same tag."""
    for i, entry in enumerate(streams):
        tag, colon, stream = entry.rpartition(":")
        if stream == name:
            streams[i] = f"{tag}{colon}{new}"


@contextmanager
def silenced() -> Iterator[None]:
    """Throw away what native code writes to standard error meanwhile, from whichever thread.

    For a moment only: what others write to it in the meantime is lost as well.
    """
    sys.stderr.flush()
    kept = os.dup(2)
    try:
        nowhere = os.open(os.devnull, os.O_WRONLY)
        try:
            os.dup2(nowhere, 2)
        finally:
            os.close(nowhere)
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)


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
