# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What holds for every detector: names, options, images that are none, closing."""

from __future__ import annotations

from importlib.metadata import EntryPoint
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from openpose_writer import frame_path, write_frame

from teo_skeleton_retriever.detectors import DETECTORS, Detector, make_detector
from teo_skeleton_retriever.detectors import detector as detectors
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.layouts.person_2d import Person2D

IMAGE = np.zeros((48, 64, 3), np.uint8)


@pytest.fixture(params=[name for name in DETECTORS if name != "openpose_onnx"])
def detector(request: pytest.FixtureRequest, tmp_path: Path) -> Detector:
    write_frame(frame_path(tmp_path, "0"), (Person2D(),))
    options: dict[str, dict[str, Any]] = {
        "openpose_json": {"folder": tmp_path},
        "replay": {"frames": [(0.0, [Person2D()])]},
    }
    return make_detector(request.param, **options.get(request.param, {}))


def code_of(call: Any, *arguments: Any, **options: Any) -> str:
    with pytest.raises(RetrieverError) as caught:
        call(*arguments, **options)
    assert caught.value.sentence
    return caught.value.code


def test_unknown_name_is_answered_with_the_known_ones() -> None:
    with pytest.raises(RetrieverError, match="mediapipe, openpose_json, openpose_onnx, replay") as caught:
        make_detector("yolo")
    assert caught.value.code == "unknown_detector"


def test_unknown_or_missing_option_is_answered_with_the_known_ones() -> None:
    with pytest.raises(RetrieverError, match="min_tracking_confidence") as caught:
        make_detector("mediapipe", complexity=2)
    assert caught.value.code == "bad_option"
    assert code_of(make_detector, "openpose_json") == "bad_option"


@pytest.mark.parametrize(
    ("name", "options"),
    [
        ("openpose_json", {"folder": 5}),
        ("openpose_json", {"folder": ".", "wait": "long"}),
        ("openpose_json", {"folder": ".", "stamps": 3}),
        ("openpose_json", {"folder": ".", "keypoint_scale": 1, "resolution": ["wide", 368]}),
        ("openpose_onnx", {"model": "a.onnx", "net_resolution": 368}),
        ("openpose_onnx", {"model": None}),
        ("replay", {"frames": 7}),
        ("mediapipe", {"hands": ["full"]}),
    ],
)
def test_an_option_of_the_wrong_kind_is_told(name: str, options: dict[str, Any]) -> None:
    assert code_of(make_detector, name, **options) == "bad_option"


@pytest.mark.parametrize("value", [-0.1, 1.5, float("nan"), "high"])
def test_confidence_outside_its_range_is_refused(value: object) -> None:
    assert code_of(make_detector, "mediapipe", min_detection_confidence=value) == "bad_option"


@pytest.mark.parametrize(
    "image",
    [
        np.zeros((48, 64), np.uint8),
        np.zeros((48, 64, 4), np.uint8),
        np.zeros((0, 64, 3), np.uint8),
        np.zeros((48, 64, 3), np.float32),
        [[0, 0, 0]],
        None,
    ],
)
def test_no_detector_takes_what_is_no_image(detector: Detector, image: Any) -> None:
    assert code_of(detector.detect, image, 0.0) == "bad_image"
    detector.close()


@pytest.mark.parametrize("stamp", [float("nan"), float("inf")])
def test_no_detector_takes_what_is_no_time(detector: Detector, stamp: float) -> None:
    assert code_of(detector.detect, IMAGE, stamp) == "bad_stamp"
    detector.close()


def test_every_detector_works_on_after_a_bad_image_and_ends_when_closed(detector: Detector) -> None:
    code_of(detector.detect, IMAGE[..., 0], 0.0)
    assert isinstance(detector.detect(IMAGE, 0.0), tuple)
    detector.close()
    detector.close()
    assert code_of(detector.detect, IMAGE, 0.1) == "closed"


ABSENT = EntryPoint("openpose_onnx", "no_such_package.detector:Detector", detectors.DETECTOR_GROUP)


@pytest.mark.parametrize(("offered", "missing"), [((), "make setup"), ((ABSENT,), "no_such_package")])
def test_a_detector_that_is_not_installed_is_refused_with_what_is_missing(
    offered: tuple[EntryPoint, ...], missing: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(detectors, "entry_points", lambda **_: offered)
    with pytest.raises(RetrieverError, match=missing) as caught:
        make_detector("openpose_onnx")
    assert caught.value.code == "not_installed"
