# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from importlib.metadata import EntryPoint
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from openpose_writer import frame_path, write_frame
from refusals import refused

from teo_skeleton_retriever.detectors import DETECTORS, Detector, make_detector
from teo_skeleton_retriever.detectors import detector as detectors
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


@pytest.mark.parametrize(
    ("code", "said", "name", "options"),
    [
        ("unknown_detector", "mediapipe, openpose_json, openpose_onnx, replay", "yolo", {}),
        ("bad_option", "min_tracking_confidence", "mediapipe", {"complexity": 2}),
        ("bad_option", "folder", "openpose_json", {}),
    ],
)
def test_an_unknown_name_or_option_is_answered_with_the_known_ones(
    code: str, said: str, name: str, options: dict[str, Any]
) -> None:
    with refused(code, said):
        make_detector(name, **options)


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
        *(("mediapipe", {"min_detection_confidence": value}) for value in (-0.1, 1.5, float("nan"), "high")),
    ],
)
def test_an_option_of_the_wrong_kind_or_outside_its_range_is_told(name: str, options: dict[str, Any]) -> None:
    with refused("bad_option"):
        make_detector(name, **options)


def test_every_detector_works_on_after_what_is_no_image_of_a_time_and_ends_when_closed(
    detector: Detector,
) -> None:
    no_images = (
        IMAGE[..., 0],
        np.zeros((48, 64, 4), np.uint8),
        IMAGE[:0],
        IMAGE.astype(float),
        [[0, 0, 0]],
        None,
    )
    for bad in no_images:
        with refused("bad_image"):
            detector.detect(bad, 0.0)  # type: ignore[arg-type]
    for stamp in (float("nan"), float("inf")):
        with refused("bad_stamp"):
            detector.detect(IMAGE, stamp)
    assert isinstance(detector.detect(IMAGE, 0.0), tuple)
    detector.close()
    detector.close()
    with refused("closed"):
        detector.detect(IMAGE, 0.1)


ABSENT = EntryPoint("openpose_onnx", "no_such_package.detector:Detector", detectors.DETECTOR_GROUP)


@pytest.mark.parametrize(("offered", "missing"), [((), "make setup"), ((ABSENT,), "no_such_package")])
def test_a_detector_that_is_not_installed_is_refused_with_what_is_missing(
    offered: tuple[EntryPoint, ...], missing: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(detectors, "entry_points", lambda **_: offered)
    with refused("not_installed", missing):
        make_detector("openpose_onnx")
