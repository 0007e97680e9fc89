"""How large a person is: limb lengths and one scale, estimated for as long as the person is seen."""

from __future__ import annotations

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.layouts.body_25 import BODY_25
from teo_skeleton_retriever.tracking.limb_length import LimbLength, LimbLengthSettings

_LIMBS: dict[str, tuple[tuple[str, str], ...]] = {
    "shoulders": (("RShoulder", "LShoulder"),),
    "upper arm": (("RShoulder", "RElbow"), ("LShoulder", "LElbow")),
    "forearm": (("RElbow", "RWrist"), ("LElbow", "LWrist")),
    "thigh": (("RHip", "RKnee"), ("LHip", "LKnee")),
    "shank": (("RKnee", "RAnkle"), ("LKnee", "LAnkle")),
}
"""What is measured; both sides of a person are one length."""
_AVERAGE = {"shoulders": 0.36, "upper arm": 0.274, "forearm": 0.236, "thigh": 0.42, "shank": 0.42}
"""[m] Of an adult, between the joints. The first three by the 27 people of `bench/accuracy_tuning.py`; limbs
of 1.7 m after Drillis and Contini, "Body Segment Parameters" (1966): 0.29, 0.25, 0.42 and 0.42."""
_GROWTH = {"upper arm": 0.4, "forearm": 0.8, "thigh": 0.5, "shank": 0.5}
"""Power of the shoulders' width that a limb grows with: broad shoulders are not long arms."""
_ASSUMED = 5.0  # lengths seen across the view that outweigh what is assumed of a person: a third of a second
_HAND = (1.04, 0.7)  # size of a hand of someone of average shoulders, and the power that it grows with
_REGRESSION = 1.4
"""Power of the width that MediaPipe sees that the shoulders' width grows with: to the network everybody is
rather average. Of the 27 people, whose shoulders were 0.28 to 0.44 m wide, it saw 0.31 to 0.405 m."""
_FIRST = LimbLengthSettings(min_samples=1)
"""Of the shoulders: the first width tells more than nothing, which `_ASSUMED` weighs."""
_ASSUMED_WIDTH = 1.5  # likewise of the shoulders, which are nearly always seen across the view
_LENGTH_SIGMA = (0.010, 0.04)  # [m] of a limb whose length was measured, and of one that was not
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
            averaging: whether the detector, as MediaPipe, puts everybody's shoulders rather where an average
                person has them.
        """
        self._lengths = {limb: LimbLength(_FIRST if limb == "shoulders" else None) for limb in _LIMBS}
        self._power = _REGRESSION if averaging else 1.0
        self._seen_scale = 1.0

    def step(self, points: FloatArray) -> None:
        """Take the joints of one image: only measured ones, as others would confirm the old estimate.

        Args:
            points: [m], NaN where not measured. Shape (25, 3).
        """
        points = self._as_seen(points)
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
        return float(np.clip(self._seen_scale**self._power, *_SCALE_RANGE))

    @property
    def hand_scale(self) -> float:
        """Size of the hands against those of an average adult; people's hands differ less than shoulders."""
        size, growth = _HAND
        return float(size * self.scale**growth)

    @property
    def widening(self) -> float:
        """How much wider the shoulders are than the detector sees them."""
        return self.scale / self._seen_scale

    def _as_seen(self, points: FloatArray) -> FloatArray:
        """Undo the widening of the shoulders."""
        pair = list(_ROWS["shoulders"][0])
        seen = points.copy()
        seen[pair] = widened(points[pair], 1.0 / self.widening)
        return seen

    def length(self, limb: str) -> tuple[float, float]:
        """Give a limb's length and its sigma [m]: by proportion to the shoulders while little was seen."""
        assumed = _AVERAGE[limb] * self.scale ** _GROWTH[limb]
        value, weight = self._lengths[limb].value, self._lengths[limb].weight
        if value is None:
            return assumed, _LENGTH_SIGMA[1]
        share = weight / (weight + _ASSUMED)
        sigma = share * _LENGTH_SIGMA[0] + (1.0 - share) * _LENGTH_SIGMA[1]
        return share * value + (1.0 - share) * assumed, sigma

    def too_long(self, limb: str, length: float) -> bool:
        """Tell whether a measured length [m] is beyond belief; never before there is an estimate."""
        return self._lengths[limb].too_long(length)
