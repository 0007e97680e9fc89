"""The median filter of the original, with its frozen start."""

from __future__ import annotations

from collections import deque

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray


class OriginalMedian:
    """Median of the last `order + 1` samples, axis by axis; until so many came, the start value.

    With order 3 the first three images after a keypoint appears show its first place: so the original does,
    and why `TemporalMedian` exists. Source: `MedianFilter` of iCub's control library.
    """

    def __init__(self, order: int, start: FloatArray) -> None:
        """Build a filter.

        Args:
            order: number of past samples.
            start: output until the filter is full. Shape (k,).
        """
        self._samples: deque[FloatArray] = deque(maxlen=order + 1)
        self._output = np.array(start, dtype=np.float64)

    def restart(self, start: FloatArray) -> None:
        """Forget all samples and show this value until the filter is full again. Shape (k,)."""
        self._samples.clear()
        self._output = np.array(start, dtype=np.float64)

    def step(self, sample: FloatArray) -> FloatArray:
        """Take a sample and give the output. Shape (k,) each."""
        self._samples.append(np.array(sample, dtype=np.float64))
        if len(self._samples) == self._samples.maxlen:
            self._output = np.median(np.array(self._samples), axis=0)
        return self._output.copy()

    @property
    def output(self) -> FloatArray:
        """The last output. Shape (k,)."""
        return self._output.copy()
