# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Quieter keypoints, with fast strokes left as they are, and short gaps filled.

Each coordinate of each keypoint goes through a Kalman filter and, backwards, the smoother of Rauch, Tung and
Striebel (1965). The motion is taken for one whose jerk is white noise of power `_JERK_POWER`; a measurement
counts by its own sigma. At an even rate the smoother is the low pass 1 / (1 + (w / c)^6) with
c^6 = JERK_POWER / (sigma^2 dt): the cut-off falls with the third root of sigma only, so that no good keypoint
loses its strokes and no bad one keeps its noise.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal, get_args

import numpy as np

from teo_common.arrays import Array
from teo_sign_capture.tracks.skeleton_track import WRIST, Flags, Keypoints, SkeletonTrack, seen

Part = Literal["body", "left_hand", "right_hand", "face"]
_PARTS: tuple[Part, ...] = get_args(Part)

# [m^2/s^5] With keypoints of 10 mm at 30 Hz the cut-off is 8 Hz: a stroke of 3 Hz, the fastest that hands
# shake at, keeps 99.7 % of its way; with 30 mm it is 5.5 Hz, and it keeps 97 %.
_JERK_POWER = 5.0e4

# [s] A keypoint that is lost for longer is not guessed: within that time a hand begins and ends a move.
LONGEST_FILLED = 0.4
# [s] A hand that is lost for no longer keeps its shape and direction, if its wrist is seen meanwhile and both
# are the same before and after: hands that hide each other hold still.
_LONGEST_KEPT = 1.2
# [s] For so long before it is first seen, and after it is last seen, a hand is given the shape that it has
# then, at its wrist: hands that come up from rest, blurred or from below the image, are found some frames
# after they are there, and take no new shape meanwhile.
_LONGEST_EDGE = LONGEST_FILLED
# [m] Keypoints that are this near, from the wrist, before and after: as well as hidden hands are found.
_SAME_SHAPE = 0.03

# [m] Standard deviation of exact keypoints, which say 0, and of those that do not say theirs: that of good
# keypoints.
_LEAST_SIGMA, _UNKNOWN_SIGMA = 0.002, 0.010
# [m/s], [m/s^2] Before the first measurement nothing is known: what hands reach in fast signing.
_START_SPEED, _START_ACCELERATION = 3.0, 40.0
# Measurements farther from the smooth motion than so many sigmas count less, as the square of the excess: a
# keypoint that jumps to the other hand for an image is not followed.
_DOUBTED = 3.0
_PASSES = 3
# [m] Standard deviation of a hand that is put where its wrist is, in the shape it has before and after.
_FILLED_SIGMA = 0.030


@dataclass(frozen=True, kw_only=True)
class Gap:
    """A time in which a part of the person was lost.

    Attributes:
        part: "body", "left_hand", "right_hand" or "face".
        start: [s].
        end: [s].
    """

    part: Part
    start: float
    end: float


@dataclass(frozen=True, kw_only=True)
class Smoothed:
    """A track after smoothing.

    Attributes:
        track: The track; short gaps are filled, long ones still NaN.
        gaps: Times in which half or more of a part's usual keypoints were lost, filled or not.
    """

    track: SkeletonTrack
    gaps: tuple[Gap, ...]


def smooth_track(track: SkeletonTrack) -> Smoothed:
    """Smooth every keypoint of a track and fill what is lost for a short time."""
    filled = {
        f"{side}_hand": _with_wrist(track.times, track.hand(side), track.body.positions[:, wrist])
        for side, wrist in WRIST.items()
    }
    smooth: dict[str, Keypoints] = {}
    gaps: list[Gap] = []
    for part in _PARTS:
        keypoints: Keypoints = filled.get(part, getattr(track, part))
        positions = smooth_positions(track.times, keypoints.positions, keypoints.sigma)
        smooth[part] = replace(keypoints, positions=positions)
        gaps += _find_gaps(track.times, getattr(track, part).positions, part)
    return Smoothed(
        track=replace(track, **smooth),  # type: ignore[arg-type]  # parts by name
        gaps=tuple(sorted(gaps, key=lambda gap: gap.start)),
    )


