# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The person in a track, described once: measures, places of the body, head, trunk, arms and hands."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from teo_common.arrays import Array
from teo_description.humanoid import Side
from teo_sign_capture.signing_space import HEEL, MIRROR, PALM, person_hand_points
from teo_sign_capture.tracks.head_pose import HeadPose, head_pose, head_shape
from teo_sign_capture.tracks.skeleton_track import (
    BODY,
    EAR,
    ELBOW,
    EYE,
    HAND,
    MID_HIP,
    NOSE,
    SHOULDER,
    WRIST,
    SkeletonTrack,
    filled,
    seen,
)
from teo_signs.errors import LutError
from teo_signs.sign_schema import Handedness
from teo_skeleton_retriever.lifting.hand_axes import WRIST as HAND_WRIST
from teo_skeleton_retriever.lifting.hand_axes import (
    finger_bends,
    palm_axes,
    straight_bends,
    with_last_joints,
)

# Rows of `head_shape`.
_CHIN, _LIPS, _BROWS = BODY + 8, (BODY + 51, BODY + 57), (BODY + 21, BODY + 22)

# Proportions of adults: means of the six bodies of the synthetic signer (MakeHuman's, CC0), measured on their
# skin. Lengths in lengths of the trunk, between shoulders and hips; places from between the shoulders.
# Length of the trunk over that of the upper arm, where no hips are seen.
_TRUNK_OF_UPPER_ARM = 1.7
_FORE_OF_UPPER_ARM, _PALM_OF_UPPER_ARM = 0.87, 0.25
# Skin before the shoulder's joint, from the joint.
_SHOULDER_FRONT = (0.13, -0.01, 0.04)
_TORSO = {
    "throat": (0.13, 0.0, 0.11),
    "upper_chest": (0.24, 0.0, -0.10),
    "chest": (0.29, 0.0, -0.22),
    "chest_aside": (0.27, -0.20, -0.20),
    "belly": (0.27, 0.0, -0.62),
}
_HEAD = {
    "nose": (0.30, 0.0, 0.40),
    "eye": (0.24, -0.063, 0.48),
    "ear": (0.04, -0.17, 0.44),
    "chin": (0.25, 0.0, 0.25),
    "mouth": (0.28, 0.0, 0.33),
    "brow": (0.26, 0.0, 0.50),
}
# The middle of the forehead is above the brows by so much of their height above the tip of the nose.
_FOREHEAD = 0.8


@dataclass(frozen=True, kw_only=True, eq=False)
class Person:
    """A person's measures, in axes as of a track.

    Attributes:
        shoulder: Half the distance between the shoulders [m].
        upper_arm, fore_arm: Their lengths [m].
        palm: From the wrist to the middle of the palm [m].
        trunk: From between the hips to between the shoulders [m].
        head: Middle of the head where it mostly is [m]. Shape (3,).
        head_shape: Keypoints of the head, as `head_pose.head_shape` finds them [m]. Shape (95, 3).
        straight: What knuckle, middle and last joint of index ... little finger seem bent by while they are
            straight [rad]. Shape (4, 3).
        places: Places of articulation on the skin by their names in `signing_space`, the head held
            straight; those aside are the right ones, the left ones mirror them. Shape (3,) each.
    """

    shoulder: float
    upper_arm: float
    fore_arm: float
    palm: float
    trunk: float
    head: Array
    head_shape: Array
    straight: Array
    places: dict[str, Array]

    @property
    def arm(self) -> float:
        """From the shoulder over elbow and wrist to the middle of the palm [m]."""
        return self.upper_arm + self.fore_arm + self.palm


def measure_person(track: SkeletonTrack) -> Person:
    """Measure a person over a whole recording; what is never seen is as proportions have it.

    Raises:
        LutError: "no_arm" if neither arm is ever seen from shoulder to elbow.
    """
    body = track.body.positions
    upper = _length(body, SHOULDER, ELBOW)
    if not np.isfinite(upper):
        raise LutError(
            "no_arm",
            f"{track.source}: expected an arm that is seen from the shoulder to the elbow, got none in "
            f"{len(track.times)} frames",
        )
    fore = _length(body, ELBOW, WRIST)
    keypoints = np.concatenate([track.right_hand.positions, track.left_hand.positions * MIRROR])
    hands = person_hand_points(keypoints)
    palm = _median(np.linalg.norm(hands[:, PALM] - hands[:, HEEL], axis=-1))
    trunk = -_median(body[:, MID_HIP, 2])
    trunk = trunk if np.isfinite(trunk) else _TRUNK_OF_UPPER_ARM * upper
    shoulder = _median(body[:, SHOULDER["left"], 1] - body[:, SHOULDER["right"], 1]) / 2.0
    places = {name: trunk * np.array(place) for name, place in _TORSO.items()}
    places["shoulder"] = trunk * np.array(_SHOULDER_FRONT) - (0.0, shoulder, 0.0)
    shape = head_shape(track)
    held = head_pose(track, shape)
    middle = np.array([_median(held.places[:, axis]) for axis in range(3)])
    if not np.isfinite(middle).all():
        middle = trunk * np.array(_HEAD["ear"]) * (1.0, 0.0, 1.0)
    return Person(
        shoulder=shoulder,
        upper_arm=upper,
        fore_arm=fore if np.isfinite(fore) else _FORE_OF_UPPER_ARM * upper,
        palm=palm if np.isfinite(palm) else _PALM_OF_UPPER_ARM * upper,
        trunk=trunk,
        head=middle,
        head_shape=shape,
        straight=straight_bends(keypoints),
        places=places | _facial_places(shape + middle, middle, trunk),
    )


