# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The parameters of `retriever_node`, in one table: its own, and those of the retriever."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from functools import partial

from teo_common.parameters import ParameterRow, Value
from teo_skeleton_retriever.camera.synchroniser import DEFAULT_SLOP, GREATEST_SLOP
from teo_skeleton_retriever.detectors import DETECTORS
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.image_retriever import COMPAT_MODES
from teo_skeleton_retriever.retriever_parameters import RetrieverParameters, parameter_rows

# What holds from the start of the node to its end.
_at_start = partial(ParameterRow, read_only=True)
_NODE = (
    _at_start(
        name="detector",
        default="mediapipe",
        choices=DETECTORS,
        description="What finds people in the colour image.",
    ),
    _at_start(
        name="detector_options",
        default=("",),  # ROS could not tell the type of an empty list
        description="Options of the detector, NAME=VALUE each.",
    ),
    _at_start(
        name="compat",
        default="",
        choices=COMPAT_MODES,
        description="Whose processing after the detector: ours if empty, or that of the original.",
    ),
    _at_start(
        name="compat_options",
        default=("",),
        description="Parameters of the original, group::name=value each, as in its configuration file.",
    ),
    _at_start(
        name="color_transport",
        default="auto",
        choices=("auto", "raw", "compressed"),
        description="Which form of the colour image is subscribed to; auto: raw, unless only compressed is "
        "published.",
    ),
    _at_start(
        name="depth_transport",
        default="auto",
        choices=("auto", "raw", "compressedDepth"),
        description="Which form of the depth image is subscribed to; likewise.",
    ),
    _at_start(
        name="rectified",
        default=False,
        description="Whether the images were rectified, and so have the projection of P and no distortion.",
    ),
    _at_start(
        name="slop",
        default=DEFAULT_SLOP,
        low=0.0,
        high=GREATEST_SLOP,
        description="Greatest difference between the stamps of colour and depth [s]; with more than half the "
        "time between images the depth of another image could be taken.",
    ),
    _at_start(
        name="queue_size",
        default=5,
        low=1,
        high=100,
        description="Images that wait for their depth: a sixth of a second at 30 Hz.",
    ),
    ParameterRow(
        name="period",
        default=0.0,
        low=0.0,
        high=60.0,
        description="Least time between images that are processed [s]; 0 takes every one.",
    ),
)


# The node has a `detector` of its own, from which the retriever's follows.
_RETRIEVER = tuple(row for row in parameter_rows() if row.name != "detector")
PARAMETERS = (*_NODE, *_RETRIEVER)


def retriever_parameters_from(values: Mapping[str, Value], detector: str) -> RetrieverParameters:
    """Give the retriever's parameters.

    Args:
        values: By name; others than the retriever's do not matter.
        detector: Name of the one that is used.

    Raises:
        RetrieverError: A value is wrong, or two do not go together.
    """
    chosen: dict[str, Value] = {row.name: values[row.name] for row in _RETRIEVER}
    chosen["detector"] = "mediapipe" if detector == "mediapipe" else "other"
    return RetrieverParameters(**chosen)  # type: ignore[arg-type]  # checked by the class itself


def check_choices(values: Mapping[str, Value]) -> None:
    """Check what ROS does not: words among allowed ones.

    Raises:
        RetrieverError: A word is none of those allowed.
    """
    for row in PARAMETERS:
        if row.choices and values[row.name] not in row.choices:
            raise RetrieverError(
                "unknown_choice", f"{row.name}: expected one of {row.choices}, got {values[row.name]!r}"
            )


def detector_options_from(words: Sequence[str]) -> dict[str, object]:
    """Read the options of a detector.

    Args:
        words: NAME=VALUE each, where the value is JSON or else text; empty ones do not matter.

    Raises:
        RetrieverError: A word is not of this form.
    """
    options: dict[str, object] = {}
    for word in filter(None, words):
        name, found, text = word.partition("=")
        if not (found and name.isidentifier()):
            raise RetrieverError("bad_option", f"expected NAME=VALUE as detector option, got {word!r:.80}")
        try:
            options[name] = json.loads(text)
        except json.JSONDecodeError:
            options[name] = text
    return options


def parameters_from_words(words: Sequence[str], *, detector: str) -> RetrieverParameters:
    """Give the retriever's parameters from words as typed on a command line.

    Args:
        words: NAME=VALUE each.
        detector: Name of the one that is used.

    Raises:
        RetrieverError: A name or a value is wrong, or two do not go together.
    """
    values: dict[str, Value] = {row.name: row.default for row in _RETRIEVER}
    for word in words:
        name, found, text = word.partition("=")
        if not found or name not in values:
            raise RetrieverError(
                "unknown_parameter", f"expected NAME=VALUE with a name of {', '.join(values)}; got {word!r}"
            )
        values[name] = _value_of(name, text, type(values[name]))
    return retriever_parameters_from(values, detector)


def _value_of(name: str, text: str, kind: type) -> Value:
    if kind is bool and text.lower() in ("true", "false"):
        return text.lower() == "true"
    try:
        if kind is not bool:
            value: Value = kind(text)
            return value
    except ValueError:
        pass
    raise RetrieverError("wrong_type", f"{name}: expected a value of type {kind.__name__}, got {text!r}")