def _find_gaps(times: Array, positions: Array, part: Part) -> list[Gap]:
    """Times in which half or more of the keypoints that a part ever has are lost; positions as recorded."""
    known = seen(positions)
    ever = known.any(axis=0)
    if not ever.any():
        return [Gap(part=part, start=float(times[0]), end=float(times[-1]))]
    lost = known[:, ever].mean(axis=1) < 0.5
    gaps = []
    for first, last in runs(lost):
        # From the last image in which it was seen to the next.
        start, end = float(times[max(first - 1, 0)]), float(times[min(last + 1, len(times) - 1)])
        gaps.append(Gap(part=part, start=start, end=end))
    return gaps


def smooth_positions(times: Array, positions: Array, sigma: Array) -> Array:
    """Smooth keypoints, each weighed by its sigma.

    Args:
        times: [s], strictly increasing. Shape (n,).
        positions: [m], NaN where lost. Shape (n, k, 3).
        sigma: Standard deviation of each [m]; NaN where unknown. Shape (n, k).

    Returns:
        Positions [m], NaN before the first and after the last measurement of a keypoint and in its gaps
        longer than `LONGEST_FILLED`. Shape (n, k, 3).
    """
    count, keypoints, _ = positions.shape
    if count == 0 or keypoints == 0:
        return positions.copy()
    known = seen(positions)
    variance = np.square(np.maximum(np.where(np.isfinite(sigma), sigma, _UNKNOWN_SIGMA), _LEAST_SIGMA))
    measured = np.where(known[..., None], positions, 0.0)
    doubt = np.ones_like(variance)
    smooth = measured
    for _ in range(_PASSES):
        weighed = np.where(known, variance * doubt, np.inf)
        smooth, spread = _smoothed(times, measured, weighed)
        # A keypoint pulls the motion towards itself: what is left of the difference is smaller.
        left = np.sqrt(np.maximum(1.0 - spread / weighed, 0.01))
        away = np.linalg.norm(measured - smooth, axis=-1) / (left * np.sqrt(variance))
        doubt = np.maximum(away / _DOUBTED, 1.0) ** 2
    keep = known | _fillable(times, known)
    return np.where(keep[..., None], smooth, np.nan)


