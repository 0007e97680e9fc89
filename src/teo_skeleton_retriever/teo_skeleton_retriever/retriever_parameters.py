# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What can be set of the retriever: one table with meaning, unit, range and the reason of each default."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, fields
from functools import cache
from typing import Any

from teo_common.parameters import ParameterRow
from teo_skeleton_retriever.errors import RetrieverError


def _number(default: float | int, unit: str, low: float, high: float, description: str) -> Any:
    told = f"{description} [{unit}]" if unit else description
    return field(default=default, metadata={"low": low, "high": high, "description": told})


def _switch(default: bool, description: str) -> Any:
    return field(default=default, metadata={"description": description})


def _choice(default: str, choices: tuple[str, ...], description: str) -> Any:
    return field(default=default, metadata={"choices": choices, "description": description})


@dataclass(frozen=True, kw_only=True)
class RetrieverParameters:
    """Settings of a `Retriever`; `parameter_rows()` describes each.

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
        "Images in which someone must be seen to become a person: flickers of the detector do not; a "
        "recording's first image counts at once.",
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
        for row in parameter_rows():
            _check(row, getattr(self, row.name))
        if self.min_depth >= self.max_depth:
            raise RetrieverError(
                "bad_range", f"expected min_depth < max_depth, got {self.min_depth} and {self.max_depth}"
            )


@cache
def parameter_rows() -> tuple[ParameterRow, ...]:
    """Describe the parameters, in the order of their declaration."""
    return tuple(
        ParameterRow(name=one.name, default=getattr(RetrieverParameters, one.name), **one.metadata)
        for one in fields(RetrieverParameters)
    )


def _check(row: ParameterRow, value: object) -> None:
    if row.choices:
        if value not in row.choices:
            raise RetrieverError(
                "unknown_choice", f"{row.name}: expected one of {row.choices}, got {value!r}"
            )
    elif row.low is None or row.high is None:
        if not isinstance(value, bool):
            raise RetrieverError("wrong_type", f"{row.name}: expected true or false, got {value!r}")
    elif isinstance(value, bool) or not isinstance(value, (int, float)):
        raise RetrieverError("wrong_type", f"{row.name}: expected a number, got {value!r}")
    elif not (math.isfinite(value) and row.low <= value <= row.high):
        raise RetrieverError("out_of_range", f"{row.name}: expected {row.low} to {row.high}, got {value}")
