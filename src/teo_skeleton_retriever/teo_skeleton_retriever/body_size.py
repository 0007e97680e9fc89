"""How large a person is: limb lengths and one scale, estimated for as long as the person is seen."""

from __future__ import annotations

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.body_25 import BODY_25
from teo_skeleton_retriever.limb_length import LimbLength

_LIMBS: dict[str, tuple[tuple[str, str], ...]] = {
    "shoulders": (("RShoulder", "LShoulder"),),
    "upper arm": (("RShoulder", "RElbow"), ("LShoulder", "LElbow")),
    "forearm": (("RElbow", "RWrist"), ("LElbow", "LWrist")),
    "thigh": (("RHip", "RKnee"), ("LHip", "LKnee")),
    "shank": (("RKnee", "RAnkle"), ("LKnee", "LAnkle")),
}
"""What is measured; both sides of a person are one length."""
_AVERAGE = {"shoulders": 0.36, "upper arm": 0.28, "forearm": 0.24, "thigh": 0.42, "shank": 0.42}
"""[m] Of an adult, between the joints. Rendered adults had 0.32 to 0.42, 0.27 to 0.29 and 0.22 to 0.27; limbs
of 1.7 m after Drillis and Contini, "Body Segment Parameters" (1966): 0.29, 0.25, 0.42 and 0.42."""
_GROWTH = {"upper arm": 0.5, "forearm": 1.0, "thigh": 0.5, "shank": 0.5}
"""Power of the shoulders' width that a limb grows with: broad shoulders are not long arms."""
_ASSUMED = 5.0  # lengths seen across the view that outweigh what is assumed of a person: a third of a second
_LENGTH_SIGMA = (0.010, 0.04)  # [m] of a limb whose length was measured, and of one that was not
_SCALE_RANGE = (0.55, 1.35)  # a child of six; a man of 2.1 m with broad shoulders

_ROWS = {limb: [(BODY_25.index[a], BODY_25.index[b]) for a, b in pairs] for limb, pairs in _LIMBS.items()}


class BodySize:
    """Estimates the lengths of a person's limbs, and how large they are against an average adult."""

    def __init__(self) -> None:
        self._lengths = {limb: LimbLength() for limb in _LIMBS}

    def step(self, points: FloatArray) -> None:
        """Take the joints of one image: only measured ones, as others would confirm the old estimate.

        Args:
            points: [m], NaN where not measured. Shape (25, 3).
        """
        measured = np.isfinite(points[:, 2])
        for limb, pairs in _ROWS.items():
            for a, b in pairs:
                if measured[a] and measured[b]:
                    self._lengths[limb].step(points[a], points[b])

    @property
    def scale(self) -> float:
        """Size against an average adult, by the shoulders; 1 while nothing is known."""
        width, weight = self._lengths["shoulders"].value, self._lengths["shoulders"].weight
        if width is None:
            return 1.0
        ratio = (width / _AVERAGE["shoulders"] * weight + _ASSUMED) / (weight + _ASSUMED)
        return float(np.clip(ratio, *_SCALE_RANGE))

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
