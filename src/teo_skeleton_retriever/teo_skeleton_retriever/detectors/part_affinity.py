# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From the maps of a network to people: maxima are parts, fields between two parts join them to limbs.

Source of the method, its thresholds and the meaning of the maps: OpenPose 1.7, `poseParameters.cpp`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.layouts.layout import BODY_25, COCO_18, Layout

IntArray = NDArray[np.intp]
MapArray = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class PafModel:
    """A network's output: a confidence map for each part and one of the background, then limb fields.

    Attributes:
        layout: The parts, in the order of their maps.
        limbs: The two parts that each limb's field leads from and to. Shape (limbs, 2).
        fields: For each limb the channels of its field's x and y, counted among the fields. Shape (limbs, 2).
    """

    layout: Layout
    limbs: IntArray
    fields: IntArray

    @property
    def map_channels(self) -> int:
        """Number of confidence maps, that of the background included."""
        return len(self.layout) + 1

    @property
    def field_channels(self) -> int:
        """Number of channels of all fields."""
        return 2 * len(self.limbs)


def _pairs(text: str) -> IntArray:
    array = np.array(text.replace("-", " ").split(), dtype=np.intp).reshape(-1, 2)
    array.flags.writeable = False
    return array


BODY_25_MODEL = PafModel(
    BODY_25,
    _pairs(
        "1-8 1-2 1-5 2-3 3-4 5-6 6-7 8-9 9-10 10-11 8-12 12-13 13-14 1-0 0-15 15-17 0-16 16-18 2-17 5-18 "
        "14-19 19-20 14-21 11-22 22-23 11-24"
    ),
    _pairs(
        "0-1 14-15 22-23 16-17 18-19 24-25 26-27 6-7 2-3 4-5 8-9 10-11 12-13 30-31 32-33 36-37 34-35 38-39 "
        "20-21 28-29 40-41 42-43 44-45 46-47 48-49 50-51"
    ),
)
COCO_18_MODEL = PafModel(
    COCO_18,
    _pairs("1-2 1-5 2-3 3-4 5-6 6-7 1-8 8-9 9-10 1-11 11-12 12-13 1-0 0-14 14-16 0-15 15-17 2-16 5-17"),
    _pairs(
        "12-13 20-21 14-15 16-17 22-23 24-25 0-1 2-3 4-5 6-7 8-9 10-11 28-29 30-31 34-35 32-33 36-37 "
        "18-19 26-27"
    ),
)
PAF_MODELS = (BODY_25_MODEL, COCO_18_MODEL)


class PafThresholds(NamedTuple):
    """Thresholds from which on parts, limbs and people count."""

    peak: float = 0.05
    """confidence above which a maximum is a part"""
    along_limb: float = 0.05
    """component of the field along the limb above which a place on it agrees, in [0, 1]"""
    agreeing: float = 0.95
    """share of places that must agree"""
    parts: int = 3
    """parts that a person has at least"""
    score: float = 0.4
    """mean score of a person's parts, limbs counted in, at least"""


# Few people who are not there.
CAREFUL = PafThresholds()
# Few people missed: OpenPose's `--maximize_positives`.
GENEROUS = PafThresholds(peak=0.02, along_limb=0.01, agreeing=0.75, parts=2, score=0.05)


# OpenPose's limit of people; of noise, only the strongest maxima are looked at.
MOST_PER_PART = 127


class Peaks(NamedTuple):
    """Maxima of all maps, map by map."""

    part: IntArray
    """which map it is in. Shape (n,)"""
    position: FloatArray
    """x, y [px] of the network's input. Shape (n, 2)"""
    score: FloatArray
    """height, at most 1. Shape (n,)"""


def find_peaks(maps: MapArray, size: tuple[int, int], threshold: float) -> Peaks:
    """Find the maxima, between the cells of the maps.

    The maps are enlarged to the network's input (cubic), as a maximum of the coarse map would be up to half a
    cell off; the place between pixels is the top of the parabola through the maximum and its neighbours.

    Args:
        maps: One map for each part. Shape (parts, rows, columns).
        size: Width, height of the network's input [px].
        threshold: What a maximum must exceed.
    """
    parts, positions, scores = [], [], []
    for part, coarse in enumerate(maps):
        if not coarse.max() > threshold:  # also where the network gives NaN
            continue
        position, score = _peaks_of(_enlarged(coarse, size), threshold)
        parts.append(np.full(len(score), part, dtype=np.intp))
        positions.append(position)
        scores.append(score)
    if not parts:
        return Peaks(np.zeros(0, dtype=np.intp), np.zeros((0, 2)), np.zeros(0))
    return Peaks(np.concatenate(parts), np.concatenate(positions), np.concatenate(scores))


