# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from pathlib import Path
from typing import Any

import cv2
import numpy as np
import onnx
import pytest
from drawn_maps import STRIDE, draw, person
from onnx import TensorProto, helper, numpy_helper
from refusals import refused

from teo_skeleton_retriever.detectors.openpose_onnx_detector import OpenPoseOnnxDetector
from teo_skeleton_retriever.detectors.part_affinity import BODY_25_MODEL, COCO_18_MODEL, PafModel
from teo_skeleton_retriever.layouts.layout import BODY_25

NET = (320, 240)


def save_network(path: Path, weights: np.ndarray, constants: list[np.ndarray], size: Any = NET) -> Path:
    """One image in, for each constant an output: the constant plus weights times the mean of 8 x 8 pixels.

    Args:
        weights: of blue, green, red; shape (channels, 3); applied to the first output.
        constants: shape (channels, rows, columns), or (channels, 1, 1) for any size.
    """
    nodes = [helper.make_node("AveragePool", ["image"], ["mean"], kernel_shape=[8, 8], strides=[8, 8])]
    initializers, outputs = [], []
    for i, constant in enumerate(constants):
        kernel = weights if i == 0 else np.zeros((len(constant), 3))
        initializers += [
            numpy_helper.from_array(kernel.astype(np.float32)[:, :, None, None], f"weights{i}"),
            numpy_helper.from_array(constant.astype(np.float32)[None], f"constant{i}"),
        ]
        nodes += [
            helper.make_node("Conv", ["mean", f"weights{i}"], [f"product{i}"]),
            helper.make_node("Add", [f"product{i}", f"constant{i}"], [f"output{i}"]),
        ]
        shape = [1, len(constant), None, None]
        outputs.append(helper.make_tensor_value_info(f"output{i}", TensorProto.FLOAT, shape))
    width, height = size
    image = helper.make_tensor_value_info("image", TensorProto.FLOAT, [1, 3, height, width])
    graph = helper.make_graph(nodes, "network", [image], outputs, initializers)
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 13)], ir_version=8)
    onnx.checker.check_model(model)
    onnx.save(model, str(path))
    return path


def given_maps(
    path: Path, people: list[np.ndarray], model: PafModel = BODY_25_MODEL, split: bool = False
) -> Path:
    """A network that gives the maps of these people, whatever it is shown."""
    maps, fields = draw(people, NET, model)
    with_background = np.concatenate([maps, 1.0 - maps.max(axis=0, keepdims=True)])
    constants = [with_background, fields] if split else [np.concatenate([with_background, fields])]
    return save_network(path, np.zeros((len(constants[0]), 3)), constants)


@pytest.mark.parametrize(
    ("model", "split"),
    [(BODY_25_MODEL, False), (BODY_25_MODEL, True), (COCO_18_MODEL, False)],
    ids=["one output", "two outputs", "COCO"],
)
def test_people_are_given_in_pixels_of_the_image_as_body_25(
    tmp_path: Path, model: PafModel, split: bool
) -> None:
    drawn = [person(90, 60, 170, model), person(220, 55, 180, model)]
    detector = OpenPoseOnnxDetector(
        model=given_maps(tmp_path / "a.onnx", drawn, model, split), net_resolution=NET
    )
    found = sorted(detector.detect(np.zeros((480, 640, 3), np.uint8), 0.0), key=lambda p: p.body[0, 0])
    assert len(found) == 2
    rows = [BODY_25.index[name] for name in model.layout.keypoints]
    for someone, parts in zip(found, drawn, strict=True):
        # Twice as large an image: pixel p of the network covers pixels 2 p and 2 p + 1.
        np.testing.assert_allclose(someone.body[rows, :2], 2.0 * parts + 0.5, atol=2.5)
        assert (someone.body[rows, 2] > 0.5).all()
        assert someone.body[BODY_25.index["MidHip"], 2] > 0.0
        assert (someone.body[BODY_25.index["LHeel"], 2] > 0.0) == (model is BODY_25_MODEL)


@pytest.mark.parametrize("scale", [0.5, 1.0, 2.7])
def test_the_network_sees_the_image_as_openposes_do(tmp_path: Path, scale: float) -> None:
    """Neck is where it is red, right shoulder where green, right elbow where blue; fields lead to the left.

    A grey of 128 must be 0 to it, full colour 127 / 256.
    """
    weights, constant = np.zeros((78, 3)), np.zeros((78, 1, 1))
    for part, colour in (("Neck", 2), ("RShoulder", 1), ("RElbow", 0)):
        weights[BODY_25.index[part], colour] = 2.0
    for limb in ([1, 2], [2, 3]):
        constant[26 + BODY_25_MODEL.fields[BODY_25_MODEL.limbs.tolist().index(limb), 0]] = -1.0
    width, height = round(320 * scale), round(240 * scale)
    image = np.full((height, width, 3), 128, np.uint8)
    places = {"Neck": (240, 120), "RShoulder": (160, 120), "RElbow": (80, 120)}
    for channel, (x, y) in enumerate(places.values()):  # red, green, blue
        own = image[..., channel].copy()
        cv2.circle(own, (round(x * scale), round(y * scale)), round(12 * scale), 255, -1)
        image[..., channel] = own
    free = save_network(tmp_path / "a.onnx", weights, [constant], size=("width", "height"))
    (someone,) = OpenPoseOnnxDetector(model=free, net_resolution=(-1, 240)).detect(image, 0.0)
    for part, place in places.items():
        np.testing.assert_allclose(
            someone.body[BODY_25.index[part], :2], np.multiply(place, scale), atol=5 * scale
        )
        assert someone.body[BODY_25.index[part], 2] > 0.8
    assert (someone.body[:, 2] > 0).sum() == 3


@pytest.mark.parametrize(
    ("content", "code"),
    [(None, "no_model"), (b"", "bad_model"), (b"not a network", "bad_model"), (b"\x08\x07\x12", "bad_model")],
)
def test_a_missing_or_broken_file_is_told(tmp_path: Path, content: bytes | None, code: str) -> None:
    model = tmp_path / "broken.onnx"
    if content is not None:
        model.write_bytes(content)
    with refused(code):
        OpenPoseOnnxDetector(model=model)


def test_a_network_of_another_kind_or_for_another_image_is_told_with_what_is_expected(tmp_path: Path) -> None:
    rows, columns = NET[1] // STRIDE, NET[0] // STRIDE
    model = save_network(tmp_path / "a.onnx", np.zeros((17, 3)), [np.zeros((17, rows, columns))])
    with refused("wrong_model", "26 maps and 52 field channels"):
        OpenPoseOnnxDetector(model=model, net_resolution=NET)
    # OpenCV adds maps of 40 x 30 to those of a wider image without a word.
    with refused("wrong_model"):
        OpenPoseOnnxDetector(model=given_maps(tmp_path / "b.onnx", []), net_resolution=(640, 240))


@pytest.mark.parametrize("resolution", [(-1, -1), (320, 100), (0, 160), (320,), (320.0, 240), (-16, 160)])
def test_a_resolution_that_is_none_is_refused(tmp_path: Path, resolution: Any) -> None:
    with refused("bad_resolution"):
        OpenPoseOnnxDetector(model=tmp_path, net_resolution=resolution)
