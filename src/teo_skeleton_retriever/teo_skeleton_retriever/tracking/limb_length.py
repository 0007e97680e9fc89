"""The length of a limb, estimated robustly and for as long as the person is seen."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.errors import LimbError


@dataclass(frozen=True, kw_only=True)
class LimbLengthSettings:
    """How a limb length is estimated.

    Attributes:
        window: number of lengths that count: 10 s at 30 images a second, then a bad start is gone.
        min_samples: fewer make no estimate: a third of a second.
        shortest: a shorter length is a wrong detection [m]: half a child's forearm.
        longest: a longer one too [m]: a tall man's thigh with room to spare.
        tolerance: a limb is too long beyond this many times its estimate. The original's 2 lets an arm that
            touches the background pass; the lengths of visible limbs were seen within 1.3 on recordings.
    """

    window: int = 300
    min_samples: int = 10
    shortest: float = 0.08
    longest: float = 0.65
    tolerance: float = 1.4

    def __post_init__(self) -> None:
        if not 1 <= self.min_samples <= self.window:
            raise LimbError(
                "bad_window", f"expected 1 <= min_samples <= window, got {self.min_samples}, {self.window}"
            )
        if not 0.0 < self.shortest < self.longest < math.inf or not 1.0 < self.tolerance < math.inf:
            raise LimbError("bad_range", "expected 0 < shortest < longest [m] and a tolerance above 1")


class LimbLength:
    """Weighted median of recent lengths.

    A limb across the view is measured by pixels, one along the view by its two depths, which err by
    centimetres and which the limb's own far end may hide: each length counts by the fourth power of the share
    that lies across.
    """

    def __init__(self, settings: LimbLengthSettings | None = None) -> None:
        self._settings = settings or LimbLengthSettings()
        self._samples = np.zeros((self._settings.window, 2))  # lengths and weights, the oldest overwritten
        self._count = 0  # of all lengths so far
        self._weight = 0.0
        self._value: float | None = None

    def step(self, near: FloatArray, far: FloatArray) -> None:
        """Take the measured ends of the limb; lengths outside the human range do not count.

        Args:
            near: [m]. Shape (3,).
            far: likewise. Do not feed ends that were held or optimised: that would confirm the old estimate.
        """
        across, along = math.hypot(*(far[:2] - near[:2])), float(far[2] - near[2])
        length = math.hypot(across, along)
        if not self._settings.shortest <= length <= self._settings.longest:
            return
        # A floor, so that an arm that only ever points at the camera is estimated too.
        self._samples[self._count % len(self._samples)] = length, (across / length) ** 4 + 0.001
        self._count += 1
        recent = self._recent()
        self._weight = float(recent[:, 1].sum())
        if len(recent) >= self._settings.min_samples:
            self._value = _weighted_median(recent)

    @property
    def value(self) -> float | None:
        """The estimate [m]; None while too few lengths were seen."""
        return self._value

    @property
    def weight(self) -> float:
        """How many lengths the estimate rests on, seen across the view; others count for less."""
        return self._weight

    @property
    def spread(self) -> float:
        """Robust standard deviation of the recent lengths [m]; NaN without an estimate."""
        if self._value is None:
            return math.nan
        samples = self._recent().copy()
        samples[:, 0] = np.abs(samples[:, 0] - self._value)
        return 1.4826 * _weighted_median(samples)

    def _recent(self) -> FloatArray:
        """The lengths that count, in no particular order, and their weights. Shape (n, 2)."""
        return self._samples[: self._count]

    def too_long(self, length: float) -> bool:
        """Tell whether a measured length [m] is beyond belief; never before there is an estimate."""
        return self._value is not None and length > self._settings.tolerance * self._value


def _weighted_median(samples: FloatArray) -> float:
    ordered = samples[np.argsort(samples[:, 0], kind="stable")]
    reached = np.cumsum(ordered[:, 1])
    return float(ordered[int(np.searchsorted(reached, reached[-1] / 2.0)), 0])
