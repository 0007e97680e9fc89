# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Neck and shoulders: the depths of their joints, and where the body's outline puts shoulders in the image.

A hand or a forearm before a shoulder is no less a surface than the shoulder is. What tells them apart is that
the neck lies midway between the shoulders, that the head is over them, and where they were before: every
choice of a surface for each of the three, or of none, is solved by least squares, and the likeliest is taken.

A network puts everybody's shoulders about as wide as an average person's. How wide they are the depth image
shows: an arm that does not point outwards ends a muscle's breadth beside its joint.
"""

from __future__ import annotations

from itertools import product
from typing import NamedTuple

import numpy as np

from teo_skeleton_retriever.arrays import BoolArray, DepthArray, FloatArray
from teo_skeleton_retriever.depth.depth_lookup import Surfaces
from teo_skeleton_retriever.layouts.layout import BODY_25

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


_SHOULDERS = [BODY_25.index["RShoulder"], BODY_25.index["LShoulder"]]
_ELBOWS = [BODY_25.index["RElbow"], BODY_25.index["LElbow"]]
# [m] From the joint to the outline, of an average adult: of rendered people 0.047 to 0.050 (standard
# deviation 0.007), and how far the outline is looked for from where the detector sees the joint.
_TO_OUTLINE, _LOOKED_AT = 0.049, 0.14
_CLEAR = 0.03  # [m] of what is looked at that has to be beyond the outline: else the body goes on
# [m] From the joint's depth: what is nearer hides it, what is farther is not it.
_BEFORE, _BEHIND = 0.20, 0.15
_OUTWARDS = 0.07  # [m] of an elbow beside its shoulder: then the arm is seen in place of the outline
_OUTLINE_TURNED = 0.12  # [m] between both depths: of who is turned by 20 deg it is another outline
_FARTHEST = 0.05  # [m] from where the detector sees the joint: more is a hole in the depth, or a coat
# Share of the way to where the outline puts the joint: variances of 9 and of 16 mm for the detector's.
_SHARE = 0.75


class OutlinedBody(NamedTuple):
    """A body whose shoulders are where its outline says."""

    keypoints: FloatArray
    """x, y [px], confidence. Shape (25, 3)"""
    outlined: BoolArray
    """whether the right and the left shoulder's outline was found; else they are as they were. Shape (2,)"""


def by_outline(
    body: FloatArray, depth: DepthArray, *, at: FloatArray, focal: float, scale: float
) -> OutlinedBody:
    """Move shoulders to where the body's outline says they are.

    Args:
        body: As the detector sees it, x, y [px], confidence; absent keypoints are zero. Shape (25, 3).
        depth: Of the image [m], NaN where unknown. Shape (height, width).
        at: Depths of the right and the left shoulder [m]. Shape (2,).
        focal: Length of the camera [px].
        scale: Of the person against an average adult.
    """
    moved, outlined = body.copy(), np.zeros(2, dtype=bool)
    shoulders, elbows = body[_SHOULDERS, :2], body[_ELBOWS, :2]
    across = shoulders[1] - shoulders[0]
    width = float(np.hypot(*across))
    seen = (body[[*_SHOULDERS, *_ELBOWS], 2] > 0.0).all()
    if not seen or width < 1.0 or not abs(at[0] - at[1]) < _OUTLINE_TURNED:
        return OutlinedBody(moved, outlined)
    for i, outwards in enumerate((-across / width, across / width)):
        metres = float(at[i]) / focal  # of a pixel
        if (elbows[i] - shoulders[i]) @ outwards * metres > _OUTWARDS * scale:
            continue
        steps = np.arange(0.0, _LOOKED_AT * scale / metres)
        outline = _outline(_along(depth, shoulders[i] + steps[:, None] * outwards), float(at[i])) * metres
        off = outline - _TO_OUTLINE * scale
        if outline < (_LOOKED_AT - _CLEAR) * scale and abs(off) < _FARTHEST:
            moved[_SHOULDERS[i], :2] += _SHARE * off / metres * outwards
            outlined[i] = True
    return OutlinedBody(moved, outlined)


def _along(depth: DepthArray, pixels: FloatArray) -> FloatArray:
    """Depths at pixels [m]; outside the image, where nothing is known, -inf. Shape (n,)."""
    columns, rows = np.rint(pixels).astype(np.int64).T
    height, width = depth.shape
    inside = (columns >= 0) & (columns < width) & (rows >= 0) & (rows < height)
    return np.where(inside, depth[np.where(inside, rows, 0), np.where(inside, columns, 0)], -np.inf)


def _outline(depths: FloatArray, joint: float) -> float:
    """Number of steps to the last one on the body; NaN if something else is before it.

    Args:
        depths: From the joint outwards, NaN where unknown [m]. Shape (n,).
        joint: Its depth [m].
    """
    with np.errstate(invalid="ignore"):
        beyond = np.flatnonzero(depths > joint + _BEHIND)
        body = depths[: beyond[0] if len(beyond) else len(depths)] - joint
        if (body < -_BEFORE).any():
            return np.nan
    on = np.flatnonzero(np.isfinite(body))
    return float(on[-1]) + 0.5 if len(on) else np.nan
