# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Keypoints over time: smooth at rest, without delay in fast movement, held while they are not seen.

A Kalman filter of each keypoint's viewing direction (x/z, y/z) and depth z, each with a velocity: what the
detector and what the camera's depth contribute err independently there, and a keypoint without depth still
moves in the image. How much a keypoint is thought to accelerate follows from how far the last images were
from what was expected: a hand at rest is averaged, a fast one is followed at once (adaptive estimation of the
process noise after Bar-Shalom, Li and Kirubarajan, "Estimation with Applications to Tracking and Navigation",
section 11.2).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from teo_skeleton_retriever.arrays import BoolArray, FloatArray, in_space

_FORGET = 0.15  # [s] over which surprise is averaged: a stroke of a sign takes 0.2 s
_CALM, _WILD = 0.002, 4.0  # shares of the usual acceleration's variance between which it is adapted
# Squared misfit over its expectation that 1.4 % of what is expected exceeds (chi-squared, 1).
_STARTLING = 6.0
_GATE = 5.0  # [sigma] what is farther off is an outlier,
_PATIENCE = 2  # unless so many images in a row say so
_STOPPING = 0.1  # [s] in which a keypoint that is not seen is thought to come to rest
_FIRST_SPEED = 1.0  # [m/s] standard deviation of the velocity of a keypoint just seen


class FilterOutput(NamedTuple):
    """Estimates of n keypoints."""

    rays: FloatArray
    """x/z, y/z; NaN where lost. Shape (n, 2)"""
    depth: FloatArray
    """[m]; NaN where lost. Shape (n,)"""
    sigma: FloatArray
    """standard deviation of x/z, y/z and of z [m]. Shape (n, 3)"""
    age: FloatArray
    """time since the image it was last seen in [s]; infinite if never. Shape (n,)"""
    fresh: BoolArray
    """whether direction and depth are measured in this image. Shape (n,)"""

    @property
    def points(self) -> FloatArray:
        """Estimated positions [m]; NaN where lost. Shape (n, 3)."""
        return in_space(self.rays, self.depth)

    def part(self, rows: slice) -> FilterOutput:
        """Keep some of the keypoints."""
        return FilterOutput(
            self.rays[rows], self.depth[rows], self.sigma[rows], self.age[rows], self.fresh[rows]
        )


