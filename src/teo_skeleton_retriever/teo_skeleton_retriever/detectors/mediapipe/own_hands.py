"""Hands that are the person's other hand.

Where arms cross, MediaPipe's crop of one hand may settle on the other one and follow it for a second, as sure
as ever. Its network also tells left hands from right ones, which gives this away.
"""

from __future__ import annotations

from typing import NamedTuple

from teo_skeleton_retriever.detectors.mediapipe.holistic_graph import HolisticLandmarks

LEAST_SIDE = 0.3
"""Below it a hand is the other one. Of 646 hands on rendered people 16 were the other hand, 15 of them below
it, with 11 of the 630 others: fists, or hands seen from their edge, which were off by 33 mm instead of 9."""


class OwnHands(NamedTuple):
    """Which of two hands are what they were taken for."""

    left: bool
    right: bool


def own_hands(landmarks: HolisticLandmarks) -> OwnHands:
    """Tell which hands are on the side that they were looked for on. Only with two can one be the other."""
    if landmarks.left_hand is None or landmarks.right_hand is None:
        return OwnHands(landmarks.left_hand is not None, landmarks.right_hand is not None)
    return OwnHands(landmarks.left_hand_side >= LEAST_SIDE, landmarks.right_hand_side >= LEAST_SIDE)
