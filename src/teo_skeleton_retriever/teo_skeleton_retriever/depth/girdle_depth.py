# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The depths of neck and shoulders: which of the surfaces seen there are theirs, and what a hand hides.

A hand or a forearm before a shoulder is no less a surface than the shoulder is. What tells them apart is that
the neck lies midway between the shoulders, that the head is over them, and where they were before: every
choice of a surface for each of the three, or of none, is solved by least squares, and the likeliest is taken.
"""

from __future__ import annotations

from itertools import product
from typing import NamedTuple

import numpy as np

from teo_skeleton_retriever.arrays import BoolArray, FloatArray
from teo_skeleton_retriever.depth.depth_lookup import Surfaces

_HIDING = 6.0  # what it costs to suppose that something hides a joint: as much as a depth off by 2.4 sigma
# Beyond it what the images before let expect does not speak against a depth any more, nor a head that seems
# too near: a hand may be before it. Shoulders far before the head there are none.
_CAP = 9.0
_SURFACE_SIGMA = np.array([0.03, 0.02, 0.02])  # [m] how far the skin is from where it is on an average chest
_BEHIND_HEAD = 0.095  # [m] from nose and eyes to the middle of the shoulders; of rendered people 0.03 to 0.14
_BEHIND_HEAD_SIGMA = 0.05  # [m] people lean, and hands are before faces
_TURNED = 0.15  # [m] between the depths of both shoulders: of people who turn by 25 deg
_MOVED = 0.04  # [m] that shoulders move, beside what is expected, from image to image
_SINGULAR = 1e-3  # determinant [1/m^4] below which nothing tells where the shoulders are

# The surface that each of neck, right and left shoulder has, 3 for none. Shape (64, 3)
_CHOICES = np.array(list(product(range(4), repeat=3)))


class GirdleDepths(NamedTuple):
    """Neck, right and left shoulder."""

    depth: FloatArray
    """[m]; NaN if nothing tells. Shape (3,)"""
    sigma: FloatArray
    """standard deviation [m]; NaN likewise. Shape (3,)"""
    hidden: BoolArray
    """joints whose depth follows from the others. Shape (3,)"""


def girdle_depths(
    surfaces: Surfaces, behind: FloatArray, *, head: float, expected: FloatArray, expected_sigma: FloatArray
) -> GirdleDepths:
    """Find the depths in one image.

    Args:
        surfaces: Seen around neck, right and left shoulder.
        behind: How far behind the skin each joint is [m]. Shape (3,).
        head: Depth of nose and eyes [m]; NaN if not known.
        expected: Depths by the images before [m]; NaN where there were none. Shape (3,).
        expected_sigma: Their standard deviations [m]. Shape (3,).
    """
    rows = np.arange(3)
    places = np.column_stack([surfaces.depth + behind[:, None], np.full(3, np.nan)])[rows, _CHOICES]
    seen = np.isfinite(places)
    possible = (seen | (_CHOICES == 3)).all(axis=1)
    weights = np.where(seen, _SURFACE_SIGMA**-2.0, 0.0)[possible]
    places, seen = np.where(seen, places, 0.0)[possible], seen[possible]
    prior = np.where(np.isfinite(expected), 1.0 / (expected_sigma**2 + _MOVED**2), 0.0)[1:]
    before = np.nan_to_num(expected)[1:]
    above = _BEHIND_HEAD_SIGMA**-2.0 if np.isfinite(head) else 0.0
    middle = np.nan_to_num(head) + _BEHIND_HEAD
    shoulders, _ = _solve(places, weights, middle, above, before, prior)
    missed = np.column_stack([shoulders.mean(axis=1), shoulders]) - places
    farther = shoulders.mean(axis=1) - middle
    under_head, surprise = above * farther**2, prior * (shoulders - before) ** 2
    cost = (weights * missed**2).sum(axis=1) + _HIDING * (~seen).sum(axis=1)
    cost += np.where(farther > 0.0, _capped(under_head), under_head) + _capped(surprise).sum(axis=1)
    cost += (np.diff(shoulders)[:, 0] / _TURNED) ** 2
    best = int(np.argmin(np.where(np.isfinite(cost), cost, np.inf)))
    hidden = ~seen[best]
    # What was expected is averaged with the depth later, as with any that is measured.
    one = slice(best, best + 1)
    (depths,), (spread,) = _solve(places[one], weights[one], middle, above, before, np.zeros(2))
    chosen = surfaces.sigma[rows, np.minimum(_CHOICES[possible][best], 2)]
    return GirdleDepths(
        np.where(hidden, np.append(depths.mean(), depths), places[best]),
        np.where(hidden, np.append(spread.mean(), spread), chosen),
        hidden & np.isfinite(depths).all(),
    )


def _capped(squares: FloatArray) -> FloatArray:
    return squares * _CAP / (squares + _CAP)


def _solve(
    places: FloatArray,
    weights: FloatArray,
    middle: float,
    above: float,
    before: FloatArray,
    prior: FloatArray,
) -> tuple[FloatArray, FloatArray]:
    """Solve k choices for the depths of both shoulders, and their standard deviations [m]. Shapes (k, 2).

    Args:
        places: Depths of neck and shoulders [m]. Shape (k, 3).
        weights: Inverse variances [1/m^2]. Shape (k, 3).
        middle: Depth of the neck by the head [m].
        above: Its weight.
        before: Depths of the shoulders by the images before [m]. Shape (2,).
        prior: Their weights. Shape (2,).
    """
    own = weights[:, 1:] + prior
    shared = (weights[:, 0] + above) / 4.0
    apart = _TURNED**-2.0
    diagonal = own + (shared + apart)[:, None]
    beside = shared - apart
    right = weights[:, 1:] * places[:, 1:] + prior * before
    right += ((weights[:, 0] * places[:, 0] + above * middle) / 2.0)[:, None]
    determinant = diagonal[:, 0] * diagonal[:, 1] - beside**2
    determinant = np.where(determinant > _SINGULAR, determinant, np.nan)[:, None]
    depths = (diagonal[:, ::-1] * right - beside[:, None] * right[:, ::-1]) / determinant
    return depths, np.sqrt(diagonal[:, ::-1] / determinant)
