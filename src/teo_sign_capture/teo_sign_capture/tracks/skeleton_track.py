# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A person's keypoints over time, in the axes of the person's own trunk: what every capture begins with.

The way from the hips to the shoulders gives up; the line of the shoulders, square to it, gives left; the
origin is between the shoulders. The shoulders do not give up themselves, for one of them rises with its arm.
The axes are smoothed over time, so that what trembles in a shoulder does not tremble in the hands; a trunk
that sways or leans carries its axes along, so that the hands do not, and how it is turned from where it
mostly is remains as `SkeletonTrack.trunk`.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d
from scipy.spatial.transform import Rotation

from teo_common.arrays import Array
from teo_signs.errors import LutError

Flags = NDArray[np.bool_]

# Keypoints of OpenPose's BODY_25, of a hand (OpenPose's and MediaPipe's order) and of OpenPose's face.
BODY, HAND, FACE = 25, 21, 70

NOSE, NECK, MID_HIP = 0, 1, 8
SHOULDER = {"right": 2, "left": 5}
ELBOW = {"right": 3, "left": 6}
WRIST = {"right": 4, "left": 7}
HIP = {"right": 9, "left": 12}
EYE = {"right": 15, "left": 16}
# Where a keypoint stands in BODY_25.
EAR = {"right": 17, "left": 18}


@dataclass(frozen=True, kw_only=True, eq=False)
class Keypoints:
    """One part of a person over time.

    Attributes:
        positions: In the axes of the track [m]; NaN where lost. Shape (T, K, 3).
        sigma: Standard deviation of each position, root mean over its axes [m]; NaN if unknown. Shape (T, K).
        confidence: Of the detector, 0 to 1; NaN if unknown. Shape (T, K).
        status: `Keypoint3D.STATUS_*`: 0 lost, 1 measured, 2 held, 3 optimised. Shape (T, K).
    """

    positions: Array
    sigma: Array
    confidence: Array
    status: NDArray[np.uint8]

    def __post_init__(self) -> None:
        count = np.shape(self.positions)[:2]
        if np.shape(self.positions) != (*count, 3) or any(
            np.shape(field) != count for field in (self.sigma, self.confidence, self.status)
        ):
            raise ValueError("expected positions of shape (T, K, 3) and the other fields of shape (T, K)")

    @classmethod
    def lost(cls, frames: int, keypoints: int) -> Keypoints:
        """A part that was never seen."""
        unknown = np.full((frames, keypoints), np.nan)
        return cls(
            positions=np.full((frames, keypoints, 3), np.nan),
            sigma=unknown,
            confidence=unknown,
            status=np.zeros((frames, keypoints), np.uint8),
        )

    def at(self, frames: slice) -> Keypoints:
        """The same part in some of the frames."""
        return Keypoints(**{name: values[frames] for name, values in vars(self).items()})


@dataclass(frozen=True, kw_only=True, eq=False)
class SkeletonTrack:
    """A person over time, in axes that go with the trunk: x out of the chest, y to the person's left, z up.

    The origin is between the shoulders. `in_body_axes` makes a track of keypoints in any other axes.

    Attributes:
        times: From the first frame [s], strictly increasing. Shape (T,).
        body: BODY_25.
        left_hand: The person's own left, 21 keypoints.
        right_hand: Likewise.
        face: OpenPose's 70.
        source: Name of the bag or file that it was read from.
        recorded: Day of the recording, YYYY-MM-DD; None if not known.
        trunk: How the trunk is turned from where it mostly is, as a rotation vector in the axes of the track
            [rad]; None if it is not known and taken as still. Shape (T, 3).
        damage: What is wrong with the recording, of which this is the rest; empty if nothing is.
    """

    times: Array
    body: Keypoints
    left_hand: Keypoints
    right_hand: Keypoints
    face: Keypoints
    source: str
    recorded: str | None
    trunk: Array | None = None
    damage: str = ""

    def __post_init__(self) -> None:
        count = len(self.times)
        parts = {"body": BODY, "left_hand": HAND, "right_hand": HAND, "face": FACE}
        for name, keypoints in parts.items():
            shape = getattr(self, name).positions.shape
            if shape != (count, keypoints, 3):
                raise ValueError(f"expected {name} of shape ({count}, {keypoints}, 3), got {shape}")
        if self.trunk is not None and self.trunk.shape != (count, 3):
            raise ValueError(f"expected trunk of shape ({count}, 3), got {self.trunk.shape}")
        _check_times(self.times, self.source)

    def hand(self, side: str) -> Keypoints:
        """The hand of a side, "right" or "left"."""
        return self.right_hand if side == "right" else self.left_hand

    def between(self, start: float, end: float) -> SkeletonTrack:
        """The frames from one time to another, both included; its times begin at 0 again.

        Args:
            start: [s].
            end: [s].

        Raises:
            LutError: "empty_track" if no frame is among them.
        """
        inside = np.flatnonzero((self.times >= start) & (self.times <= end))
        if not inside.size:
            raise LutError(
                "empty_track",
                f"{self.source}: expected frames between {start:.2f} and {end:.2f} s, "
                f"got none: it lasts from 0 to {self.times[-1]:.2f} s",
            )
        frames = slice(int(inside[0]), int(inside[-1]) + 1)
        return replace(
            self,
            times=self.times[frames] - self.times[frames][0],
            body=self.body.at(frames),
            left_hand=self.left_hand.at(frames),
            right_hand=self.right_hand.at(frames),
            face=self.face.at(frames),
            trunk=None if self.trunk is None else self.trunk[frames],
        )


