"""How large a person is: limb lengths and one scale, estimated for as long as the person is seen."""

from __future__ import annotations

import numpy as np

from teo_skeleton_retriever.arrays import BoolArray, FloatArray
from teo_skeleton_retriever.body_25 import BODY_25
from teo_skeleton_retriever.limb_length import LimbLength

SHOULDER_WIDTH = 0.34
"""[m] Between the shoulder joints of an average adult: 0.2 of a stature of 1.7 m.
Source: Drillis and Contini, "Body Segment Parameters" (1966), 0.259 of it between the outer edges of both
shoulders less the muscles."""

_LIMBS: dict[str, tuple[tuple[str, str], ...]] = {
    "shoulders": (("RShoulder", "LShoulder"),),
    "upper arm": (("RShoulder", "RElbow"), ("LShoulder", "LElbow")),
    "forearm": (("RElbow", "RWrist"), ("LElbow", "LWrist")),
    "thigh": (("RHip", "RKnee"), ("LHip", "LKnee")),
    "shank": (("RKnee", "RAnkle"), ("LKnee", "LAnkle")),
}
"""What is measured; both sides of a person are one length."""
_AVERAGE = {"shoulders": 0.34, "upper arm": 0.29, "forearm": 0.25, "thigh": 0.42, "shank": 0.42}
"""[m] Of an adult of 1.7 m, between the joints: 0.2, 0.172, 0.146, 0.245 and 0.246 of it, as above."""
_SCALE_RANGE = (0.55, 1.35)  # a child of six; a man of 2.1 m with broad shoulders

_ROWS = {limb: [(BODY_25.index[a], BODY_25.index[b]) for a, b in pairs] for limb, pairs in _LIMBS.items()}


class BodySize:
    """Estimates the lengths of a person's limbs, and how large they are against an average adult."""

    def __init__(self) -> None:
        self._lengths = {limb: LimbLength() for limb in _LIMBS}

    def step(self, points: FloatArray, measured: BoolArray) -> None:
        """Take the joints of one image.

        Args:
            points: [m]. Shape (25, 3).
            measured: which count; held and optimised ones would confirm the old estimate. Shape (25,).
        """
        for limb, pairs in _ROWS.items():
            for a, b in pairs:
                if measured[a] and measured[b]:
                    self._lengths[limb].step(points[a], points[b])

    @property
    def scale(self) -> float:
        """Size against an average adult: mean over shoulders and arms of what is known; 1 if nothing is."""
        ratios = [
            value / _AVERAGE[limb]
            for limb in ("shoulders", "upper arm", "forearm")
            if (value := self._lengths[limb].value) is not None
        ]
        return float(np.clip(np.mean(ratios), *_SCALE_RANGE)) if ratios else 1.0

    def length(self, limb: str) -> float | None:
        """Length of a limb [m]; None while too little was seen of it."""
        return self._lengths[limb].value

    def likely_length(self, limb: str) -> tuple[float, bool]:
        """Length of a limb [m], by its proportion to the rest while it is not known, and whether it is."""
        value = self._lengths[limb].value
        return (value, True) if value is not None else (_AVERAGE[limb] * self.scale, False)

    def too_long(self, limb: str, length: float) -> bool:
        """Tell whether a measured length [m] is beyond belief; never before there is an estimate."""
        return self._lengths[limb].too_long(length)
