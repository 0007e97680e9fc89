# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Hands that MediaPipe took for the person's other hand, and one hand that it took for both.

Where arms cross, MediaPipe's crop of one hand may settle on the other one and follow it for a second, as sure
as ever; its network also tells left hands from right ones, which gives this away. Where hands come close,
both crops may settle on the same hand: in a rendered take of two hands on each other, in 17 of 120 images.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.detectors.mediapipe.holistic_graph import HolisticLandmarks
from teo_skeleton_retriever.layouts.layout import BODY_25, HAND_21
from teo_skeleton_retriever.layouts.person_2d import Person2D

# Below it a hand is the other one. Of 646 hands on rendered people 16 were the other hand, 15 of them below
# it, with 11 of the 630 others: fists, or hands seen from their edge, which were off by 33 mm instead of 9.
LEAST_SIDE = 0.3


class OwnHands(NamedTuple):
    """Whether the left and the right hand are there and on the side they were taken for."""

    left: bool
    right: bool


def own_hands(landmarks: HolisticLandmarks) -> OwnHands:
    """Tell which hands are on the side they were taken for; a single hand always counts as such."""
    if landmarks.left_hand is None or landmarks.right_hand is None:
        return OwnHands(landmarks.left_hand is not None, landmarks.right_hand is not None)
    return OwnHands(landmarks.left_hand_side >= LEAST_SIDE, landmarks.right_hand_side >= LEAST_SIDE)


# Mean distance of their keypoints, in mean distances from the hand's middle, below which two hands are one.
# Of one hand taken twice it was 0 to 0.2; of two hands that touch, 0.9.
_SAME_HAND = 0.35
_NOTHING = np.zeros((0, 3))


def without_doubles(person: Person2D) -> Person2D:
    """Where both hands are the same one, remove that which is farther from its own arm's wrist."""
    left, right = person.left_hand, person.right_hand
    if not (len(left) and len(right) and len(person.body)) or _apart(left, right) > _SAME_HAND:
        return person
    if _off_arm(left, person, "LWrist") > _off_arm(right, person, "RWrist"):
        return replace(person, left_hand=_NOTHING, left_hand_world=None)
    return replace(person, right_hand=_NOTHING, right_hand_world=None)


def _apart(one: FloatArray, other: FloatArray) -> float:
    size = np.linalg.norm(one[:, :2] - one[:, :2].mean(axis=0), axis=1).mean()
    return float(np.linalg.norm(one[:, :2] - other[:, :2], axis=1).mean() / max(size, 1e-6))


def _off_arm(hand: FloatArray, person: Person2D, wrist: str) -> float:
    return float(np.linalg.norm(hand[HAND_21.index["Wrist"], :2] - person.body[BODY_25.index[wrist], :2]))
