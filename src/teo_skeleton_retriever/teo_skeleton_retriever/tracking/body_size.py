# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How large a person is: limb lengths and one scale, estimated for as long as the person is seen."""

from __future__ import annotations

import math

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.layouts.layout import BODY_25

_WINDOW = 300  # lengths that count: 10 s at 30 images a second, then a bad start is gone
_SHORTEST, _LONGEST = 0.08, 0.65  # [m] half a child's forearm, a tall man's thigh with room to spare
# A limb is too long beyond this many times its estimate. The original's 2 lets an arm that touches the
# background pass; the lengths of visible limbs were seen within 1.3 on recordings.
_TOLERANCE = 1.4


class LimbLength:
    """Weighted median of recent lengths.

    A limb across the view is measured by pixels, one along the view by its two depths, which err by
    centimetres and which the limb's own far end may hide: each length counts by the fourth power of the share
    that lies across.
    """

    def __init__(self, *, min_samples: int = 10) -> None:
        """Know nothing yet; fewer lengths than `min_samples`, a third of a second, make no estimate."""
        self._min_samples = min_samples
        self._samples = np.zeros((_WINDOW, 2))  # lengths and weights, the oldest overwritten
        self._count = 0  # of all lengths so far
        self.weight = 0.0
        """Sum of the weights of the lengths: their number if all were seen across the view."""
        self.value: float | None = None
        """The estimate [m]; None while too few lengths were seen."""

    def step(self, near: FloatArray, far: FloatArray) -> None:
        """Take the measured ends of the limb; lengths outside the human range do not count.

        Args:
            near: [m]. Shape (3,).
            far: Likewise. Do not feed ends that were held or optimised: that would confirm the old estimate.
        """
        across, along = math.hypot(*(far[:2] - near[:2])), float(far[2] - near[2])
        length = math.hypot(across, along)
        if not _SHORTEST <= length <= _LONGEST:
            return
        # A floor, so that an arm that only ever points at the camera is estimated too.
        self._samples[self._count % len(self._samples)] = length, (across / length) ** 4 + 0.001
        self._count += 1
        recent = self._samples[: self._count]
        self.weight = float(recent[:, 1].sum())
        if len(recent) >= self._min_samples:
            self.value = _weighted_median(recent)

    def too_long(self, length: float) -> bool:
        """Whether a length [m] exceeds the estimate by more than the tolerance; False without one."""
        return self.value is not None and length > _TOLERANCE * self.value


def _weighted_median(samples: FloatArray) -> float:
    ordered = samples[np.argsort(samples[:, 0], kind="stable")]
    reached = np.cumsum(ordered[:, 1])
    return float(ordered[int(np.searchsorted(reached, reached[-1] / 2.0)), 0])


# What is measured; both sides of a person are one length.
_LIMBS: dict[str, tuple[tuple[str, str], ...]] = {
    "shoulders": (("RShoulder", "LShoulder"),),
    "upper arm": (("RShoulder", "RElbow"), ("LShoulder", "LElbow")),
    "forearm": (("RElbow", "RWrist"), ("LElbow", "LWrist")),
    "thigh": (("RHip", "RKnee"), ("LHip", "LKnee")),
    "shank": (("RKnee", "RAnkle"), ("LKnee", "LAnkle")),
}
# [m] Of an adult, between the joints, by 27 rendered people. Limbs of 1.7 m after
# Drillis and Contini, "Body Segment Parameters" (1966): 0.29 and 0.25.
_AVERAGE = {"shoulders": 0.36, "upper arm": 0.274, "forearm": 0.236}
# Power of the shoulders' width that a limb grows with: broad shoulders are not long arms.
_GROWTH = {"upper arm": 0.4, "forearm": 0.8}
# [m] How far a limb's length is from that of average people with such shoulders: of these people 10 and 15
# mm, but with 0.016 and 0.02 the elbows of bodies built otherwise came out 2 mm worse.
_SPREAD = {"upper arm": 0.03, "forearm": 0.03}
# [m] How far the length that is measured is off however often it is, as a detector errs for a person in the
# same way. MediaPipe guesses the elbows of forearms that point at the camera: 16 and 10 mm for these people.
_OFF = 0.005
_MEDIAPIPE_OFF = {"upper arm": 0.018, "forearm": 0.012}
_SINGLE_OFF = 0.04  # [m] and how far a single length is
_HAND = (1.04, 0.7)  # size of a hand of someone of average shoulders, and the power that it grows with
# Power of the width that MediaPipe sees that the shoulders' width grows with: to the network everybody is
# rather average. Of the 27 people, whose shoulders were 0.28 to 0.44 m wide, it saw 0.31 to 0.405 m.
_REGRESSION = 1.4
_ASSUMED_WIDTH = 1.5  # widths seen across the view that outweigh what is assumed of a person
_SCALE_RANGE = (0.55, 1.35)  # a child of six; a man of 2.1 m with broad shoulders