def _check_times(times: Array, source: str) -> None:
    """See that there are times and that each is later than the one before.

    Raises:
        LutError: "empty_track" or "bad_stamps".
    """
    if not len(times):
        raise LutError("empty_track", f"{source}: expected one frame or more, got none")
    back = np.flatnonzero(~(np.diff(times) > 0.0))
    if back.size or not np.isfinite(times).all():
        frame = int(back[0]) + 1 if back.size else int(np.flatnonzero(~np.isfinite(times))[0])
        raise LutError(
            "bad_stamps",
            f"{source}: expected each stamp to be later than the one before, "
            f"got {times[frame]:.3f} s at frame {frame} after {times[max(frame - 1, 0)]:.3f} s",
        )


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
    up: tuple[float, float, float],
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
    _check_times(times, source)
    origins, axes = _trunk(times, body, source, np.asarray(up))

    def moved(part: Keypoints) -> Keypoints:
        positions = np.einsum("tki,tij->tkj", part.positions - origins[:, None], axes)
        return replace(part, positions=positions)

    turns = Rotation.from_matrix(axes)
    usual = turns.mean()
    return SkeletonTrack(
        times=times - times[0],
        body=moved(body),
        left_hand=moved(left_hand),
        right_hand=moved(right_hand),
        face=moved(face),
        source=source,
        recorded=recorded,
        trunk=(usual.inv() * turns).as_rotvec(),
    )


def _trunk(times: Array, body: Keypoints, source: str, up: Array) -> tuple[Array, Array]:
    """Origins, shape (T, 3), and axes as columns, shape (T, 3, 3)."""
    left, right = (body.positions[:, SHOULDER[side]] for side in ("left", "right"))
    if not (seen(left) & seen(right)).any():
        raise LutError(
            "no_torso",
            f"{source}: expected a person whose shoulders are seen, got none in {len(times)} frames: "
            "both shoulders must be in the picture",
        )
    across = smoothed(times, filled(times, left - right))
    origins = smoothed(times, filled(times, (left + right) / 2.0))
    hips = (body.positions[:, HIP["left"]] + body.positions[:, HIP["right"]]) / 2.0
    if seen(hips).mean() >= _HIPS_SEEN:
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


def seen(positions: Array) -> Flags:
    """Which positions are known. Shape (..., 3) gives (...)."""
    return np.asarray(np.isfinite(positions).all(axis=-1))


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
    """Values smoothed over time by a Gaussian of a deviation [s]; even in time or nearly. Shape (T, ...)."""
    if len(times) < 2:
        return values
    frames = deviation / float(np.median(np.diff(times)))
    result: Array = gaussian_filter1d(values, frames, axis=0, mode="nearest")
    return result


def _unit(vectors: Array) -> Array:
    with np.errstate(invalid="ignore", divide="ignore"):
        units: Array = vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)
    return units
