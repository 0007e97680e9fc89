# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Detectors by name."""

from __future__ import annotations

import inspect
from importlib import import_module
from typing import cast

from teo_skeleton_retriever.detectors.detector import Detector
from teo_skeleton_retriever.errors import RetrieverError

_CLASSES = {
    "mediapipe": "mediapipe.mediapipe_detector.MediaPipeDetector",
    "openpose_json": "openpose.openpose_json_detector.OpenPoseJsonDetector",
    "openpose_onnx": "paf.openpose_onnx_detector.OpenPoseOnnxDetector",
    "replay": "openpose.replay_detector.ReplayDetector",
}
# The names that `make_detector` knows.
DETECTORS = tuple(_CLASSES)


def make_detector(name: str, **options: object) -> Detector:
    """Make a detector.

    Args:
        name: One of `DETECTORS`.
        options: Of that detector's constructor.

    Raises:
        RetrieverError: The name or an option is unknown, or the detector cannot be made.
    """
    if name not in _CLASSES:
        raise RetrieverError("unknown_detector", f"expected one of {', '.join(DETECTORS)}, got {name!r}")
    module, _, class_name = _CLASSES[name].rpartition(".")
    # Imported only when asked for: MediaPipe takes a second to load.
    detector = getattr(import_module(f"teo_skeleton_retriever.detectors.{module}"), class_name)
    try:
        inspect.signature(detector).bind(**options)
    except TypeError as error:
        known = ", ".join(inspect.signature(detector).parameters)
        raise RetrieverError("bad_option", f"{name}: expected options among {known}; {error}") from error
    try:
        return cast(Detector, detector(**options))
    except (
        TypeError
    ) as error:  # options come from users, as JSON: a text where a number should be, and the like
        raise RetrieverError("bad_option", f"{name}: an option is of the wrong kind: {error}") from error
