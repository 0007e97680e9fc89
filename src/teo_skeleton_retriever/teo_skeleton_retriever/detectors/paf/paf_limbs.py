"""Which two parts are joined by a limb: the line integral along the field between them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.detectors.paf.paf_model import IntArray, PafModel
from teo_skeleton_retriever.detectors.paf.paf_peaks import MapArray, Peaks
from teo_skeleton_retriever.detectors.paf.paf_thresholds import PafThresholds

FEWEST, MOST = 5, 25
"""Places looked at along a limb."""
SHORT = 1.0 / 150.0
"""Of the square root of the area: parts so close together may be joined though the field between them is too
coarse to say so (an ear behind a shoulder)."""
AT_ONCE = 4096
"""Candidates looked at together: some 10 MB, and no more whatever the network gives."""


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
    """Join peaks, each with all that its fields allow.

    Args:
        peaks: in pixels of the network's input.
        fields: of all limbs. Shape (channels, rows, columns).
        size: width, height of the network's input [px].
        model: which fields lead from which part to which.
        thresholds: when a limb counts.
    """
    of_part = [np.flatnonzero(peaks.part == part) for part in range(len(model.layout))]
    pairs = [
        (np.repeat(of_part[a], len(of_part[b])), np.tile(of_part[b], len(of_part[a]))) for a, b in model.limbs
    ]
    first = np.concatenate([a for a, _ in pairs])
    second = np.concatenate([b for _, b in pairs])
    channels = np.repeat(model.fields, [len(a) for a, _ in pairs], axis=0)
    scores = np.zeros(len(first))
    for begin in range(0, len(first), AT_ONCE):
        some = slice(begin, begin + AT_ONCE)
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
    count = np.clip(np.rint(np.sqrt(5.0 * np.abs(along).max(axis=1))), FEWEST, MOST)
    step = np.arange(MOST)
    looked_at = step < count[:, None]
    share = np.minimum(step / (count[:, None] - 1.0), 1.0)
    places = start[:, None] + share[..., None] * along[:, None]
    x = _sample(fields, channels[:, 0], places, size)
    y = _sample(fields, channels[:, 1], places, size)
    component = x * direction[:, None, 0] + y * direction[:, None, 1]
    agrees = looked_at & (component > thresholds.along_limb)
    agreeing = agrees.sum(axis=1)
    mean = np.where(agrees, component, 0.0).sum(axis=1) / np.maximum(agreeing, 1)
    short = length < SHORT * np.sqrt(size[0] * size[1])
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
