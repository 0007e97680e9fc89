# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From keypoints in any axes to a track in the axes of the person's own trunk.

The way from the hips to the shoulders gives up; the line of the shoulders, square to it, gives left; the
origin is between the shoulders. The shoulders do not give up themselves, for one of them rises with its arm.
All is smoothed over time, so that what trembles in a shoulder does not tremble in the hands; a trunk that
sways or leans carries its axes along, so that the hands do not, and how it is turned from where it mostly is
remains as `SkeletonTrack.trunk`.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.ndimage import gaussian_filter1d
from scipy.spatial.transform import Rotation

from teo_common.arrays import Array
from teo_sign_capture.tracks.skeleton_track import HIP, SHOULDER, Keypoints, SkeletonTrack, check_times
from teo_signs.errors import LutError

# Up in an upright camera's optical frame (x right, y down, z forward).
CAMERA_UP = (0.0, -1.0, 0.0)

# [s] Deviation of the Gaussian: what sways below 1 Hz, as people do, is followed; the tremble of a detector
# from frame to frame is not.
_SMOOTHED_FOR = 0.15
# Share of the frames in which the hips must be known to be believed: behind a table they come and go.
_HIPS_SEEN = 0.3
# The trunk and the line of the shoulders are never this close to parallel.
_LEAST_SINE = 0.1


def in_body_axes(
    *,
    times: Array,
    body: Keypoints,
    left_hand: Keypoints,
    right_hand: Keypoints,
    face: Keypoints,
    source: str,
    recorded: str | None,
    up: tuple[float, float, float] = CAMERA_UP,
) -> SkeletonTrack:
    """Bring keypoints into the axes of the trunk.

    Args:
        times: [s], strictly increasing. Shape (T,).
        body: BODY_25, in any fixed right-handed axes [m], as the others.
        left_hand: The person's own left.
        right_hand: Likewise.
        face: OpenPose's 70.
        source: Name for provenance and errors.
        recorded: Day of the recording, YYYY-MM-DD; None if not known.
        up: Direction in the same axes that stands in for the trunk's while the hips are not known.

    Raises:
        LutError: "no_torso" if both shoulders are never seen or the points make no axes; "bad_stamps" or
            "empty_track" for times.
    """
    check_times(times, source)
    origins, axes = _trunk(times, body, source, np.asarray(up))
    parts = {"body": body, "left_hand": left_hand, "right_hand": right_hand, "face": face}
    moved = {
        name: replace(part, positions=np.einsum("tki,tij->tkj", part.positions - origins[:, None], axes))
        for name, part in parts.items()
    }
    turns = Rotation.from_matrix(axes)
    usual = turns.mean()
    return SkeletonTrack(
        times=times - times[0],
        **moved,
        source=source,
        recorded=recorded,
        trunk=(usual.inv() * turns).as_rotvec(),
    )


def _trunk(times: Array, body: Keypoints, source: str, up: Array) -> tuple[Array, Array]:
    """Origins, shape (T, 3), and axes as columns, shape (T, 3, 3)."""
    left, right = (body.positions[:, SHOULDER[side]] for side in ("left", "right"))
    seen = np.isfinite(left).all(axis=1) & np.isfinite(right).all(axis=1)
    if not seen.any():
        raise LutError(
            "no_torso",
            f"{source}: expected a person whose shoulders are seen, got none in {len(times)} frames: "
            "both shoulders must be in the picture",
        )
    across = smoothed(times, filled(times, left - right))
    origins = smoothed(times, filled(times, (left + right) / 2.0))
    hips = (body.positions[:, HIP["left"]] + body.positions[:, HIP["right"]]) / 2.0
    if np.isfinite(hips).all(axis=1).mean() >= _HIPS_SEEN:
        rising = origins - smoothed(times, filled(times, hips))
    else:
        rising = np.tile(up, (len(times), 1))
    z = _unit(rising)
    flat = across - (across * z).sum(axis=1, keepdims=True) * z
    length = np.linalg.norm(across, axis=1)
    if (np.linalg.norm(flat, axis=1) <= _LEAST_SINE * length).any() or not np.isfinite(z).all():
        raise LutError(
            "no_torso",
            f"{source}: expected shoulders beside each other above the hips, got a line of the shoulders "
            "along the trunk: is this an upright person?",
        )
    y = _unit(flat)
    return origins, np.stack([np.cross(y, z), y, z], axis=-1)


def filled(times: Array, values: Array) -> Array:
    """Values with gaps filled in straight lines, and held before the first and after the last.

    Args:
        times: [s]. Shape (T,).
        values: NaN where not known; known at least once. Shape (T, k).
    """
    known = np.isfinite(values).all(axis=1)
    if known.all():
        return values
    columns = [np.interp(times, times[known], column[known]) for column in values.T]
    return np.stack(columns, axis=1)


def smoothed(times: Array, values: Array, deviation: float = _SMOOTHED_FOR) -> Array:
    """Values smoothed over time by a Gaussian of a deviation [s]; even in time or nearly. Shape (T, k)."""
    if len(times) < 2:
        return values
    frames = deviation / float(np.median(np.diff(times)))
    result: Array = gaussian_filter1d(values, frames, axis=0, mode="nearest")
    return result


def _unit(vectors: Array) -> Array:
    with np.errstate(invalid="ignore", divide="ignore"):
        units: Array = vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)
    return units
