# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A hand that hangs unseen is looked at now and then, any other one in every image."""

from __future__ import annotations

import numpy as np
import pytest

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.detectors.mediapipe.resting_hands import HANDS, LOOK_EVERY, RestingHands

SIZE = {"width": 640, "height": 480}
NOTHING = dict.fromkeys(HANDS, False)


def pose(wrist: tuple[float, float]) -> FloatArray:
    """Someone with elbows at 0.3, 0.6 and hips at a height of 0.8, whose right wrist is at rest."""
    marks = np.zeros((33, 5))
    marks[[13, 14]] = 0.3, 0.6, 0.0, 1.0, 1.0
    marks[[23, 24], 1] = 0.8
    marks[15, :2] = wrist
    marks[16, :2] = 0.3, 0.85
    return marks


HANGING = pose((0.31, 0.85))


def looks(hands: RestingHands, marks: FloatArray | None, images: int, **found: bool) -> list[bool]:
    """Show the same some times; gives in which of them the left hand was looked at."""
    looked = []
    for _ in range(images):
        looked.append(hands.next_looks()["left_hand"])
        hands.saw(marks, NOTHING | found, **SIZE)
    return looked


def test_a_hand_that_hangs_unseen_is_looked_at_in_every_third_image() -> None:
    looked = looks(RestingHands(), HANGING, 30)
    assert all(looked[:3])
    gaps = np.diff(np.flatnonzero(looked[3:]))
    assert set(gaps.tolist()) == {LOOK_EVERY}


@pytest.mark.parametrize(
    ("marks", "found"),
    [
        (HANGING, True),
        (pose((0.31, 0.7)), False),  # above the hip
        (pose((0.05, 0.85)), False),  # aside
        (pose((0.3, 0.3)), False),  # raised
        (pose((np.nan, np.nan)), False),
        (None, False),
    ],
)
def test_any_other_hand_is_looked_at_in_every_image(marks: FloatArray | None, found: bool) -> None:
    assert all(looks(RestingHands(), marks, 12, left_hand=found))


def test_a_hand_that_leaves_its_rest_or_shows_is_looked_at_in_the_next_image() -> None:
    for marks, found in ((pose((0.2, 0.78)), False), (HANGING, True), (None, False)):
        hands = RestingHands()
        looks(hands, HANGING, 20)
        looks(hands, marks, 1, left_hand=found)
        assert all(looks(hands, HANGING, 3))


def test_the_other_hand_is_its_own_matter() -> None:
    hands = RestingHands()
    for _ in range(20):
        looked = hands.next_looks()
        hands.saw(pose((0.3, 0.3)), NOTHING, **SIZE)
        assert looked["left_hand"]
    assert [hands.next_looks()["right_hand"] for _ in range(6)].count(True) == 2


def test_images_that_are_begun_before_others_are_seen_keep_the_pace() -> None:
    hands = RestingHands()
    looked = []
    for _ in range(15):
        looked += [hands.next_looks()["left_hand"], hands.next_looks()["left_hand"]]
        hands.saw(HANGING, NOTHING, **SIZE)
        hands.saw(HANGING, NOTHING, **SIZE)
    assert set(np.diff(np.flatnonzero(looked[6:])).tolist()) == {LOOK_EVERY}
