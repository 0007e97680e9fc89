# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A person's keypoints over time, in the person's own axes: what every capture begins with."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from teo_common.arrays import Array
from teo_signs.errors import LutError

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
        return Keypoints(
            positions=self.positions[frames],
            sigma=self.sigma[frames],
            confidence=self.confidence[frames],
            status=self.status[frames],
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class SkeletonTrack:
    """A person over time, in axes that go with the trunk: x out of the chest, y to the person's left, z up.

    The origin is between the shoulders. How the axes are found is said in `body_axes.in_body_axes`, which
    makes a track of keypoints in any other axes.

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
    """

    times: Array
    body: Keypoints
    left_hand: Keypoints
    right_hand: Keypoints
    face: Keypoints
    source: str
    recorded: str | None
    trunk: Array | None = None

    def __post_init__(self) -> None:
        count = len(self.times)
        parts = {"body": BODY, "left_hand": HAND, "right_hand": HAND, "face": FACE}
        for name, keypoints in parts.items():
            shape = getattr(self, name).positions.shape
            if shape != (count, keypoints, 3):
                raise ValueError(f"expected {name} of shape ({count}, {keypoints}, 3), got {shape}")
        if self.trunk is not None and self.trunk.shape != (count, 3):
            raise ValueError(f"expected trunk of shape ({count}, 3), got {self.trunk.shape}")
        check_times(self.times, self.source)

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


def check_times(times: Array, source: str) -> None:
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