def _facial_places(shape: Array, middle: Array, trunk: float) -> dict[str, Array]:
    """Places of the head from its keypoints; those not seen keep their distance from one that is."""
    usual = {name: trunk * np.array(place) for name, place in _HEAD.items()}
    found = {
        "nose": _between(shape[[NOSE]]),
        "eye": _aside(shape, EYE),
        "ear": _aside(shape, EAR),
        "chin": _between(shape[[_CHIN]]),
        "mouth": _between(shape[list(_LIPS)]),
        "brow": _between(shape[list(_BROWS)]),
    }
    known = [name for name, place in found.items() if np.isfinite(place).all()]
    shift = middle - usual["ear"] * (1.0, 0.0, 1.0)
    if known:
        shift = np.mean([found[name] - usual[name] for name in known], axis=0) * (1.0, 0.0, 1.0)
    places = {name: found[name] if name in known else usual[name] + shift for name in usual}
    brow = places.pop("brow")
    rise = np.array([0.0, 0.0, _FOREHEAD * (brow[2] - places["nose"][2])])
    # The eyes are half-way from chin to crown, the brows nearly.
    crown = np.array([places["ear"][0], 0.0, 2.0 * brow[2] - places["chin"][2]])
    return places | {"forehead": brow + rise, "head_top": crown}


def _between(points: Array) -> Array:
    """The middle of points, on the midline. Shape (3,)."""
    middle: Array = points.mean(axis=0) * (1.0, 0.0, 1.0)
    return middle


def _aside(shape: Array, rows: dict[str, int]) -> Array:
    """The right one of a pair of places that mirror each other, from what is seen of both. Shape (3,)."""
    pair = np.stack([shape[rows["right"]], shape[rows["left"]] * MIRROR])
    known = pair[seen(pair)]
    return known.mean(axis=0) if len(known) else np.full(3, np.nan)


def _length(body: Array, first: dict[str, int], second: dict[str, int]) -> float:
    """Length of a limb over both sides and all frames [m]; NaN if never seen."""
    sides = [body[:, first[side]] - body[:, second[side]] for side in first]
    return _median(np.linalg.norm(np.concatenate(sides), axis=-1))


def _median(values: Array) -> float:
    known = values[np.isfinite(values)]
    return float(np.median(known)) if known.size else float("nan")


SIDES_OF: dict[Handedness, tuple[Side, ...]] = {
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
            for side in SIDES_OF[handedness]
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
    local: Array = np.einsum("tij,tki->tkj", axes, hand - hand[:, HAND_WRIST, None])
    return SignerArm(
        side=side,
        joints=joints,
        keypoints=keypoints,
        points=person_hand_points(keypoints),
        axes=axes,
        local=local,
        bends=with_last_joints(finger_bends(local) - straight),
    )


def _hand_keypoints(track: SkeletonTrack, side: Side) -> Array:
    """A hand's keypoints, gaps filled. Shape (T, 21, 3)."""
    hand = track.hand(side).positions
    known = seen(hand).any(axis=0)
    if not known.all():
        raise LutError(
            "no_hand",
            f"{track.source}: expected a {side} hand with its {HAND} keypoints, got {known.sum()} of them in "
            f"{len(hand)} frames: was it in the picture?",
        )
    return np.stack([filled(track.times, keypoint) for keypoint in hand.transpose(1, 0, 2)], axis=1)


def _arm_joints(track: SkeletonTrack, side: Side) -> Array:
    """Shoulder, elbow and wrist, gaps filled. Shape (T, 3, 3)."""
    joints = track.body.positions[:, (SHOULDER[side], ELBOW[side], WRIST[side])]
    flat = joints.reshape(len(joints), -1)
    if not np.isfinite(flat).all(axis=1).any():
        raise LutError(
            "no_arm",
            f"{track.source}: expected a {side} arm with its shoulder, elbow and wrist, got none in "
            f"{len(joints)} frames: was it in the picture?",
        )
    return filled(track.times, flat).reshape(joints.shape)
