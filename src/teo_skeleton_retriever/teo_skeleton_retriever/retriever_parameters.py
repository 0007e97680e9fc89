# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What can be set of the retriever: one table with meaning, unit, range and the reason of each default."""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from typing import Any, NamedTuple

from teo_skeleton_retriever.errors import RetrieverError


class ParameterInfo(NamedTuple):
    """What is to be known of a parameter.

    Attributes:
        description: What it does, and why its default is what it is.
        unit: "" if it has none.
        lowest: Least value; None for a switch or a choice.
        highest: Greatest value; likewise.
        choices: Allowed words; empty unless it is a choice.
    """

    description: str
    unit: str = ""
    lowest: float | None = None
    highest: float | None = None
    choices: tuple[str, ...] = ()


def _number(default: float | int, unit: str, lowest: float, highest: float, description: str) -> Any:
    info = ParameterInfo(description, unit, lowest, highest)
    return dataclasses.field(default=default, metadata={"info": info})


def _switch(default: bool, description: str) -> Any:
    return dataclasses.field(default=default, metadata={"info": ParameterInfo(description)})


def _choice(default: str, choices: tuple[str, ...], description: str) -> Any:
    return dataclasses.field(default=default, metadata={"info": ParameterInfo(description, choices=choices)})


@dataclass(frozen=True, kw_only=True)
class RetrieverParameters:
    """Settings of a `Retriever`; `parameter_info()` describes each.

    Raises:
        RetrieverError: A value is not of its kind or outside its range.
    """

    min_confidence: float = _number(
        0.3,
        "",
        0.0,
        1.0,
        "Keypoints of which the detector is less sure are not seen; the original's default.",
    )
    min_depth: float = _number(
        0.2, "m", 0.01, 10.0, "Nearer depth is noise: no camera of the table measures nearer."
    )
    max_depth: float = _number(
        5.0, "m", 0.1, 100.0, "Farther depth is background; stereo errs by decimetres there."
    )
    skin_offset: bool = _switch(
        True, "Put joints behind the skin that the camera sees, by radii that grow with the person."
    )
    optimise_limbs: bool = _switch(
        True, "Find elbows and wrists that are hidden or badly measured from the lengths of the limbs."
    )
    fit_hands: bool = _switch(True, "Fit the hand's own shape to its pixels and depths.")
    detector: str = _choice(
        "mediapipe",
        ("mediapipe", "other"),
        "Whose constant offsets from the joints are put right; those of others are not known.",
    )
    hold_time: float = _number(
        0.2, "s", 0.0, 10.0, "A keypoint that is not seen is held so long: after it, hands were 0.1 m off."
    )
    max_sigma: float = _number(
        0.1,
        "m",
        0.01,
        10.0,
        "A keypoint less certain than this is lost, of a hand than 0.6 of it: beyond the length of a palm it "
        "tells nothing of a sign.",
    )
    smoothing: float = _number(
        1.0,
        "",
        0.0,
        10.0,
        "Strength of the smoothing over time; 0 is none, 1 balances delay of fast hands and noise.",
    )
    newcomer_images: int = _number(
        3,
        "",
        1,
        30,
        "Images in which someone must be seen to become a person: flickers of the detector do not; 1 for a "
        "single image.",
    )
    signer_rule: str = _choice(
        "nearest",
        ("nearest", "central"),
        "Who signs while nobody is locked: who stands nearest or most central.",
    )
    signer_patience: float = _number(
        3.0, "s", 0.0, 60.0, "A signer who is not seen is waited for; as long as an id is remembered."
    )

    def __post_init__(self) -> None:
        for name, info in parameter_info().items():
            _check(name, getattr(self, name), info)
        if self.min_depth >= self.max_depth:
            raise RetrieverError(
                "bad_range", f"expected min_depth < max_depth, got {self.min_depth} and {self.max_depth}"
            )


def parameter_info() -> dict[str, ParameterInfo]:
    """Describe the parameters by name, in the order of their declaration."""
    return {field.name: field.metadata["info"] for field in dataclasses.fields(RetrieverParameters)}


def _check(name: str, value: object, info: ParameterInfo) -> None:
    if info.choices:
        if value not in info.choices:
            raise RetrieverError("unknown_choice", f"{name}: expected one of {info.choices}, got {value!r}")
    elif info.lowest is None or info.highest is None:
        if not isinstance(value, bool):
            raise RetrieverError("wrong_type", f"{name}: expected true or false, got {value!r}")
    elif isinstance(value, bool) or not isinstance(value, (int, float)):
        raise RetrieverError("wrong_type", f"{name}: expected a number, got {value!r}")
    elif not (math.isfinite(value) and info.lowest <= value <= info.highest):
        raise RetrieverError(
            "out_of_range", f"{name}: expected {info.lowest} to {info.highest} {info.unit}, got {value}"
        )