def runs(flags: Flags) -> list[tuple[int, int]]:
    """First and last index of every run of True."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], flags, [False]]).astype(np.int8)))
    return [(int(first), int(end) - 1) for first, end in zip(edges[::2], edges[1::2], strict=True)]


def _fillable(times: Array, known: Flags, shape: Array | None = None) -> Flags:
    """Which lost samples lie in a short gap, or one around which the shape is the same. Shape (n, k)."""
    filled = np.zeros_like(known)
    for column in range(known.shape[1]):
        for first, last in runs(~known[:, column]):
            if first == 0 or last == len(times) - 1:
                continue
            longest = LONGEST_FILLED
            if shape is not None:
                change = np.linalg.norm(shape[last + 1, column] - shape[first - 1, column])
                longest = _LONGEST_KEPT if change < _SAME_SHAPE else LONGEST_FILLED
            if times[last + 1] - times[first - 1] <= longest:
                filled[first : last + 1, column] = True
    return filled


def _with_wrist(times: Array, hand: Keypoints, wrist: Array) -> Keypoints:
    """A hand whose short gaps are filled: carried by the wrist, its shape interpolated."""
    relative = hand.positions - wrist[:, None]
    known = seen(relative)
    near = _fillable(times, known, relative) | _near_known(times, known)
    filled = near & ~seen(hand.positions) & seen(wrist)[:, None]
    positions, sigma = hand.positions.copy(), hand.sigma.copy()
    for column in np.flatnonzero(filled.any(axis=0)):
        here, there = known[:, column], filled[:, column]
        for axis in range(3):
            shape = _at(times[there], times[here], relative[here, column, axis])
            positions[there, column, axis] = wrist[there, axis] + shape
        sigma[there, column] = _FILLED_SIGMA
    return replace(hand, positions=positions, sigma=sigma)


def _near_known(times: Array, known: Flags) -> Flags:
    """Which lost samples are near the edge of a gap. Shape (n, k)."""
    near = np.zeros_like(known)
    for column in np.flatnonzero(known.any(axis=0)):
        there = times[known[:, column]]
        after = there[np.minimum(np.searchsorted(there, times), len(there) - 1)]
        before = there[np.maximum(np.searchsorted(there, times, side="right") - 1, 0)]
        away = np.minimum(np.abs(after - times), np.abs(times - before))
        near[:, column] = (away <= _LONGEST_EDGE) & ~known[:, column]
    return near


def _at(times: Array, known_times: Array, values: Array) -> Array:
    """Values between known ones; those of the nearest where the next is far, and before and after all."""
    between = np.interp(times, known_times, values)
    following = np.clip(np.searchsorted(known_times, times), 1, max(len(known_times) - 1, 1))
    if len(known_times) < 2:
        return between
    before, after = known_times[following - 1], known_times[following]
    nearest = np.where(times - before < after - times, values[following - 1], values[following])
    return np.where(after - before > _LONGEST_KEPT, nearest, between)


def _smoothed(times: Array, measured: Array, variance: Array) -> tuple[Array, Array]:
    """Run the smoother over all keypoints at once; where the variance is infinite nothing was measured.

    The three axes of a keypoint share their covariances. States are position, velocity, acceleration.

    Returns:
        Positions, shape (n, k, 3), and the variance of each, shape (n, k).
    """
    count, keypoints, _ = measured.shape
    first = np.argmax(np.isfinite(variance), axis=0)
    state = np.zeros((keypoints, 3, 3))  # keypoint, state, axis
    state[:, 0] = measured[first, np.arange(keypoints)]
    start = np.diag([1.0, _START_SPEED**2, _START_ACCELERATION**2])
    covariance = np.tile(start, (keypoints, 1, 1))
    predicted = np.empty((count, keypoints, 3, 3))
    predicted_covariance = np.empty_like(predicted)
    states, covariances = np.empty_like(predicted), np.empty_like(predicted)
    for index in range(count):
        if index:
            move, noise = _model(float(times[index] - times[index - 1]))
            state = move @ state
            covariance = move @ covariance @ move.T + noise
        predicted[index], predicted_covariance[index] = state, covariance
        gain = covariance[:, :, 0] / (covariance[:, 0, 0] + variance[index])[:, None]
        innovation = measured[index] - state[:, 0]
        state = state + gain[:, :, None] * innovation[:, None, :]
        covariance = covariance - gain[:, :, None] * covariance[:, None, 0, :]
        states[index], covariances[index] = state, covariance
    smooth = np.empty_like(measured)
    spread = np.empty_like(variance)
    later, later_covariance = states[-1], covariances[-1]
    smooth[-1], spread[-1] = later[:, 0], later_covariance[:, 0, 0]
    for index in range(count - 2, -1, -1):
        move, _ = _model(float(times[index + 1] - times[index]))
        back = np.linalg.solve(
            predicted_covariance[index + 1], move @ covariances[index].transpose(0, 2, 1)
        ).transpose(0, 2, 1)
        later = states[index] + back @ (later - predicted[index + 1])
        later_covariance = covariances[index] + back @ (
            later_covariance - predicted_covariance[index + 1]
        ) @ back.transpose(0, 2, 1)
        smooth[index], spread[index] = later[:, 0], later_covariance[:, 0, 0]
    return smooth, spread


def _model(dt: float) -> tuple[Array, Array]:
    """Transition over a time, and the covariance that white jerk adds (Bar-Shalom et al. 2001, 6.2.3)."""
    move = np.array([[1.0, dt, dt**2 / 2.0], [0.0, 1.0, dt], [0.0, 0.0, 1.0]])
    noise = _JERK_POWER * np.array(
        [
            [dt**5 / 20.0, dt**4 / 8.0, dt**3 / 6.0],
            [dt**4 / 8.0, dt**3 / 3.0, dt**2 / 2.0],
            [dt**3 / 6.0, dt**2 / 2.0, dt],
        ]
    )
    return move, noise
