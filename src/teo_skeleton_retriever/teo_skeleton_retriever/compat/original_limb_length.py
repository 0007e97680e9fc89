"""The original's calibration of a limb: the median of its first lengths, for good."""

from __future__ import annotations

import numpy as np

from teo_skeleton_retriever.compat.original_median import OriginalMedian

DEFAULT_ORDER = 40
TOO_LONG = 2.0
"""A limb this many times as long as calibrated loses its far end for that image; fixed in the original."""


class OriginalLimbLength:
    """Locked after `order + 1` lengths; one that starts badly stays bad, which is why `LimbLength` exists."""

    def __init__(self, order: int = DEFAULT_ORDER) -> None:
        self._order = order
        self._count = 0
        self._median = OriginalMedian(order, np.zeros(1))

    def step(self, length: float) -> None:
        """Take a measured length [m]."""
        if self._count <= self._order:
            self._median.step(np.array([length]))
            self._count += 1

    @property
    def value(self) -> float | None:
        """The calibrated length [m]; None until then."""
        return float(self._median.output[0]) if self._count > self._order else None

    def too_long(self, length: float) -> bool:
        """Tell whether a measured length [m] is beyond belief; never before the calibration."""
        return self.value is not None and length > TOO_LONG * self.value
