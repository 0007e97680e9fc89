# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What is known of the person in a track, found once: measures, head, trunk, arms and hands, gaps filled."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from teo_common.arrays import Array
from teo_description.humanoid import Side
from teo_sign_capture.signing_space.hand_points import MIRROR, WRIST, person_hand_points
from teo_sign_capture.tracks.body_axes import filled
from teo_sign_capture.tracks.hand_shape import finger_bends, palm_axes
from teo_sign_capture.tracks.head_pose import HeadPose, head_pose
from teo_sign_capture.tracks.person import Person, measure_person
from teo_sign_capture.tracks.skeleton_track import ELBOW, HAND, SHOULDER, SkeletonTrack
from teo_sign_capture.tracks.skeleton_track import WRIST as BODY_WRIST
from teo_signs.errors import LutError
from teo_signs.sign_schema import Handedness

_SIDES: dict[Handedness, tuple[Side, ...]] = {
    "right": ("right",),
    "left": ("left",),
    "both": ("right", "left"),
}


@dataclass(frozen=True, kw_only=True, eq=False)
class SignerArm:
    """An arm with its hand over time. Positions are in the axes of the track.

    Attributes:
        side: Which arm.
        joints: Shoulder, elbow and wrist [m]. Shape (T, 3, 3).
        keypoints: The 21 of the hand [m]. Shape (T, 21, 3).
        points: Points of the hand that can touch (`person_hand_points`) [m]. Shape (T, COUNT, 3).
        axes: Of the palm, as columns, a left hand seen in a mirror as a right one. Shape (T, 3, 3).
        local: The keypoints from the wrist, in these axes [m]. Shape (T, 21, 3).
        bends: Of knuckle, middle and last joint of index ... little finger from straight [rad].
            Shape (T, 4, 3).
    """

    side: Side
    joints: Array
    keypoints: Array
    points: Array
    axes: Array
    local: Array
    bends: Array


@dataclass(frozen=True, kw_only=True, eq=False)
class SignerMotion:
    """A person who signs, as far as retargeting needs to know.

    Attributes:
        source: Name of the recording.
        times: From the first frame [s]. Shape (T,).
        person: The person's measures.
        head: How the head is held.
        trunk: How the trunk is turned, as a rotation vector [rad]; zeros if it is not known. Shape (T, 3).
        arms: The arms that take part, by side, the right one first.
    """

    source: str
    times: Array
    person: Person
    head: HeadPose
    trunk: Array
    arms: dict[Side, SignerArm]


def signer_motion(
    track: SkeletonTrack, *, handedness: Handedness, person: Person | None = None
) -> SignerMotion:
    """Find what is known of the person in a track.

    Args:
        track: The person; smoothed, for what trembles in it trembles in the robot.
        handedness: The hands that take part.
        person: The person's measures, best from a whole recording of which the track is a part; without,
            they are taken from the track itself.

    Raises:
        LutError: "no_arm" or "no_hand" if what is needed was never seen.
    """
    person = person or measure_person(track)
    return SignerMotion(
        source=track.source,
        times=track.times,
        person=person,
        head=head_pose(track, person.head_shape),
        trunk=np.zeros((len(track.times), 3)) if track.trunk is None else track.trunk,
        arms={
            side: signer_arm(side, _arm_joints(track, side), _hand_keypoints(track, side), person.straight)
            for side in _SIDES[handedness]
        },
    )


def signer_arm(side: Side, joints: Array, keypoints: Array, straight: Array) -> SignerArm:
    """Describe an arm with its hand.

    Args:
        side: Which arm.
        joints: Shoulder, elbow and wrist, none NaN [m]. Shape (T, 3, 3).
        keypoints: Of the hand, none NaN [m]. Shape (T, 21, 3).
        straight: `Person.straight` [rad]. Shape (4, 3).
    """
    hand = keypoints if side == "right" else keypoints * MIRROR
    axes = palm_axes(hand)
    local: Array = np.einsum("tij,tki->tkj", axes, hand - hand[:, WRIST, None])
    return SignerArm(
        side=side,
        joints=joints,
        keypoints=keypoints,
        points=person_hand_points(keypoints),
        axes=axes,
        local=local,
        bends=finger_bends(local) - straight,
    )


def _hand_keypoints(track: SkeletonTrack, side: Side) -> Array:
    """A hand's keypoints, gaps filled. Shape (T, 21, 3)."""
    hand = track.hand(side).positions
    seen = np.isfinite(hand).all(axis=2).any(axis=0)
    if not seen.all():
        raise LutError(
            "no_hand",
            f"{track.source}: expected a {side} hand with its {HAND} keypoints, got {seen.sum()} of them in "
            f"{len(hand)} frames: was it in the picture?",
        )
    return np.stack([filled(track.times, keypoint) for keypoint in hand.transpose(1, 0, 2)], axis=1)


def _arm_joints(track: SkeletonTrack, side: Side) -> Array:
    """Shoulder, elbow and wrist, gaps filled. Shape (T, 3, 3)."""
    joints = track.body.positions[:, (SHOULDER[side], ELBOW[side], BODY_WRIST[side])]
    flat = joints.reshape(len(joints), -1)
    if not np.isfinite(flat).all(axis=1).any():
        raise LutError(
            "no_arm",
            f"{track.source}: expected a {side} arm with its shoulder, elbow and wrist, got none in "
            f"{len(joints)} frames: was it in the picture?",
        )
    return filled(track.times, flat).reshape(joints.shape)
