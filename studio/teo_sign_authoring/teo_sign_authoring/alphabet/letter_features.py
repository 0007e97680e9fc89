# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A letter as a reader sees it: handshape, orientation and movement, in differences that are just seen.

A robot's letters and the recordings are brought to the same features, so that `warp` says how different they
are.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from teo_common.arrays import Array
from teo_sign_authoring.alphabet.letter_clips import LetterClip
from teo_sign_authoring.alphabet.stroke import find_stroke
from teo_signs.likeness import SEEN_ANGLE, SEEN_LENGTH
from teo_skeleton_retriever.lifting.hand_axes import KNUCKLES, THUMB, palm_axes

# [m] Movement is seen where a difference in place is not. Between half and a third of a finger's thickness
# letters pass for their own recording alike; at a whole one still letters pass for those that differ by
# movement only.
_SEEN_MOVEMENT = SEEN_LENGTH / 2.0


def recorded_features(clip: LetterClip, scale: float, fingers: Sequence[int] = range(4)) -> Array:
    """What the person shows, in the robot's size, from where the hand is in place to where it leaves.

    Args:
        clip: The recording.
        scale: Metres of the robot's for a pixel of the recording.
        fingers: Which of the four are looked at, index 0: those that the robot has.
    """
    stroke = find_stroke(clip)
    hand = scale * clip.hand[stroke.first : stroke.last + 1]
    shown = [KNUCKLES[finger] for finger in fingers]
    ends = np.stack([hand[:, [knuckle + end for knuckle in shown]] for end in (0, 2, 3)], axis=1)
    return features(palm_axes(hand), ends, hand[:, THUMB + 3])


def features(palms: Array, fingers: Array, thumb: Array) -> Array:
    """Handshape, orientation and movement of each frame, in differences that are just seen.

    Args:
        palms: Columns along the hand, to the little finger's side, out of the palm. Shape (n, 3, 3).
        fingers: Knuckles, last joints and tips of the fingers, index first [m]. Shape (n, 3, fingers, 3).
        thumb: Its tip [m]. Shape (n, 3).

    Returns:
        Shape (n, 1, 43 of four fingers): one vector a frame, as `warp` takes them.
    """
    knuckles, tips = fingers[:, 0], np.concatenate([fingers[:, 2], thumb[:, None]], axis=1)
    # Both ends of the last phalanx: a fist and a claw have their tips at like places.
    ends = [fingers[:, 1] - knuckles, fingers[:, 2] - knuckles, (thumb - knuckles[:, 0])[:, None]]
    shape = np.einsum("tij,tki->tkj", palms, np.concatenate(ends, axis=1))
    # Across the view: depth is the unsure part of the recordings.
    movement = (tips - tips.mean(axis=0))[..., 1:]
    parts = (
        shape / (SEEN_LENGTH * np.sqrt(shape.shape[1])),
        palms[:, :, [0, 2]] / (SEEN_ANGLE * np.sqrt(2.0)),
        movement / (_SEEN_MOVEMENT * np.sqrt(movement.shape[1])),
    )
    return np.concatenate([part.reshape(len(part), -1) for part in parts], axis=1)[:, None]
