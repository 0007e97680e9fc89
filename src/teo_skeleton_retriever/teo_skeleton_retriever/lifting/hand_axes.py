# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The axes of a person's palm, and how the fingers are bent, from the 21 keypoints of a hand."""

from __future__ import annotations

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray

# MediaPipe's numbers: the wrist, the thumb's first joint, the fingers' knuckles; three more points follow
# each.
WRIST, THUMB, INDEX, MIDDLE, RING, LITTLE = 0, 1, 5, 9, 13, 17
KNUCKLES = (INDEX, MIDDLE, RING, LITTLE)
PALM = (WRIST, *KNUCKLES)

# [rad] What knuckle, middle and last joint seem bent by in a straight finger, where the signer shows none:
# joint centres do not lie on a line. Means over the synthetic signer's flat hands.
_STRAIGHT = np.radians([5.0, 8.0, 5.0])
# [rad] A joint that is never less bent than this has not been seen straight.
_SEEN_STRAIGHT = np.radians(20.0)
# [%] Share of the frames in which a finger is taken for straight, if it ever is.
_STRAIGHTEST = 5.0

# What the last joint of a finger bends by for each degree of the middle one.
_LAST_OF_MIDDLE = 2.0 / 3.0


def palm_axes(hand: FloatArray) -> FloatArray:
    """Axes of the palm straight from the landmarks.

    Args:
        hand: Landmarks. Shape (n, 21, 3).

    Returns:
        Columns: along the hand, to the little finger's side, out of the palm. Shape (n, 3, 3).
    """
    along = hand[:, (MIDDLE, RING)].mean(axis=1) - hand[:, WRIST]
    along = along / np.linalg.norm(along, axis=1, keepdims=True)
    # For a right hand, index side cross little finger's side points out of the palm.
    out = np.cross(hand[:, INDEX] - hand[:, WRIST], hand[:, LITTLE] - hand[:, WRIST])
    out -= (out * along).sum(axis=1, keepdims=True) * along
    out /= np.linalg.norm(out, axis=1, keepdims=True)
    return np.stack([along, np.cross(out, along), out], axis=-1)


def in_palm(hand: FloatArray) -> FloatArray:
    """Keypoints of right hands from the wrist, in palm axes [m]. Shapes (T, 21, 3)."""
    local: FloatArray = np.einsum("tij,tki->tkj", palm_axes(hand), hand - hand[:, WRIST, None])
    return local


def finger_bends(local: FloatArray) -> FloatArray:
    """Bends of knuckle, middle and last joint of index ... little finger [rad].

    Args:
        local: The 21 keypoints in palm axes. Shape (T, 21, 3).

    Returns:
        Shape (T, 4, 3).
    """
    bends = np.empty((len(local), 4, 3))
    for finger, knuckle in enumerate(KNUCKLES):
        bones = np.diff(local[:, knuckle : knuckle + 4], axis=1)
        bends[:, finger, 0] = np.arctan2(bones[:, 0, 2], bones[:, 0, 0])
        for joint in (1, 2):
            sine = np.linalg.norm(np.cross(bones[:, joint - 1], bones[:, joint]), axis=1)
            bends[:, finger, joint] = np.arctan2(sine, (bones[:, joint - 1] * bones[:, joint]).sum(axis=1))
    # A knuckle bent beyond 90 deg and more turns round through pi.
    bends[..., 0] = np.where(bends[..., 0] < -np.pi / 2.0, bends[..., 0] + 2.0 * np.pi, bends[..., 0])
    return bends


def straight_bends(hands: FloatArray) -> FloatArray:
    """What the joints of a signer's fingers seem bent by while the fingers are straight.

    Args:
        hands: 21 keypoints of right hands, left ones in a mirror, in any number of frames; NaN where lost
            [m]. Shape (T, 21, 3).

    Returns:
        Of knuckle, middle and last joint of index ... little finger; of a joint that is never seen straight
        what is usual [rad]. Shape (4, 3).
    """
    seen = hands[np.isfinite(hands).all(axis=(1, 2))]
    if not len(seen):
        return np.tile(_STRAIGHT, (4, 1))
    least = np.percentile(finger_bends(in_palm(seen)), _STRAIGHTEST, axis=0)
    # A knuckle that bends backwards is straight before it does.
    straight: FloatArray = np.where(least < _SEEN_STRAIGHT, np.maximum(least, 0.0), _STRAIGHT)
    return straight


def with_last_joints(bends: FloatArray) -> FloatArray:
    """Bends of fingers whose last joints follow the middle ones, as one tendon bends both.

    Detectors hardly see the last joint of a bent finger: in rendered fists MediaPipe bent it by 33 deg of 60.

    Args:
        bends: As `finger_bends` gives them, from straight. Shape (T, 4, 3).

    Returns:
        The same with last joints that are bent by two thirds of the middle ones at least (Rijpkema and
        Girard, "Computer animation of knowledge-based human grasping", 1991).
    """
    last = np.maximum(bends[..., 2], _LAST_OF_MIDDLE * bends[..., 1])
    return np.concatenate([bends[..., :2], last[..., None]], axis=-1)
