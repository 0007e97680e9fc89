# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Where shoulders are along the line through them, by the body's outline in the depth image.

A network puts everybody's shoulders about as wide as an average person's. How wide they are the depth image
shows: an arm that does not point outwards ends a muscle's breadth beside its joint.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from teo_skeleton_retriever.arrays import BoolArray, DepthArray, FloatArray
from teo_skeleton_retriever.layouts.layout import BODY_25

_SHOULDERS = [BODY_25.index["RShoulder"], BODY_25.index["LShoulder"]]
_ELBOWS = [BODY_25.index["RElbow"], BODY_25.index["LElbow"]]
# [m] From the joint to the outline, of an average adult: of rendered people 0.047 to 0.050 (standard
# deviation 0.007), and how far the outline is looked for from where the detector sees the joint.
_TO_OUTLINE, _LOOKED_AT = 0.049, 0.14
_CLEAR = 0.03  # [m] of what is looked at that has to be beyond the outline: else the body goes on
_BEFORE, _BEHIND = (
    0.20,
    0.15,
)  # [m] from the joint's depth: what is nearer hides it, what is farther is not it
_OUTWARDS = 0.07  # [m] of an elbow beside its shoulder: then the arm is seen in place of the outline
_TURNED = 0.12  # [m] between the depths of both: of somebody turned by 20 deg the outline is another's
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
    if not seen or width < 1.0 or not abs(at[0] - at[1]) < _TURNED:
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
