# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Where signs are made: directions in words, places of articulation, points of a hand that meet them.

A direction is said as a signer would: `front`, `up in`, `2 down back`. Where places are on a robot is said in
its ``robot.yaml``, for the right hand; left and right are mirrored for the left hand. Robots are not built as
people are: a place is named by the part of the body, never by a distance from another.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from teo_common.arrays import Array
from teo_description.hand_geometry import HandGeometry, HandTable
from teo_description.humanoid import Humanoid, load_humanoid
from teo_description.robot_schema import FINGERS
from teo_skeleton_retriever.lifting.hand_axes import KNUCKLES, WRIST

# Seen from the right hand, in ``base_link`` (REP-103: x front, y left, z up). The left hand mirrors them, so
# that `in` is always towards the other side of the body and `out` away from it.
WORDS: dict[str, tuple[float, float, float]] = {
    "front": (1.0, 0.0, 0.0),
    "back": (-1.0, 0.0, 0.0),
    "in": (0.0, 1.0, 0.0),
    "out": (0.0, -1.0, 0.0),
    "up": (0.0, 0.0, 1.0),
    "down": (0.0, 0.0, -1.0),
}


def displacement(text: str) -> Array:
    """The sum of words, each times the number before it or 1. Shape (3,).

    Raises:
        ValueError: A word is none of `WORDS`, or a number stands without one.
    """
    total = np.zeros(3)
    factor: float | None = None
    for word in text.split():
        if word in WORDS:
            total += (1.0 if factor is None else factor) * np.array(WORDS[word])
            factor = None
        elif factor is None and _is_number(word):
            factor = float(word)
        else:
            raise ValueError(
                f"expected words among {', '.join(WORDS)}, each after a number or not; got {word!r}"
            )
    if factor is not None:
        raise ValueError(f"expected a word after {factor:g} in {text!r}")
    return total


def direction(text: str) -> Array:
    """The unit vector of a sum of words. Shape (3,).

    Raises:
        ValueError: As `displacement`, or the words cancel each other or are none.
    """
    total = displacement(text)
    length = float(np.linalg.norm(total))
    if length < 1e-9:
        raise ValueError(f"expected a direction such as 'front' or '2 up in', got {text!r}")
    unit: Array = total / length
    return unit


def _is_number(word: str) -> bool:
    try:
        return bool(np.isfinite(float(word)))
    except ValueError:
        return False


@dataclass(frozen=True, slots=True)
class Place:
    """A point and the way out of the body there.

    Attributes:
        point: In ``base_link``, for the right hand [m]. Shape (3,).
        outward: Unit vector away from the body. Shape (3,).
        body: Whether it is on the body, where a centimetre tells a chin from a mouth; else in the air.
    """

    point: Array
    outward: Array
    body: bool


# On the body from the crown down, then in the air: before the chest, lower, at the shoulder, beside the face,
# before it.
_NAMES = (
    "head_top", "forehead", "temple", "eye", "nose", "ear", "cheek", "mouth", "mouth_corner", "chin",
    "throat", "shoulder", "other_shoulder", "upper_chest", "chest", "other_chest", "belly",
    "space", "low_space", "middle_space", "shoulder_space", "high_space", "face_space", "beside_head",
)  # fmt: skip

# The robot whose body and hand scores are written for.
WRITTEN_FOR = "teo"

# Points of the other hand that a hand may be at; resolved when the other hand is placed.
OTHER_HAND = ("other_palm", "other_back", "other_fingertips", "other_index_side", "other_wrist")

NAMES = (*_NAMES, *OTHER_HAND)


def find_place(humanoid: Humanoid, name: str) -> Place:
    """A place on a robot by its name.

    Raises:
        ValueError: There is none.
    """
    found = humanoid.file.places.get(name)
    if found is None:
        raise ValueError(f"expected a place among {', '.join(humanoid.file.places)}; got {name!r}")
    outward = np.array(found.outward)
    return Place(np.array(found.point), outward / np.linalg.norm(outward), found.body)


def written_place(name: str) -> Place:
    """A place on the body that scores are written for: their centimetres are counted from there.

    Raises:
        ValueError: There is none.
    """
    return find_place(load_humanoid(WRITTEN_FOR), name)


def split_place(text: str) -> tuple[str, Array]:
    """`mouth 3 front 2 out`: the name, and how far from it [m]. Offsets are written in centimetres.

    Raises:
        ValueError: The name is none of `NAMES`, or the rest no displacement.
    """
    name, _, rest = text.strip().partition(" ")
    if name not in NAMES:
        raise ValueError(f"expected a place among {', '.join(NAMES)}; got {name!r}")
    return name, 0.01 * displacement(rest)


_MIDDLES, _TIPS = (6, 10, 14, 18), (8, 12, 16, 20)
# Rows of the 21 keypoints.
_THUMB_JOINT, _THUMB_TIP = 3, 4

# Rows of the points below: the middle of the palm, and the end of the hand at the wrist.
PALM, HEEL = 0, 1

# Makes a left hand a right one.
MIRROR = np.array([1.0, -1.0, 1.0])

# Palm, heel, knuckles, middle joints and tips of the fingers, joint and tip of the thumb.
COUNT = 2 + 3 * 4 + 2

# The middle of the palm lies so far from the wrist to the knuckles, as on TEO.
_PALM_SHARE = 0.55


def person_hand_points(hand: Array) -> Array:
    """The points of a person's hand.

    Args:
        hand: Its 21 keypoints. Shape (T, 21, 3).

    Returns:
        Shape (T, COUNT, 3).
    """
    wrist, knuckles = hand[:, [WRIST]], hand[:, KNUCKLES].mean(axis=1, keepdims=True)
    palm = wrist + _PALM_SHARE * (knuckles - wrist)
    rows = [WRIST, *KNUCKLES, *_MIDDLES, *_TIPS, _THUMB_JOINT, _THUMB_TIP]
    return np.concatenate([palm, hand[:, rows]], axis=1)


def finger_rows(hand: HandGeometry) -> list[int]:
    """Which of a person's four fingers a hand has, index 0."""
    return [FINGERS.index(name) for name in hand.fingers]


def robot_hand_points(table: HandTable, axes: Array) -> Array:
    """The same points of a robot's right hand, in the axes of its palm.

    Where it lacks a finger, those of the finger beside it.

    Args:
        table: The hand.
        axes: Of `HandGeometry.joints` [rad]. Shape (T, axes).

    Returns:
        Shape (T, COUNT, 3).
    """
    count, rows = len(axes), finger_rows(table.hand)
    fixed = np.broadcast_to(np.array([table.hand.palm_middle, table.hand.heel]), (count, 2, 3))
    nearest = [int(np.argmin(np.abs(np.array(rows) - finger))) for finger in range(len(FINGERS))]
    fingers = table.finger_points(axes[:, 2:])[:, nearest]
    thumb = table.thumb_points(axes[:, 0], axes[:, 1])
    return np.concatenate([fixed, fingers[:, :, 0], fingers[:, :, 1], fingers[:, :, 3], thumb[:, 1:]], axis=1)