def _enlarged(coarse: MapArray, size: tuple[int, int]) -> MapArray:
    x, y = coarse.shape[1] / size[0], coarse.shape[0] / size[1]
    to_cells = np.array([[x, 0.0, (x - 1.0) / 2.0], [0.0, y, (y - 1.0) / 2.0]])
    # Nothing is outside. Were the last cell repeated there, a cubic would rise again towards the border.
    fine: MapArray = cv2.warpAffine(
        coarse, to_cells, size, flags=cv2.INTER_CUBIC | cv2.WARP_INVERSE_MAP, borderMode=cv2.BORDER_CONSTANT
    )
    return fine


def _peaks_of(fine: MapArray, threshold: float) -> tuple[FloatArray, FloatArray]:
    padded = np.pad(fine, 1, constant_values=-np.inf)
    rows, columns = np.nonzero((fine > threshold) & (fine >= cv2.dilate(fine, np.ones((3, 3), np.uint8))))
    around = np.stack(
        [padded[rows + i, columns + j] for i in range(3) for j in range(3)], axis=1, dtype=np.float64
    )
    middle = around[:, 4]
    # Of equal neighbours only the last in reading order is a maximum, so that a plateau is one.
    only = (middle[:, None] > around[:, 5:]).all(axis=1)
    strongest = np.flatnonzero(only)[np.argsort(-middle[only], kind="stable")[:MOST_PER_PART]]
    rows, columns, around, middle = rows[strongest], columns[strongest], around[strongest], middle[strongest]
    x = columns + _top(around[:, 3], middle, around[:, 5])
    y = rows + _top(around[:, 1], middle, around[:, 7])
    return np.column_stack([x, y]), np.minimum(middle, 1.0)


def _top(before: FloatArray, middle: FloatArray, after: FloatArray) -> FloatArray:
    """Place of a parabola's top beside its middle sample, within half a sample; 0 at the border."""
    curvature = before - 2.0 * middle + after
    usable = np.isfinite(curvature) & (curvature < 0.0)
    slope = np.where(usable, before - after, 0.0)
    return slope / np.where(usable, 2.0 * curvature, 1.0)


# Places looked at along a limb.
_FEWEST_SAMPLES, _MOST_SAMPLES = 5, 25
# Of the square root of the area: parts so close together may be joined though the field between them is too
# coarse to say so (an ear behind a shoulder).
_SHORT_LIMB = 1.0 / 150.0
# Candidates looked at together: some 10 MB, and no more whatever the network gives.
_CANDIDATES_AT_ONCE = 4096


class Limbs(NamedTuple):
    """Pairs of peaks that belong together, as far as the field between them tells."""

    first: IntArray
    """index of the peak that the limb leads from. Shape (n,)"""
    second: IntArray
    """index of the peak that it leads to. Shape (n,)"""
    score: FloatArray
    """mean component of the field along the limb. Shape (n,)"""


def find_limbs(
    peaks: Peaks, fields: MapArray, size: tuple[int, int], model: PafModel, thresholds: PafThresholds
) -> Limbs:
    """Find all limbs between peaks that the fields support.

    Args:
        peaks: In pixels of the network's input.
        fields: Of all limbs. Shape (channels, rows, columns).
        size: Width, height of the network's input [px].
        model: Which fields lead from which part to which.
        thresholds: When a limb counts.
    """
    of_part = [np.flatnonzero(peaks.part == part) for part in range(len(model.layout))]
    pairs = [
        (np.repeat(of_part[a], len(of_part[b])), np.tile(of_part[b], len(of_part[a]))) for a, b in model.limbs
    ]
    first = np.concatenate([a for a, _ in pairs])
    second = np.concatenate([b for _, b in pairs])
    channels = np.repeat(model.fields, [len(a) for a, _ in pairs], axis=0)
    scores = np.zeros(len(first))
    for begin in range(0, len(first), _CANDIDATES_AT_ONCE):
        some = slice(begin, begin + _CANDIDATES_AT_ONCE)
        scores[some] = _line_scores(
            fields,
            channels[some],
            peaks.position[first[some]],
            peaks.position[second[some]],
            size,
            thresholds,
        )
    found = scores > 0.0
    return Limbs(first[found], second[found], scores[found])


