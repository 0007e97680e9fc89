# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a person's body is like: its lengths, and where on it the places of articulation are."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from teo_common.arrays import Array
from teo_sign_capture.signing_space.hand_points import HEEL, MIRROR, PALM, person_hand_points
from teo_sign_capture.tracks.hand_shape import straight_bends
from teo_sign_capture.tracks.head_pose import head_pose, head_shape
from teo_sign_capture.tracks.skeleton_track import (
    BODY,
    EAR,
    ELBOW,
    EYE,
    MID_HIP,
    NOSE,
    SHOULDER,
    WRIST,
    SkeletonTrack,
)
from teo_signs.errors import LutError

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
        places: Places of articulation on the skin by their names in `signing_space.places`, the head held
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
    seen = {
        "nose": _between(shape[[NOSE]]),
        "eye": _aside(shape, EYE),
        "ear": _aside(shape, EAR),
        "chin": _between(shape[[_CHIN]]),
        "mouth": _between(shape[list(_LIPS)]),
        "brow": _between(shape[list(_BROWS)]),
    }
    known = [name for name, place in seen.items() if np.isfinite(place).all()]
    shift = middle - usual["ear"] * (1.0, 0.0, 1.0)
    if known:
        shift = np.mean([seen[name] - usual[name] for name in known], axis=0) * (1.0, 0.0, 1.0)
    places = {name: seen[name] if name in known else usual[name] + shift for name in usual}
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
    seen = pair[np.isfinite(pair).all(axis=1)]
    return seen.mean(axis=0) if len(seen) else np.full(3, np.nan)


def _length(body: Array, first: dict[str, int], second: dict[str, int]) -> float:
    """Length of a limb over both sides and all frames [m]; NaN if never seen."""
    sides = [body[:, first[side]] - body[:, second[side]] for side in first]
    return _median(np.linalg.norm(np.concatenate(sides), axis=-1))


def _median(values: Array) -> float:
    known = values[np.isfinite(values)]
    return float(np.median(known)) if known.size else float("nan")
