# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How far the retriever's joints are from the truth, beside the usual way and the original's in the same run.

The truth is the joint's centre, from the skeleton of the rendered person. The known takes have other bodies
and motions than those that constants were calibrated on. The held-out ones have other people, lights and
cameras again, and are for a last look: once what was seen there has led to a change, others are to be drawn.
All are followed once more with two thirds of their depth lost, as in recordings of the original's authors.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import product
from typing import NamedTuple

import cv2
import numpy as np
from rich.progress import track

from accuracy.methods import Detections, Estimate, detected, one_pixel, original, ours, perfect
from accuracy.takes import HELD_OUT_TAKES, KNOWN_TAKES, TakeFrame, default_cache, take
from report import Figure
from teo_skeleton_retriever.arrays import DepthArray, FloatArray
from teo_skeleton_retriever.layouts.layout import BODY_25, FACE_70, HAND_21

_MISSING = 0.66  # share of the depth that is lost
_PATCH = 9.0  # [px] size of holes
_METHODS: dict[str, Callable[[Sequence[TakeFrame], Detections], list[Estimate]]] = {
    "ours": ours,
    "one pixel": one_pixel,
    "original": original,
}
_DETECTIONS = {"MediaPipe": detected, "perfect": perfect}
_NAMES = (
    *BODY_25.keypoints,
    *(f"{side}Hand{name}" for side in ("Left", "Right") for name in HAND_21.keypoints),
    *(f"Face{name}" for name in FACE_70.keypoints),
)
_ARMS = ("RShoulder", "LShoulder", "RElbow", "LElbow", "RWrist", "LWrist")
# Rows of the keypoints that count as a part.
_PARTS: dict[str, list[int]] = {
    "body": [_NAMES.index(name) for name in _ARMS],
    "shoulders": [_NAMES.index(name) for name in _ARMS[:2]],
    "wrists": [_NAMES.index(name) for name in _ARMS[4:]],
    "hands": [row for row, name in enumerate(_NAMES) if "Hand" in name],
    "fingertips": [row for row, name in enumerate(_NAMES) if "Hand" in name and name.endswith("Tip")],
    "face": [row for row, name in enumerate(_NAMES) if name.startswith("Face")],
}


class _Errors(NamedTuple):
    """Errors of n keypoints in m images; NaN where the method says nothing."""

    distance: FloatArray
    """[m]. Shape (m, n)"""
    ratio: FloatArray
    """Error over sigma along x, y and z; NaN where the method gives none. Shape (m, n, 3)"""


def _errors_of(part: str, frames: Sequence[TakeFrame], estimates: Sequence[Estimate]) -> _Errors:
    rows = _PARTS[part]
    truths = (frame.truth for frame in frames)
    parts = ((truth.body, truth.left_hand, truth.right_hand, truth.face) for truth in truths)
    off = np.array([estimate.points for estimate in estimates]) - np.array([np.concatenate(p) for p in parts])
    ratio = off / np.array([estimate.sigma for estimate in estimates])
    return _Errors(np.linalg.norm(off, axis=-1)[:, rows], ratio[:, rows])


def measure(known: int = len(KNOWN_TAKES), apart: int = len(HELD_OUT_TAKES)) -> Iterator[Figure]:
    """Errors of each part of the body on so many known takes, and on so many that were held out."""
    for what, chosen in (("known", KNOWN_TAKES[:known]), ("held out", HELD_OUT_TAKES[:apart])):
        takes = [take(settings, default_cache()) for settings in track(chosen, f"{what} takes")]
        for (detector, see), (name, method) in product(_DETECTIONS.items(), _METHODS.items()):
            estimates = [method(frames, see) for frames in takes]
            yield from _figures(f"{what}, 2D of {detector}, {name}", takes, estimates)
        randoms = map(np.random.default_rng, range(len(takes)))
        estimates = [
            ours(frames, detected, partial(_lossy, random=random))
            for frames, random in zip(takes, randoms, strict=True)
        ]
        yield from _figures(f"{what}, {_MISSING:.0%} of the depth missing", takes, estimates)


def _lossy(depth: DepthArray, random: np.random.Generator) -> DepthArray:
    """Lose two thirds of the depth, half of it pixel by pixel, half in patches."""
    share = 1.0 - np.sqrt(1.0 - _MISSING)  # of each of the two
    patches = cv2.GaussianBlur(random.standard_normal(depth.shape), (0, 0), _PATCH)
    lost = (patches < np.quantile(patches, share)) | (random.random(depth.shape) < share)
    return np.where(lost, np.float32(np.nan), depth)


def _figures(
    what: str, takes: Sequence[Sequence[TakeFrame]], estimates: Sequence[Sequence[Estimate]]
) -> Iterator[Figure]:
    for part in _PARTS:
        of_takes = [_errors_of(part, *pair) for pair in zip(takes, estimates, strict=True)]
        errors = _Errors(*(np.concatenate(arrays) for arrays in zip(*of_takes, strict=True)))
        if np.isfinite(errors.distance).any():
            yield Figure(f"{what}: {part}", _told(errors))


def _told(errors: _Errors) -> str:
    """Mean, 95th percentile, share that is given, and of the errors along an axis within two sigmas."""
    known = np.isfinite(errors.distance)
    distance = errors.distance[known] * 1e3
    text = f"mean {distance.mean():.1f}, p95 {np.percentile(distance, 95):.0f} mm, given {known.mean():.0%}"
    ratio = errors.ratio[known]
    ratio = ratio[np.isfinite(ratio)]
    return f"{text}, in 2 sigma {np.mean(np.abs(ratio) < 2.0):.0%}" if len(ratio) else text
