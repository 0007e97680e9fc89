# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The original's parameters: with the defaults of its code, or by the names of its configuration file."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import cv2
import numpy as np

from teo_skeleton_retriever.arrays import DepthArray
from teo_skeleton_retriever.errors import RetrieverError


@dataclass(frozen=True, kw_only=True)
class ContourDilation:
    """Minimum filter over depth (morphological erosion): near surfaces grow, holes are filled.

    The defaults are those in the code of the original (its shipped configurations: 8 px twice at 0.6 to 5 m,
    off; 24 px twelve times at 1 to 6 m). It moves depth towards the camera by what the surface falls off in
    `kernel_size * iterations / 2` pixels.

    Attributes:
        kernel_size: Diameter of the elliptical window [px]. An even one reaches further to the left and up.
        iterations: How often the window is applied.
        min_distance: Nearer is taken as noise and does not grow [m].
        max_distance: Farther is taken as background and becomes unknown [m].

    Raises:
        RetrieverError: A value makes no filter.
    """

    kernel_size: int = 4
    iterations: int = 3
    min_distance: float = 1.0
    max_distance: float = 4.0

    def __post_init__(self) -> None:
        if self.kernel_size < 1 or self.iterations < 0:
            raise RetrieverError(
                "bad_kernel",
                f"expected a kernel >= 1 px, iterations >= 0, got {self.kernel_size}, {self.iterations}",
            )
        if not (math.isfinite(self.min_distance) and 0.0 <= self.min_distance < self.max_distance):
            raise RetrieverError(
                "bad_range",
                f"expected 0 <= min_distance < max_distance, got {self.min_distance}, {self.max_distance}",
            )

    def apply(self, depth: DepthArray) -> DepthArray:
        """Filter one image.

        Args:
            depth: [m], NaN or 0 where unknown. Shape (height, width).

        Returns:
            [m], NaN where unknown. Shape (height, width).
        """
        far = np.float32(np.finfo(np.float32).max)
        with np.errstate(invalid="ignore"):
            known = np.where(depth >= np.float32(self.min_distance), depth, far).astype(np.float32)
        if self.iterations and known.size:
            window = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (self.kernel_size, self.kernel_size))
            known = cv2.erode(known, window, iterations=self.iterations).astype(np.float32)
        known[~(known <= np.float32(self.max_distance))] = np.nan
        known[known <= 0.0] = np.nan
        return known


@dataclass(frozen=True, kw_only=True)
class OriginalParameters:
    """Named as in the original's configuration file, `group::name`.

    Attributes:
        keys_recognition_confidence: Keypoints below it are not seen (skeleton::keys-recognition-confidence).
        keys_recognition_percentage: Share of the 17 keypoints that a skeleton must have.
        keys_acceptable_misses: Images for which a keypoint that is not seen is held.
        min_acceptable_path: Length of the longest path through a skeleton [m].
        tracking_threshold: How far a pivot may move between images [px].
        time_to_live: How long a skeleton that is not seen is kept [s].
        depth_filter: By depth::kernel-size, depth::iterations, depth::min-distance and depth::max-distance;
            None for depth::enable off.
        filter_keypoint_order: Past samples of the median of a keypoint.
        filter_limblength_order: Past samples of the median of a limb's length.
        optimize_limblength: Whether limbs are moved so that their lengths hold.
    """

    keys_recognition_confidence: float = 0.3
    keys_recognition_percentage: float = 0.3
    keys_acceptable_misses: int = 5
    min_acceptable_path: float = 0.5
    tracking_threshold: float = 50.0
    time_to_live: float = 1.0
    depth_filter: ContourDilation | None = field(default_factory=ContourDilation)
    filter_keypoint_order: int = 3
    filter_limblength_order: int = 40
    optimize_limblength: bool = True


def _switch(text: str) -> bool:
    if text.lower() not in ("true", "false", "on", "off"):
        raise ValueError("expected true or false")
    return text.lower() in ("true", "on")


class _Option(NamedTuple):
    """Argument of `OriginalParameters` or `ContourDilation`, how its text is read, and its least value."""

    argument: str
    read: Callable[[str], float]
    least: float = 0


_OPTIONS = {
    "skeleton::keys-recognition-confidence": _Option("keys_recognition_confidence", float),
    "skeleton::keys-recognition-percentage": _Option("keys_recognition_percentage", float),
    "skeleton::keys-acceptable-misses": _Option("keys_acceptable_misses", int),
    "skeleton::min-acceptable-path": _Option("min_acceptable_path", float),
    "skeleton::tracking-threshold": _Option("tracking_threshold", float),
    "skeleton::time-to-live": _Option("time_to_live", float),
    "filtering::filter-keypoint-order": _Option("filter_keypoint_order", int),
    "filtering::filter-limblength-order": _Option("filter_limblength_order", int),
    "filtering::optimize-limblength": _Option("optimize_limblength", _switch),
}
_DEPTH_OPTIONS = {
    "depth::kernel-size": _Option("kernel_size", int, 1),
    "depth::iterations": _Option("iterations", int),
    "depth::min-distance": _Option("min_distance", float),
    "depth::max-distance": _Option("max_distance", float),
}
_ENABLE = "depth::enable"
# The names that are known; those of the original's camera and ports have no meaning here.
_COMPAT_OPTIONS = (*_OPTIONS, _ENABLE, *_DEPTH_OPTIONS)


def original_parameters_from(words: Sequence[str]) -> OriginalParameters:
    """Give the original's parameters.

    Args:
        words: `group::name=value` each; empty ones do not matter. What is not named has the default of the
            original's code.

    Raises:
        RetrieverError: A name is not known, or a value is none.
    """
    chosen: dict[str, dict[str, object]] = {"general": {}, "depth": {}}
    enabled = True
    for word in filter(None, words):
        name, _, text = (part.strip() for part in word.partition("="))
        if name == _ENABLE:
            enabled = bool(_value(name, text, _Option("", _switch)))
        elif name in _DEPTH_OPTIONS:
            option = _DEPTH_OPTIONS[name]
            chosen["depth"][option.argument] = _value(name, text, option)
        elif name in _OPTIONS:
            option = _OPTIONS[name]
            chosen["general"][option.argument] = _value(name, text, option)
        else:
            raise RetrieverError(
                "unknown_compat_option",
                f"expected NAME=VALUE with a name of {', '.join(_COMPAT_OPTIONS)}; got {word!r:.80}",
            )
    depth_filter = ContourDilation(**chosen["depth"]) if enabled else None  # type: ignore[arg-type]
    return OriginalParameters(depth_filter=depth_filter, **chosen["general"])  # type: ignore[arg-type]


def _value(name: str, text: str, option: _Option) -> float:
    try:
        value = option.read(text)
    except ValueError as error:
        raise RetrieverError("wrong_type", f"{name}: got {text!r:.40}: {error}") from None
    if not (math.isfinite(value) and value >= option.least):
        raise RetrieverError("out_of_range", f"{name}: expected {option.least} or more, got {text}")
    return value