def _line_scores(
    fields: MapArray,
    channels: IntArray,
    start: FloatArray,
    end: FloatArray,
    size: tuple[int, int],
    thresholds: PafThresholds,
) -> FloatArray:
    along = end - start
    length = np.hypot(along[:, 0], along[:, 1])
    direction = along / np.maximum(length, 1e-6)[:, None]
    count = np.clip(np.rint(np.sqrt(5.0 * np.abs(along).max(axis=1))), _FEWEST_SAMPLES, _MOST_SAMPLES)
    step = np.arange(_MOST_SAMPLES)
    looked_at = step < count[:, None]
    share = np.minimum(step / (count[:, None] - 1.0), 1.0)
    places = start[:, None] + share[..., None] * along[:, None]
    x = _sample(fields, channels[:, 0], places, size)
    y = _sample(fields, channels[:, 1], places, size)
    component = x * direction[:, None, 0] + y * direction[:, None, 1]
    agrees = looked_at & (component > thresholds.along_limb)
    agreeing = agrees.sum(axis=1)
    mean = np.where(agrees, component, 0.0).sum(axis=1) / np.maximum(agreeing, 1)
    short = length < _SHORT_LIMB * np.sqrt(size[0] * size[1])
    score = np.where(agreeing > thresholds.agreeing * count, mean, np.where(short, thresholds.peak, 0.0))
    return np.where(length > 1e-6, score, 0.0)


def _sample(fields: MapArray, channels: IntArray, places: FloatArray, size: tuple[int, int]) -> FloatArray:
    """Read a field between its cells (bilinear). Places: [px] of the network's input, (n, steps, 2)."""
    rows, columns = fields.shape[1:]
    cells = np.array([columns, rows])
    at = np.clip((places + 0.5) * (cells / np.array(size)) - 0.5, 0.0, cells - 1.0)
    low = np.minimum(at.astype(np.intp), np.maximum(cells - 2, 0))
    x, y = np.moveaxis(at - low, -1, 0)
    column, row = low[..., 0], low[..., 1]
    right, below = np.minimum(column + 1, columns - 1), np.minimum(row + 1, rows - 1)
    channel = channels[:, None]
    above_mean = fields[channel, row, column] * (1.0 - x) + fields[channel, row, right] * x
    below_mean = fields[channel, below, column] * (1.0 - x) + fields[channel, below, right] * x
    mean: FloatArray = above_mean * (1.0 - y) + below_mean * y
    return mean


# How much the confidence of its two parts counts beside a limb's own score when limbs are ranked.
_PEAK_SHARE = 0.1
# Other parts that somebody with feet must have: feet alone are often shoes, or reflections.
_FEWEST_BESIDE_FEET = 5


@dataclass
class _Person:
    peaks: dict[int, int]
    """index of the peak by part"""
    score: float


def assemble(
    peaks: Peaks, limbs: Limbs, model: PafModel, thresholds: PafThresholds
) -> tuple[FloatArray, ...]:
    """Put people together.

    Limbs are taken in the order of their score. One between two free parts begins a person; one to a free
    part extends the person of the other; one between two people joins them if they have no part in common;
    one that contradicts what stronger limbs have settled is left out.

    Returns:
        x, y [px], confidence of each person's parts, zero where not found; shape (parts, 3) each.
    """
    rank = limbs.score + _PEAK_SHARE * (peaks.score[limbs.first] + peaks.score[limbs.second])
    owner: dict[int, _Person] = {}
    for limb in np.argsort(-rank, kind="stable"):
        first, second = int(limbs.first[limb]), int(limbs.second[limb])
        _join(first, second, float(limbs.score[limb]), owner, peaks)
    people = list({id(person): person for person in owner.values()}.values())
    return tuple(_table(person, peaks, model) for person in people if _is_person(person, model, thresholds))


def _join(first: int, second: int, limb_score: float, owner: dict[int, _Person], peaks: Peaks) -> None:
    one = owner.get(first) or _alone(first, peaks)
    other = owner.get(second) or _alone(second, peaks)
    if one is other:
        one.score += limb_score
    elif one.peaks.keys().isdisjoint(other.peaks):
        one.peaks |= other.peaks
        one.score += other.score + limb_score
        for peak in one.peaks.values():
            owner[peak] = one


def _alone(peak: int, peaks: Peaks) -> _Person:
    return _Person({int(peaks.part[peak]): peak}, float(peaks.score[peak]))


def _is_person(person: _Person, model: PafModel, thresholds: PafThresholds) -> bool:
    parts = len(person.peaks)
    feet = sum(model.layout.keypoints[part].endswith(("Toe", "Heel")) for part in person.peaks)
    return (
        parts >= thresholds.parts
        and person.score / parts >= thresholds.score
        and not (feet and parts - feet < _FEWEST_BESIDE_FEET)
    )


def _table(person: _Person, peaks: Peaks, model: PafModel) -> FloatArray:
    table = np.zeros((len(model.layout), 3))
    for part, peak in person.peaks.items():
        table[part] = *peaks.position[peak], peaks.score[peak]
    return table
