"""The maxima of confidence maps: where parts of people are."""

from __future__ import annotations

from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.detectors.paf.paf_model import IntArray

MapArray = NDArray[np.float32]

MOST_PER_PART = 127
"""OpenPose's limit of people; of noise, only the strongest maxima are looked at."""


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
        maps: one map for each part. Shape (parts, rows, columns).
        size: width, height of the network's input [px].
        threshold: what a maximum must exceed.
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