_ROWS = {limb: [(BODY_25.index[a], BODY_25.index[b]) for a, b in pairs] for limb, pairs in _LIMBS.items()}


def widened(pair: FloatArray, share: float) -> FloatArray:
    """Move two points apart so that their distance is this many times what it was. Shape (2, k)."""
    middle = pair.mean(axis=0)
    moved: FloatArray = middle + share * (pair - middle)
    return moved


class BodySize:
    """Estimates the lengths of a person's limbs, and how large they are against an average adult."""

    def __init__(self, *, averaging: bool = False) -> None:
        """Know nothing of the person yet.

        Args:
            averaging: Whether the detector, as MediaPipe, puts everybody's shoulders rather where an average
                person has them.
        """
        self._lengths = {limb: LimbLength() for limb in _LIMBS}
        # The first width tells more than nothing, which `_ASSUMED_WIDTH` weighs.
        self._lengths["shoulders"] = LimbLength(min_samples=1)
        self._power = _REGRESSION if averaging else 1.0
        self._off = _MEDIAPIPE_OFF if averaging else dict.fromkeys(_GROWTH, _OFF)
        self._seen_scale = 1.0

    def step(self, points: FloatArray, *, outlined: bool = False) -> None:
        """Take the joints of one image: only measured ones, as others would confirm the old estimate.

        Args:
            points: [m], NaN where not measured. Shape (25, 3).
            outlined: Whether both shoulders are where the body's outline says, not widened.
        """
        points = self._as_seen(points, outlined=outlined)
        measured = np.isfinite(points[:, 2])
        for limb, pairs in _ROWS.items():
            for a, b in pairs:
                if measured[a] and measured[b]:
                    self._lengths[limb].step(points[a], points[b])
        width, weight = self._lengths["shoulders"].value, self._lengths["shoulders"].weight
        if width is not None:
            ratio = width / _AVERAGE["shoulders"]
            self._seen_scale = (ratio * weight + _ASSUMED_WIDTH) / (weight + _ASSUMED_WIDTH)

    @property
    def scale(self) -> float:
        """Size against an average adult, by the shoulders; 1 while nothing is known."""
        smallest, largest = _SCALE_RANGE
        return min(max(math.pow(self._seen_scale, self._power), smallest), largest)

    @property
    def hand_scale(self) -> float:
        """Size of the hands against those of an average adult; people's hands differ less than shoulders."""
        size, growth = _HAND
        return float(size * self.scale**growth)

    @property
    def widening(self) -> float:
        """How much wider the shoulders are than the detector sees them."""
        return self.scale / self._seen_scale

    def _as_seen(self, points: FloatArray, *, outlined: bool) -> FloatArray:
        """Put the shoulders as wide as the detector sees them, or would see those of such a width."""
        pair = list(_ROWS["shoulders"][0])
        share = 1.0 / self.widening
        if outlined:
            ratio = float(np.linalg.norm(points[pair[1]] - points[pair[0]])) / _AVERAGE["shoulders"]
            share = math.pow(ratio, 1.0 / self._power - 1.0)
        seen = points.copy()
        seen[pair] = widened(points[pair], share)
        return seen

    def length(self, limb: str) -> tuple[float, float]:
        """Give the length of "upper arm" or "forearm" and its sigma [m].

        What is measured and what goes with such shoulders are averaged, each by how far it may be off.
        """
        assumed = _AVERAGE[limb] * self.scale ** _GROWTH[limb]
        value, weight = self._lengths[limb].value, self._lengths[limb].weight
        if value is None:
            return assumed, _SPREAD[limb]
        spread = _SPREAD[limb] ** 2
        off = self._off[limb] ** 2 + _SINGLE_OFF**2 / weight
        share = spread / (spread + off)
        return share * value + (1.0 - share) * assumed, math.sqrt(share * off)

    def too_long(self, limb: str, length: float) -> bool:
        """Whether a length [m] exceeds the estimate by more than the tolerance; False without one."""
        return self._lengths[limb].too_long(length)
