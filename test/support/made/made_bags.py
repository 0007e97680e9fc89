# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Bags of skeletons of made people, as the retriever writes them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from made_tracks import HANGING, Move, make_track, path
from std_msgs.msg import Header
from teo_sign_msgs.msg import Keypoint3D, Skeleton3D, SkeletonArray

from teo_sign_capture.recordings.skeleton_bag import write_skeletons
from teo_sign_capture.tracks.skeleton_track import Keypoints, SkeletonTrack

DISTANCE = 2.0  # [m] from the camera
BEGINS = 1_710_000_000.0  # [s], a day in March 2024
CHIN, OUT, REST = (0.28, -0.06, 0.02), (0.42, -0.10, -0.08), tuple(HANGING["right"])
SIGN: list[Move] = [(0.5, 1.1, CHIN), (1.1, 1.8, OUT), (1.8, 2.4, REST)]
"""From the chin outwards: the stroke is from 1.1 to 1.8 s."""


def signing(
    *,
    moves: list[Move] | None = None,
    duration: float = 3.2,
    noise: float = 0.004,
    seed: int = 0,
    rate: float = 30.0,
) -> SkeletonTrack:
    """A person who makes a sign with the right hand, or any other moves."""
    times = np.arange(0.0, duration, 1.0 / rate)
    return make_track(times, path(times, REST, SIGN if moves is None else moves), noise=noise, seed=seed)


def messages(track: SkeletonTrack, *, person: int = 1, begins: float = BEGINS) -> list[SkeletonArray]:
    """A track as the retriever publishes it, the person facing the camera."""
    arrays = []
    for frame, time in enumerate(track.times):
        skeleton = Skeleton3D(id=person, is_signer=True)
        for part in ("body", "left_hand", "right_hand"):
            setattr(skeleton, part, _keypoints(getattr(track, part), frame))
        header = Header(frame_id="camera")
        stamp = round((begins + float(time)) * 1e9)
        header.stamp.sec, header.stamp.nanosec = divmod(stamp, 1_000_000_000)
        arrays.append(SkeletonArray(header=header, skeletons=[skeleton]))
    return arrays


def write_bag(file: Path, track: SkeletonTrack) -> Path:
    """A bag of a track."""
    file.parent.mkdir(parents=True, exist_ok=True)
    write_skeletons(file, messages(track))
    return file


def _keypoints(part: Keypoints, frame: int) -> list[Keypoint3D]:
    points = []
    for index, (x, y, z) in enumerate(part.positions[frame].tolist()):
        known = np.isfinite(x)
        point = Keypoint3D(name=str(index), status=int(part.status[frame, index]))
        # The optical frame looks at the person: their left is on the right, and down is positive.
        place = (y, -z, DISTANCE - x) if known else (np.nan,) * 3
        point.position.x, point.position.y, point.position.z = place
        point.sigma = np.full(3, part.sigma[frame, index], dtype=np.float32)
        point.pixel = np.array([320.0 + 300.0 * place[0], 240.0 + 300.0 * place[1]], dtype=np.float32)
        point.confidence = float(part.confidence[frame, index])
        points.append(point)
    return points