class KeypointFilter:
    """Filters the keypoints of one part of one person."""

    def __init__(
        self,
        n: int,
        *,
        acceleration: float | FloatArray,
        speed: float | FloatArray = 0.0,
        hold_time: float,
        smoothing: float,
    ) -> None:
        """Build a filter of n keypoints that were never seen.

        Args:
            n: Number of keypoints.
            acceleration: Usual standard deviation of their acceleration [m/s^2], one or each. Shape (n,).
            speed: Which they do not exceed [m/s], one or each: a stroke's begin is no outlier. Shape (n,).
            hold_time: A keypoint not seen for longer is forgotten [s].
            smoothing: 1 is the best estimate, 0 none, more is smoother and later.
        """
        self._acceleration = np.broadcast_to(np.asarray(acceleration, dtype=np.float64), (n,))[:, None]
        self._speed = np.broadcast_to(np.asarray(speed, dtype=np.float64), (n,))
        self._hold_time = hold_time
        self._smoothing = smoothing
        self._state = np.full((2, n, 3), np.nan)  # values, then velocities
        self._covariance = np.zeros((3, n, 3))  # of values; of values and velocities; of velocities
        self._surprise = np.ones((n, 3))
        self._seen = np.full(n, -np.inf)
        self._doubts = np.zeros((2, n), dtype=np.int64)  # images in a row of directions and of depths
        self._time: float | None = None
        # For when something was last expected, and what.
        self._ahead: tuple[float, FloatArray, FloatArray] | None = None

    def predict(self, time: float) -> FilterOutput:
        """Predict the keypoints at a time [s], not before the last image; the filter stays as it is."""
        state, covariance = self._advanced(time)
        return self._output(state, covariance, time, np.zeros(len(self._seen), dtype=bool))

    def believable(self, time: float, rays: FloatArray, across: FloatArray) -> BoolArray:
        """Tell which seen keypoints lie within reach of the prediction; to be called once an image.

        A keypoint that stays out of reach for several images has jumped and is believed again.

        Args:
            time: Of the image [s].
            rays: x/z, y/z; NaN where not seen. Shape (n, 2).
            across: Standard deviation of each across the ray [m]. Shape (n,).
        """
        state, covariance = self._advanced(time)
        elapsed = 0.0 if self._time is None else time - self._time
        with np.errstate(invalid="ignore"):
            gate = _GATE * np.hypot(np.sqrt(covariance[0, :, :2]), (across * self._scale()[:, 0])[:, None])
            gate += (self._speed * elapsed * self._scale()[:, 0])[:, None]
            doubtful = (np.abs(rays - state[0, :, :2]) > gate).any(axis=1)
        self._doubts[0] = np.where(doubtful, self._doubts[0] + 1, 0)
        jumped = self._doubts[0] > _PATIENCE
        if jumped.any():
            self._state[:, jumped] = np.nan  # begins anew there
            self._doubts[0, jumped] = 0
            self._ahead = None
        believed: BoolArray = ~doubtful | jumped
        return believed

    def step(self, time: float, values: FloatArray, sigma: FloatArray) -> FilterOutput:
        """Take one image.

        Args:
            time: [s], not before the last.
            values: x/z, y/z and z [m]; NaN where not measured. Shape (n, 3).
            sigma: Standard deviations. Shape (n, 3).
        """
        self._state, self._covariance = self._advanced(time)
        self._ahead = None
        elapsed = 0.0 if self._time is None else time - self._time
        self._time = time
        forgotten = time - self._seen > self._hold_time
        self._state[:, forgotten] = np.nan
        values = np.where(
            self._outliers(values, sigma, elapsed)[:, None] & [False, False, True], np.nan, values
        )
        self._correct(values, sigma, elapsed)
        self._begin(values, sigma)
        known = np.isfinite(self._state[0]).all(axis=1)
        self._seen[np.isfinite(values[:, :2]).all(axis=1) & known] = time
        fresh: BoolArray = np.asarray(np.isfinite(values).all(axis=1))
        return self._output(self._state, self._covariance, time, fresh)

    def _scale(self) -> FloatArray:
        """Metres per unit of each value, for speeds and accelerations in metres. Shape (n, 3)."""
        depth = self._state[0, :, 2]
        scale = np.ones((len(depth), 3))
        scale[:, :2] = 1.0 / np.where(np.isnan(depth), 1.0, depth)[:, None]
        return scale

    def _advanced(self, time: float) -> tuple[FloatArray, FloatArray]:
        if self._ahead is None or self._ahead[0] != time:
            self._ahead = (time, *self._moved_on(time))
        return self._ahead[1], self._ahead[2]

    def _moved_on(self, time: float) -> tuple[FloatArray, FloatArray]:
        if self._time is None or time <= self._time:
            return self._state.copy(), self._covariance.copy()
        dt = time - self._time
        value, velocity = self._state
        hidden = (self._time > self._seen)[:, None]
        moved = np.where(hidden, _STOPPING * (1.0 - np.exp(-dt / _STOPPING)), dt)
        left = np.where(hidden, np.exp(-dt / _STOPPING), 1.0)
        power = (self._acceleration * self._scale()) ** 2 * self._surprise
        a, b, c = self._covariance
        covariance = np.stack(
            [
                a + 2.0 * moved * b + moved**2 * c + power * dt**4 / 4.0,
                left * (b + moved * c) + power * dt**3 / 2.0,
                left**2 * c + power * dt**2,
            ]
        )
        return np.stack([value + moved * velocity, left * velocity]), covariance

    def _outliers(self, values: FloatArray, sigma: FloatArray, elapsed: float) -> BoolArray:
        """Which depths are outliers: far from the prediction, for at most `_PATIENCE` images. Shape (n,)."""
        with np.errstate(invalid="ignore"):
            off = np.abs(values[:, 2] - self._state[0, :, 2]) - self._speed * elapsed
            doubtful = off > _GATE * np.sqrt(self._covariance[0, :, 2] + sigma[:, 2] ** 2)
        self._doubts[1] = np.where(doubtful, self._doubts[1] + 1, 0)
        jumped = self._doubts[1] > _PATIENCE
        self._state[0, jumped, 2] = np.nan  # begins anew with this measurement
        self._doubts[1, jumped] = 0
        outliers: BoolArray = doubtful & ~jumped
        return outliers

    def _correct(self, values: FloatArray, sigma: FloatArray, elapsed: float) -> None:
        measured = np.isfinite(values) & np.isfinite(self._state[0])
        noise = (self._smoothing * sigma) ** 2 + 1e-12
        a, b, c = self._covariance
        with np.errstate(invalid="ignore"):
            innovation = np.where(measured, values - self._state[0], 0.0)
            total = a + noise
            level = innovation**2 / total
        if elapsed > 0.0:
            change = np.exp(min(elapsed / _FORGET, 1.0) * (np.minimum(level, _STARTLING) - 1.0))
            self._surprise = np.where(
                measured, np.clip(self._surprise * change, _CALM, _WILD), self._surprise
            )
        # A stroke begins within one image: what is startling is followed at once (strong tracking).
        startled = measured & (level > _STARTLING)
        a = np.where(startled, np.maximum(a, innovation**2 / 2.0 - noise), a)
        total = a + noise
        gain_value = np.where(measured, a / total, 0.0)
        gain_velocity = np.where(measured, b / total, 0.0)
        self._state = np.stack(
            [self._state[0] + gain_value * innovation, self._state[1] + gain_velocity * innovation]
        )
        self._covariance = np.stack([a - gain_value * a, b - gain_value * b, c - gain_velocity * b])

    def _begin(self, values: FloatArray, sigma: FloatArray) -> None:
        """Start the keypoints that have no place yet, each axis by itself."""
        new = np.isnan(self._state[0]) & np.isfinite(values)
        self._state[0][new] = values[new]
        self._state[1][new] = 0.0
        self._covariance[0][new] = sigma[new] ** 2
        self._covariance[1][new] = 0.0
        self._covariance[2][new] = ((_FIRST_SPEED * self._scale()) ** 2)[new]
        self._surprise[new] = 1.0

    def _output(
        self, state: FloatArray, covariance: FloatArray, time: float, fresh: BoolArray
    ) -> FilterOutput:
        lost = ~np.isfinite(state[0]).all(axis=1) | (time - self._seen > self._hold_time)
        values = np.where(lost[:, None], np.nan, state[0])
        sigma = np.where(lost[:, None], np.nan, np.sqrt(covariance[0]))
        return FilterOutput(values[:, :2], values[:, 2], sigma, time - self._seen, fresh)
