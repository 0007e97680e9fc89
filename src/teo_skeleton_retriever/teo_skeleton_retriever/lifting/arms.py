# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The size of the person in a clip, and the depth of elbows and wrists, from the lengths of the arms.

A limb of known length that looks short in the picture points at the viewer or away, and one camera cannot
tell which (Taylor, "Reconstruction of Articulated Objects from Point Correspondences in a Single
Uncalibrated Image", 2000, has a person choose). What bodies can do decides here: elbows are hardly behind the
back, hands are not inside trunk or head and mostly where one signs, elbows and wrists bend only so far, and
nothing jumps from one side to the other between two frames. The cheapest of all courses through the clip is
taken.

Points are as from far away: all of a person has the same scale, what is nearer was drawn in before.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from teo_common.dynamic_programming import cheapest_path
from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.lifting.clip import ELBOW, SHOULDER, SIDES, WRIST, Points
from teo_skeleton_retriever.lifting.depth_smoothing import smooth_depth

# [m] Lengths of an adult's limbs, between the centres of the joints. After Drillis and Contini, "Body Segment
# Parameters" (1966), a person of 1.65 m has arms of 0.31 and 0.24 and acromia 0.43 m apart; joints of
# shoulders, to which and from which detectors measure, are some 4 cm further in and down.
_SHOULDERS, _UPPER_ARM, _FOREARM = 0.36, 0.28, 0.24

# A person turns, and a limb points at the camera: the length is what few frames exceed.
_SHOULDERS_PERCENTILE, _LIMB_PERCENTILE = 90.0, 95.0
# A limb of this share of what the shoulders let expect lay across the view at some time. Shorter, it was
# always foreshortened; longer, something was found wrong. Rendered adults had 0.85 to 1.25.
_FULL_LENGTH = (0.8, 1.35)
# How far a measured length is believed: also an arm that hangs is some 15 deg out of the view.
_TRUST = 0.7
# Confidence of points that are measured, where there are such.
_SURE = 0.3


@dataclass(frozen=True, kw_only=True)
class BodyMeasure:
    """The size of a person.

    Attributes:
        scale: Metres for a unit of the clip.
        upper_arm: Shoulder to elbow [m].
        forearm: Elbow to wrist [m].
        seen: Whether upper arm and forearm were seen at their full length, or follow from the shoulders.
    """

    scale: float
    upper_arm: float
    forearm: float
    seen: tuple[bool, bool]


def measure_body(body: Points, turn: FloatArray) -> BodyMeasure:
    """Measure a person whose shoulders are seen.

    Args:
        body: BODY_25 in the picture.
        turn: How far the trunk is turned aside [rad]. Shape (T,).
    """
    both = [(SHOULDER["left"], SHOULDER["right"])]
    shoulders = float(np.percentile(_lengths(body, both, turn), _SHOULDERS_PERCENTILE))
    limbs, seen = [], []
    for usual, start, end in ((_UPPER_ARM, SHOULDER, ELBOW), (_FOREARM, ELBOW, WRIST)):
        expected = usual / _SHOULDERS * shoulders
        lengths = _lengths(body, [(start[side], end[side]) for side in SIDES])
        longest = float(np.percentile(lengths, _LIMB_PERCENTILE)) if lengths.size else 0.0
        full = _FULL_LENGTH[0] <= longest / expected <= _FULL_LENGTH[1]
        limbs.append(_TRUST * longest + (1.0 - _TRUST) * expected if full else expected)
        seen.append(full)
    # The more of a person was measured the less one odd proportion matters.
    scale = (_SHOULDERS + _UPPER_ARM + _FOREARM) / (shoulders + sum(limbs))
    return BodyMeasure(
        scale=scale, upper_arm=scale * limbs[0], forearm=scale * limbs[1], seen=(seen[0], seen[1])
    )


def _lengths(body: Points, pairs: list[tuple[int, int]], turn: FloatArray | None = None) -> FloatArray:
    """Lengths across the view in all frames in which both ends are sure, or, if there is none, seen.

    Of what lies across a trunk that is turned aside by `turn`, shape (T,), the true length.
    """
    shown = np.ones(len(body.places)) if turn is None else np.cos(turn)
    found = []
    for least in (_SURE, 0.0):
        for first, second in pairs:
            sure = (body.confidence[:, [first, second]] > least).all(axis=1)
            away = body.places[sure, first, 1:] - body.places[sure, second, 1:]
            found.append(np.hypot(away[:, 0] / shown[sure], away[:, 1]))
        if any(len(lengths) for lengths in found):
            break
    return np.concatenate(found)


# Upper arm and forearm: towards the viewer or away.
_SIGNS = np.array([[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]])

# [m] How far in front of the shoulders' centres a wrist is at least: before the trunk, before the head, and
# beside both. A trunk is some 0.2 m deep and its shoulders in the middle of it.
_CHEST, _FACE, _BACK = 0.09, 0.06, -0.05
# [m] Half the breadth of trunk and head; where the head begins and ends above the shoulders.
_TRUNK_HALF, _HEAD_HALF, _HEAD_FROM, _HEAD_TO = 0.15, 0.09, 0.10, 0.35
# [m] The trunk ends at the hips, this far below the shoulders.
_TRUNK_TO = -0.45
# [m] Elbows of arms that hang are so far behind the shoulders, those of signing arms are not.
_ELBOW_BACK = -0.10
# [m] How far wrists mostly are before the shoulders' plane, by their height above the shoulders, and the
# deviation: of forearms that are raised, in 225 signs by rendered people (0.06 m; a person's own signs differ
# more), and of arms that hang.
_RAISED = (-0.45, -0.30, -0.20, -0.05, 0.10), (0.08, 0.15, 0.22, 0.25, 0.19)
_RAISED_DEVIATION = 0.08
_HANGING, _HANGING_DEVIATION = 0.03, 0.05
# Share of both limbs' lengths that a hanging arm has downwards.
_HANGS = 0.85
# [m] Deviation of all of these from person to person.
_INSIDE = 0.03
# [rad] An elbow does not close beyond this angle between upper arm and forearm.
_FOLDED = np.radians(35.0)
_FOLDED_DEVIATION = np.radians(8.0)
# [rad] Wrists are bent by less than the first in nine postures of ten (their end is at 70 to 80 deg).
_WRIST, _WRIST_DEVIATION = np.radians(40.0), np.radians(25.0)
# At most this counts a wrist that is bent too far: the hand's depth is an estimate too.
_HAND_COST = 4.0
# Cost of a forearm against what the detector guesses of its depth, and of one that points away: hands mostly
# sign in front of their elbows.
_DETECTOR, _FORWARD = 0.5, 0.3
# What is true of MediaPipe's depth of an elbow before its shoulder, and what then remains [m], in the takes
# of `lifting.trunk`.
_ELBOW_SHARE, _ELBOW_SIGMA = 0.32, 0.07
# [m/s] Deviation of the speed of elbow and wrist along the view.
_SPEED = 1.5
# [m] What a depth trembles in any case.
_JITTER = 0.02
# [m/s^2] Deviation of a signing wrist's acceleration: 1 Hz over 0.4 m has 8, shakes have 30.
_ACCELERATION = 15.0
# [m] Standard deviation of a point across the view: of one that the detector is sure of, of one that it
# guesses.
_POINT_SIGMA = (0.008, 0.05)
# Standard deviation of a limb's length as a share of it: measured, and by proportion.
_LENGTH_SIGMA = (0.07, 0.12)


class LiftedArm(NamedTuple):
    """How far elbow and wrist are in front of the middle of the shoulders."""

    elbow: FloatArray
    """[m] Shape (T,)."""
    wrist: FloatArray
    """[m] Shape (T,)."""
    elbow_sigma: FloatArray
    """Across the view and along it [m]. Shape (T, 2)."""
    wrist_sigma: FloatArray
    """Likewise. Shape (T, 2)."""


def lift_arm(
    *,
    shoulder: FloatArray,
    elbow: FloatArray,
    wrist: FloatArray,
    confidence: FloatArray,
    guess: FloatArray,
    hand: FloatArray,
    measure: BodyMeasure,
    turn: FloatArray,
    period: float,
) -> LiftedArm:
    """Find the depth of one arm.

    Args:
        shoulder: In front of the middle of the shoulders, left of it and up from it [m]. Shape (T, 3).
        elbow: Left and up likewise; NaN where not seen. Shape (T, 2).
        wrist: Likewise.
        confidence: Of elbow and wrist, 0 to 1. Shape (T, 2).
        guess: How far the detector takes the elbow to be in front of the shoulder and the wrist in front of
            the elbow, in about the scale of what is seen [m]; NaN if unknown. Shape (T, 2).
        hand: Direction from wrist to knuckles, forward, left, up; NaN if unknown. Shape (T, 3).
        measure: Lengths of the arm.
        turn: How far the trunk is turned to the person's own right [rad]. Shape (T,).
        period: Between two frames [s].
    """
    lengths = np.array([measure.upper_arm, measure.forearm])
    across = np.stack([elbow - shoulder[:, 1:], wrist - elbow], axis=1)
    seen = np.linalg.norm(across, axis=2)
    depth = np.sqrt(np.maximum(lengths**2 - seen**2, 0.0))
    point = _POINT_SIGMA[1] + (_POINT_SIGMA[0] - _POINT_SIGMA[1]) * np.sqrt(confidence)
    shares = np.where(measure.seen, *_LENGTH_SIGMA)
    # First order where the limb is foreshortened; where it lies across, the depth is the root of what the
    # length is off by.
    error = np.sqrt((np.minimum(seen, lengths) * point) ** 2 + (lengths**2 * shares) ** 2)
    sigma = error / np.maximum(depth, np.sqrt(error))
    candidates = depth[:, None] * _SIGNS  # (T, 4, 2)
    trunk = _Trunk(turn)
    costs = _costs(candidates, across, shoulder, guess, hand, lengths, trunk)
    places = np.full_like(depth, np.nan)  # in front of the shoulders' middle: elbow, wrist
    known = np.isfinite(costs).all(axis=1)
    if known.any():
        reached = np.cumsum(candidates[known], axis=2) + shoulder[known, :1, None]
        path = cheapest_path(costs[known], reached, 1.0 / (_JITTER + _SPEED * period) ** 2)
        places[known] = reached[np.arange(len(path)), path]
    sigma[:, 1] = np.hypot(sigma[:, 0], sigma[:, 1])
    imagined = shoulder[:, 0] + _ELBOW_SHARE * guess[:, 0]
    places[:, 0], sigma[:, 0] = _together(
        places[:, 0], sigma[:, 0], imagined, np.full(len(turn), _ELBOW_SIGMA)
    )
    usual, deviation = _usual_depth(across, lengths, wrist[:, 1])
    places[:, 1], sigma[:, 1] = _together(
        places[:, 1], sigma[:, 1], trunk.depth(usual, wrist[:, 0]), deviation / np.cos(turn)
    )
    least = _least_depth(trunk.aside(places[:, 1], wrist[:, 0]), wrist[:, 1])
    places[:, 1] = np.maximum(places[:, 1], trunk.depth(least, wrist[:, 0]))
    places = smooth_depth(places, sigma, period=period, acceleration=_ACCELERATION)
    return LiftedArm(
        elbow=shoulder[:, 0] + np.clip(places[:, 0] - shoulder[:, 0], -lengths[0], lengths[0]),
        wrist=places[:, 1],
        elbow_sigma=np.column_stack([point[:, 0], sigma[:, 0]]),
        wrist_sigma=np.column_stack([point[:, 1], sigma[:, 1]]),
    )


class _Trunk:
    """Places before a trunk that is turned aside, and before the camera. Shapes (T,) or (T, n)."""

    def __init__(self, turn: FloatArray) -> None:
        self._cosine, self._sine = np.cos(turn), np.sin(turn)

    def forward(self, depth: FloatArray, left: FloatArray) -> FloatArray:
        """How far a place is before the trunk's plane, by its depth and what is seen [m]."""
        return np.asarray((depth.T * self._cosine - left.T * self._sine).T)

    def aside(self, depth: FloatArray, left: FloatArray) -> FloatArray:
        """How far it is to the left of the trunk's middle [m]."""
        return np.asarray((depth.T * self._sine + left.T * self._cosine).T)

    def depth(self, forward: FloatArray, left: FloatArray) -> FloatArray:
        """The depth of what is so far before the trunk [m]."""
        return np.asarray(((forward.T + left.T * self._sine) / self._cosine).T)


def _together(
    depths: FloatArray, sigma: FloatArray, others: FloatArray, deviation: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Depths that are known in two ways, each by how sure it is; NaN where neither knows it. Shapes (T,).

    What is measured says little where a limb lies across the view or an elbow is guessed.
    """
    known = np.stack([depths, others])
    weights = np.where(np.isfinite(known), 1.0 / np.stack([sigma, deviation]) ** 2, 0.0)
    total = weights.sum(axis=0)
    with np.errstate(invalid="ignore", divide="ignore"):
        return (weights * np.nan_to_num(known)).sum(axis=0) / total, np.sqrt(1.0 / total)


def _costs(
    candidates: FloatArray,
    across: FloatArray,
    shoulder: FloatArray,
    guess: FloatArray,
    hand: FloatArray,
    lengths: FloatArray,
    trunk: _Trunk,
) -> FloatArray:
    """How unlikely each pair of signs is in each frame, by itself. Shape (T, 4)."""
    depths = np.cumsum(candidates, axis=2) + shoulder[:, :1, None]
    seen = np.cumsum(across, axis=1) + shoulder[:, None, 1:]
    left, height = (np.broadcast_to(seen[:, None, :, axis], depths.shape) for axis in (0, 1))
    elbow, wrist = (trunk.forward(depths[..., at], left[..., at]) for at in (0, 1))
    least = _least_depth(trunk.aside(depths[..., 1], left[..., 1]), height[..., 1])
    behind = np.minimum(elbow - _ELBOW_BACK, 0.0) / _INSIDE
    inside = np.minimum(wrist - least, 0.0) / _INSIDE
    limbs = np.concatenate(
        [candidates[..., None], np.broadcast_to(across[:, None], (*candidates.shape, 2))], axis=3
    )
    upper, fore = limbs[:, :, 0], limbs[:, :, 1]
    folded = np.minimum(_angle(-upper, fore) - _FOLDED, 0.0) / _FOLDED_DEVIATION
    bent = np.maximum(_angle(fore, hand[:, None]) - _WRIST, 0.0) / _WRIST_DEVIATION
    bent = np.minimum(np.where(np.isfinite(bent), bent, 0.0) ** 2, _HAND_COST)
    away = np.clip(-candidates[..., 1] / lengths[1], 0.0, 1.0)
    against = (
        np.where(np.isfinite(guess[:, 1]), np.sign(guess[:, 1]), 0.0)[:, None] * candidates[..., 1] < 0.0
    )
    off = np.nan_to_num(candidates[..., 0] - _ELBOW_SHARE * guess[:, :1]) / _ELBOW_SIGMA
    usual, deviation = _usual_depth(across, lengths, seen[:, 1, 1])
    unusual = (wrist - usual[:, None]) / deviation[:, None]
    costs: FloatArray = (
        unusual**2 + behind**2 + inside**2 + folded**2 + bent + _FORWARD * away + _DETECTOR * against + off**2
    )
    return costs


def _usual_depth(
    across: FloatArray, lengths: FloatArray, height: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """How far before the trunk's plane a wrist mostly is, and the deviation [m]. Shapes (T,).

    Args:
        across: Both limbs as they are seen [m]. Shape (T, 2, 2).
        lengths: Of both [m].
        height: Of the wrist above the shoulders [m]. Shape (T,).
    """
    hangs = -across[..., 1].sum(axis=1) > _HANGS * lengths.sum()  # no limb that is not seen hangs
    raised = np.interp(np.nan_to_num(height), *_RAISED)
    return np.where(hangs, _HANGING, raised), np.where(hangs, _HANGING_DEVIATION, _RAISED_DEVIATION)


def _least_depth(aside: FloatArray, height: FloatArray) -> FloatArray:
    """How far before the trunk's plane a wrist is at least, by where it is [m]. Of the same shape."""
    aside = np.abs(aside)
    least = np.full_like(aside, _BACK)
    least[(aside < _TRUNK_HALF) & (height > _TRUNK_TO) & (height <= _HEAD_FROM)] = _CHEST
    least[(aside < _HEAD_HALF) & (height > _HEAD_FROM) & (height < _HEAD_TO)] = _FACE
    return least


def _angle(first: FloatArray, second: FloatArray) -> FloatArray:
    with np.errstate(invalid="ignore", divide="ignore"):
        cosine = (first * second).sum(axis=-1) / (
            np.linalg.norm(first, axis=-1) * np.linalg.norm(second, axis=-1)
        )
    angles: FloatArray = np.arccos(np.clip(cosine, -1.0, 1.0))
    return angles
