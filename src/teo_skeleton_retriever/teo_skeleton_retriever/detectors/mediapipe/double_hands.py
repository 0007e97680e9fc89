"""One hand that was taken for both.

Where hands come close, MediaPipe's crops of the left and of the right hand may both settle on the same one:
in a rendered take of two hands on each other, in 17 of 120 images.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.layouts.body_25 import BODY_25
from teo_skeleton_retriever.layouts.hand_21 import HAND_21
from teo_skeleton_retriever.layouts.person_2d import Person2D

SAME = 0.35
"""Mean distance of their keypoints, in mean distances from the hand's middle, below which two hands are one.
Of one hand taken twice it was 0 to 0.2; of two hands that touch, 0.9."""
_NOTHING = np.zeros((0, 3))


def without_doubles(person: Person2D) -> Person2D:
    """Take the hand away that is the other one: that which is farther from its own arm's wrist."""
    left, right = person.left_hand, person.right_hand
    if not (len(left) and len(right) and len(person.body)) or _apart(left, right) > SAME:
        return person
    if _off_arm(left, person, "LWrist") > _off_arm(right, person, "RWrist"):
        return replace(person, left_hand=_NOTHING, left_hand_world=None)
    return replace(person, right_hand=_NOTHING, right_hand_world=None)


def _apart(one: FloatArray, other: FloatArray) -> float:
    size = np.linalg.norm(one[:, :2] - one[:, :2].mean(axis=0), axis=1).mean()
    return float(np.linalg.norm(one[:, :2] - other[:, :2], axis=1).mean() / max(size, 1e-6))


def _off_arm(hand: FloatArray, person: Person2D, wrist: str) -> float:
    return float(np.linalg.norm(hand[HAND_21.index["Wrist"], :2] - person.body[BODY_25.index[wrist], :2]))
