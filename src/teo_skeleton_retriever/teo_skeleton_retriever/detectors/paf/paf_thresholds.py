"""From when on a part, a limb and a person count. Source: OpenPose's defaults, `poseParameters.cpp`."""

from __future__ import annotations

from typing import NamedTuple


class PafThresholds(NamedTuple):
    """How much is believed."""

    peak: float = 0.05
    """confidence above which a maximum is a part"""
    along_limb: float = 0.05
    """component of the field along the limb above which a place on it agrees, in [0, 1]"""
    agreeing: float = 0.95
    """share of places that must agree"""
    parts: int = 3
    """parts that a person has at least"""
    score: float = 0.4
    """mean score of a person's parts, limbs counted in, at least"""


CAREFUL = PafThresholds()
"""Few people who are not there."""
GENEROUS = PafThresholds(peak=0.02, along_limb=0.01, agreeing=0.75, parts=2, score=0.05)
"""Few people missed: OpenPose's `--maximize_positives`."""
