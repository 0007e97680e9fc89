# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Tracks of the synthetic signer with exact truth, and no image rendered: 8 ms a frame."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from teo_common.arrays import Array
from teo_sign_capture.tracks.skeleton_track import Keypoints, SkeletonTrack, in_body_axes
from teo_synthetic_signer.body.signer import Signer
from teo_synthetic_signer.script.keys import Key
from teo_synthetic_signer.script.motion import Motion
from teo_synthetic_signer.script.scripts import script as script_named


def signer_track(script: str, body: str, rate: float = 30.0) -> SkeletonTrack:
    """A script played by a person.

    Args:
        script: One of `SCRIPTS`.
        body: One of `BODIES`.
        rate: Frames per second [Hz].
    """
    return keys_track(Signer(body), script_named(script), rate, source=f"{script} by {body}")


def keys_track(signer: Signer, keys: Sequence[Key], rate: float, *, source: str) -> SkeletonTrack:
    """Key poses played by a person, at a rate of frames [Hz]."""
    motion = Motion(signer.poser, keys)
    times = np.arange(0.0, motion.duration, 1.0 / rate)
    frames = []
    for time in times.tolist():
        pose = motion.pose(time)
        frames.append(signer.keypoints(pose, signer.poser.transforms(pose)))
    parts = [_known(np.array(part)) for part in zip(*frames, strict=True)]
    return in_body_axes(
        times=times,
        body=parts[0],
        left_hand=parts[1],
        right_hand=parts[2],
        face=parts[3],
        source=source,
        recorded=None,
        up=(0.0, 0.0, 1.0),
    )


def _known(positions: Array) -> Keypoints:
    count = positions.shape[:2]
    return Keypoints(
        positions=positions,
        sigma=np.zeros(count),
        confidence=np.ones(count),
        status=np.ones(count, np.uint8),
    )
