# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The size of the person in a clip, and the depth of elbows and wrists.

A limb of known length that looks short in the picture points at the viewer or away, and one camera cannot
tell which (Taylor, "Reconstruction of Articulated Objects from Point Correspondences in a Single
Uncalibrated Image", 2000, has a person choose). Where people who sign have their hands decides, and how a
hand is turned: a network that was shown rendered ones gives the depths, and how sure they are.

Points are as from far away: all of a person has the same scale, what is nearer was drawn in before.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from teo_skeleton_retriever.arrays import BoolArray, FloatArray
from teo_skeleton_retriever.lifting.clip import ELBOW, SHOULDER, SIDES, WRIST, Points, smooth_depth
from teo_skeleton_retriever.lifting.network import load_network

# [m] Lengths of an adult's limbs, between the centres of the joints. After Drillis and Contini, "Body Segment
# Parameters" (1966), a person of 1.65 m has arms of 0.31 and 0.24 and acromia 0.43 m apart; joints of
# shoulders, to which and from which detectors measure, are some 4 cm further in and down.
_SHOULDERS, _UPPER_ARM, _FOREARM = 0.36, 0.28, 0.24
# [m] Everybody is taken to be as large as one whose shoulders, upper arm and forearm are so long together.
ADULT = _SHOULDERS + _UPPER_ARM + _FOREARM

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
    """

    scale: float
    upper_arm: float
    forearm: float


def measure_body(body: Points, turn: FloatArray) -> BodyMeasure:
    """Measure a person whose shoulders are seen, in BODY_25, by how far the trunk is turned aside [rad]."""
    both = [(SHOULDER["left"], SHOULDER["right"])]
    shoulders = float(np.percentile(_lengths(body, both, turn), _SHOULDERS_PERCENTILE))
    limbs = []
    for usual, start, end in ((_UPPER_ARM, SHOULDER, ELBOW), (_FOREARM, ELBOW, WRIST)):
        expected = usual / _SHOULDERS * shoulders
        lengths = _lengths(body, [(start[side], end[side]) for side in SIDES])
        longest = float(np.percentile(lengths, _LIMB_PERCENTILE)) if lengths.size else 0.0
        full = _FULL_LENGTH[0] <= longest / expected <= _FULL_LENGTH[1]
        limbs.append(_TRUST * longest + (1.0 - _TRUST) * expected if full else expected)
    # The more of a person was measured the less one odd proportion matters.
    scale = ADULT / (shoulders + sum(limbs))
    return BodyMeasure(scale=scale, upper_arm=scale * limbs[0], forearm=scale * limbs[1])


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


# [m] How far in front of the shoulders' centres a wrist is at least: before the trunk, before the head, and
# beside both. A trunk is some 0.2 m deep and its shoulders in the middle of it.
_CHEST, _FACE, _BACK = 0.09, 0.06, -0.05
# [m] Half the breadth of trunk and head; where the head begins and ends above the shoulders.
_TRUNK_HALF, _HEAD_HALF, _HEAD_FROM, _HEAD_TO = 0.15, 0.09, 0.10, 0.35
# [m] The trunk ends at the hips, this far below the shoulders.
_TRUNK_TO = -0.45
# Of people whom the network was not shown 89 % are within two of the deviations that it claims: these are
# larger by so much.
_UNSEEN = 1.25
# [m] Deviations that it may claim: of two fingers' breadth, of a forearm.
_SIGMAS = 0.02, 0.25
# [m/s^2] Deviation of a signing wrist's acceleration: 1 Hz over 0.4 m has 8, shakes have 30.
_ACCELERATION = 15.0
# [m] Standard deviation of a point across the view: of one that the detector is sure of, of one that it
# guesses.
_POINT_SIGMA = (0.008, 0.05)


class SeenArm(NamedTuple):
    """What is seen of an arm, from the middle of the shoulders: NaN where nothing is."""

    shoulder: FloatArray
    """Forward, left, up [m]. Shape (T, 3)."""
    elbow: FloatArray
    """Left and up [m]. Shape (T, 2)."""
    wrist: FloatArray
    """Likewise."""
    other: FloatArray
    """The other arm's wrist, likewise."""
    guess: FloatArray
    """How far the detector takes the elbow to be in front of the shoulder and the wrist in front of the
    elbow, in about the scale of what is seen [m]. Shape (T, 2)."""
    hand: FloatArray
    """From the wrist to the knuckles, forward, left, up [m]. Shape (T, 3)."""
    turn: FloatArray
    """How far the trunk is turned to the person's own right [rad]. Shape (T,)."""
    lengths: tuple[float, float]
    """Of upper arm and forearm [m]."""
    right: bool
    """Whether it is the right arm."""


def arm_inputs(arm: SeenArm) -> FloatArray:
    """What the network sees of an arm, a left one as the right one that mirrors it. Shape (T, 20)."""
    side = 1.0 if arm.right else -1.0
    limbs = np.stack([arm.elbow - arm.shoulder[:, 1:], arm.wrist - arm.elbow], axis=1)
    shortened = np.sqrt(np.maximum(np.square(arm.lengths) - (limbs**2).sum(axis=2), 0.0))
    across = np.array([side, 1.0])
    parts = (
        limbs[:, 0] * across,
        limbs[:, 1] * across,
        shortened,
        arm.other * across,
        arm.hand * (1.0, side, 1.0),
        arm.guess,
    )
    seen: list[BoolArray] = [np.asarray(np.isfinite(part).all(axis=1)) for part in parts]
    return np.column_stack(
        [
            arm.wrist * across,
            *(np.where(known[:, None], part, 0.0) for known, part in zip(seen, parts, strict=True)),
            side * arm.turn,
            *(known.astype(np.float64) for known in (seen[0], *seen[3:])),
        ]
    )


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


def lift_arm(arm: SeenArm, confidence: FloatArray, period: float) -> LiftedArm:
    """Find the depth of one arm.

    Args:
        arm: What is seen of it.
        confidence: Of elbow and wrist, 0 to 1. Shape (T, 2).
        period: Between two frames [s].
    """
    point = _POINT_SIGMA[1] + (_POINT_SIGMA[0] - _POINT_SIGMA[1]) * np.sqrt(confidence)
    found = load_network("arms")(arm_inputs(arm))
    places, sigma = found[:, :2], np.clip(_UNSEEN * np.exp(found[:, 2:]), *_SIGMAS)
    least = _least_depth(_aside(places[:, 1], arm.wrist[:, 0], arm.turn), arm.wrist[:, 1])
    places[:, 1] = np.maximum(places[:, 1], _depth(least, arm.wrist[:, 0], arm.turn))
    places = smooth_depth(places, sigma, period=period, acceleration=_ACCELERATION)
    elbow, upper = arm.shoulder[:, 0], arm.lengths[0]
    return LiftedArm(
        elbow=np.clip(places[:, 0], elbow - upper, elbow + upper),
        wrist=places[:, 1],
        elbow_sigma=np.column_stack([point[:, 0], sigma[:, 0]]),
        wrist_sigma=np.column_stack([point[:, 1], sigma[:, 1]]),
    )


def _aside(depth: FloatArray, left: FloatArray, turn: FloatArray) -> FloatArray:
    """How far a place is to the left of the trunk's middle, by its depth and what is seen [m]."""
    return np.asarray(depth * np.sin(turn) + left * np.cos(turn))


def _depth(forward: FloatArray, left: FloatArray, turn: FloatArray) -> FloatArray:
    """The depth of what is so far before the trunk [m]."""
    return np.asarray((forward + left * np.sin(turn)) / np.cos(turn))


def _least_depth(aside: FloatArray, height: FloatArray) -> FloatArray:
    """How far before the trunk's plane a wrist is at least, by where it is [m]. Of the same shape."""
    aside = np.abs(aside)
    least = np.full_like(aside, _BACK)
    least[(aside < _TRUNK_HALF) & (height > _TRUNK_TO) & (height <= _HEAD_FROM)] = _CHEST
    least[(aside < _HEAD_HALF) & (height > _HEAD_FROM) & (height < _HEAD_TO)] = _FACE
    return least
