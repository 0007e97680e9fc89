# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Exact keypoints laid into a picture, with the noise of a good detector."""

from __future__ import annotations

import math

import numpy as np

from teo_common.arrays import Array
from teo_sign_capture.tracks.skeleton_track import SkeletonTrack
from teo_skeleton_retriever.lifting.clip import Points, PoseClip

_PIXELS, _NOISE = 550.0, 1.5  # of a metre; deviation of a point [pixel], as MediaPipe's across the view
_DEPTH_NOISE, _DEPTH_SHARE = 0.006, 0.8  # of guessed depths in a hand: [m], and what is left of the true ones


def pictured(
    track: SkeletonTrack, *, distance: float = math.inf, depth: bool = True, rate: float = 25.0, seed: int = 0
) -> PoseClip:
    """A person as one camera without depth sees them.

    Args:
        track: Exact keypoints.
        distance: Of the camera [m]; infinite shows everything at one scale.
        depth: Whether depths within the hands are guessed, as MediaPipe does.
        rate: Of the track's frames [Hz].
        seed: Of the noise.
    """
    random = np.random.default_rng(seed)

    def part(true: Array, *, guessed: bool) -> Points:
        size = _PIXELS / (1.0 - true[..., 0] / distance)
        places = true * size[..., None] + random.normal(0.0, _NOISE, true.shape)
        along = (true - true[:, :1])[..., 0]
        guess = _DEPTH_SHARE * along + random.normal(0.0, _DEPTH_NOISE, along.shape)
        places[..., 0] = guess if guessed else np.nan
        return Points(places=places, confidence=np.ones(true.shape[:2]))

    return PoseClip(
        rate=rate,
        body=part(track.body.positions, guessed=False),
        left_hand=part(track.left_hand.positions, guessed=depth),
        right_hand=part(track.right_hand.positions, guessed=depth),
        source=track.source,
    )
