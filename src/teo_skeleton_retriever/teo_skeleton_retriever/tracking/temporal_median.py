"""A median over time that shows movement from the first sample on."""

from __future__ import annotations

from collections import deque

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray


class TemporalMedian:
    """Median of the samples of the last `order + 1` images, axis by axis, however few there are yet.

    A single outlier passes only while there are fewer than three samples. Samples that are too old are
    forgotten, so that a keypoint that returns after a gap starts afresh instead of being held where it was.
    """

    def __init__(self, order: int, max_age: float) -> None:
        """Build a filter.

        Args:
            order: number of past samples; the delay of a steady movement is half of it, in images.
            max_age: a sample older than this does not count [s].
        """
        self._samples: deque[tuple[float, FloatArray]] = deque(maxlen=order + 1)
        self._max_age = max_age

    def step(self, time: float, sample: FloatArray) -> FloatArray:
        """Take a sample and give the median.

        Args:
            time: of the image [s]. One before the last restarts the filter: a bag was set back.
            sample: a sample that is not finite is not taken. Shape (k,).

        Returns:
            Shape (k,); NaN while no sample counts.
        """
        sample = np.array(sample, dtype=np.float64)
        if self._samples and time < self._samples[-1][0]:
            self._samples.clear()
        while self._samples and time - self._samples[0][0] > self._max_age:
            self._samples.popleft()
        if np.isfinite(sample).all():
            self._samples.append((time, sample))
        if not self._samples:
            return np.full(sample.shape, np.nan)
        median: FloatArray = np.median(np.array([value for _, value in self._samples]), axis=0)
        return median
