# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Detectors by name."""

from __future__ import annotations

import inspect
from typing import cast

from teo_skeleton_retriever.detectors.detector import Detector
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.plugins import DETECTOR_GROUP, plugin

# The names that `make_detector` knows.
DETECTORS = ("mediapipe", "openpose_json", "openpose_onnx", "replay")


def make_detector(name: str, **options: object) -> Detector:
    """Make a detector.

    Args:
        name: One of `DETECTORS`.
        options: Of that detector's constructor.

    Raises:
        RetrieverError: The name or an option is unknown, or the detector is not installed or cannot be made.
    """
    if name not in DETECTORS:
        raise RetrieverError("unknown_detector", f"expected one of {', '.join(DETECTORS)}, got {name!r}")
    detector = plugin(DETECTOR_GROUP, name)
    try:
        inspect.signature(detector).bind(**options)
    except TypeError as error:
        known = ", ".join(inspect.signature(detector).parameters)
        raise RetrieverError("bad_option", f"{name}: expected options among {known}; {error}") from error
    try:
        return cast(Detector, detector(**options))
    except TypeError as error:  # users give options as JSON: a text where a number should be, and the like
        raise RetrieverError("bad_option", f"{name}: an option is of the wrong kind: {error}") from error
