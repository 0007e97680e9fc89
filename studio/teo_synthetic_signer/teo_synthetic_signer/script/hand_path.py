# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A way of the hands through several key poses without a stop."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from scipy.interpolate import CubicHermiteSpline, CubicSpline

from teo_skeleton_retriever.arrays import FloatArray


class Path:
    """Smooth in place and speed; at rest at both ends, exactly at each pose at its time."""

    def __init__(self, times: Sequence[float], wrists: Mapping[str, Sequence[FloatArray]]) -> None:
        """Lay the way.

        Args:
            times: At which the poses are passed, the first and last are stops [s].
            wrists: Of each side, at these times [m].
        """
        self._times = np.array(times)
        self._progress = CubicHermiteSpline(self._times, np.arange(len(times)), self._speeds())
        self._wrists = {}
        for side, places in wrists.items():
            # Over the poses, not over time: its shape must not depend on how fast it is gone.
            self._wrists[side] = CubicSpline(np.arange(len(times)), np.array(places))

    def share(self, time: float) -> float:
        """Tell how much of the way from the pose that was passed last to the next is gone, 0 to 1."""
        last = int(np.clip(np.searchsorted(self._times, time, side="right") - 1, 0, len(self._times) - 2))
        return float(np.clip(self._progress(time) - last, 0.0, 1.0))

    def wrist(self, side: str, time: float) -> FloatArray:
        """Tell where a wrist is [m]. Shape (3,)."""
        place: FloatArray = self._wrists[side](self._progress(time))
        return place

    def _speeds(self) -> FloatArray:
        """Give poses a second at each pose: the harmonic mean keeps the order (Fritsch and Butland 1984)."""
        steps = np.diff(self._times)
        speeds = np.zeros(len(self._times))
        speeds[1:-1] = 2.0 / (steps[:-1] + steps[1:])
        return speeds
