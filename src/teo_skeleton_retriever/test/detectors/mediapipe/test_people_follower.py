# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from teo_skeleton_retriever.detectors.mediapipe.holistic_graph import HolisticLandmarks
from teo_skeleton_retriever.detectors.mediapipe.people_follower import (
    LOOK_EVERY,
    VIEWS,
    PeopleFollower,
    Sighting,
)

IMAGE = np.zeros((480, 640, 3), dtype=np.uint8)
SHOULDERS_AND_HIPS = {11: (0.03, 0.1), 12: (-0.03, 0.1), 23: (0.02, 0.4), 24: (-0.02, 0.4)}
ALL_SEEN_TWICE = 2 * LOOK_EVERY * len(VIEWS)  # images until each view was glanced at twice


class Room:
    """People side by side, by where their noses are, in [0, 1] of the width."""

    def __init__(self, count: int) -> None:
        self.noses = [(i + 1) / (count + 1) for i in range(count)]

    def find(self, image: np.ndarray, view: str) -> list[Sighting]:
        del image, view
        regions: list[Any] = [SimpleNamespace(height=0.9, x_center=nose) for nose in self.noses]
        return [Sighting(region, np.array([region.x_center, 0.2])) for region in regions]

    def close(self) -> None:
        """Nothing to release."""


class OnePerson:
    """Follows whom it is shown first."""

    def __init__(self) -> None:
        self.nose: float | None = None

    def begin(self, image: np.ndarray, region: Any = None) -> None:
        del image
        if region is not None:
            self.nose = region.x_center

    def finish(self, pending: None) -> HolisticLandmarks:
        del pending
        assert self.nose is not None
        pose = np.full((33, 5), 0.9)
        pose[:, :2] = self.nose, 0.2
        for row, (aside, below) in SHOULDERS_AND_HIPS.items():
            pose[row, :2] = self.nose + aside, 0.2 + below
        return HolisticLandmarks(pose, *[None] * 5, *[0.0] * 5)

    def close(self) -> None:
        """Nothing to release."""


def follower(room: Room, **changes: Any) -> PeopleFollower:
    makers: Any = OnePerson
    finder: Any = room
    return PeopleFollower(makers, finder, 4, **({"counts_more": True} | changes))


@pytest.mark.parametrize(
    ("people", "asked_for", "left_out"),
    [(1, True, 0), (4, True, 0), (5, True, 1), (6, True, 2), (5, False, 0)],
)
def test_more_people_than_can_be_followed_are_told_unless_fewer_are_asked_for(
    people: int, asked_for: bool, left_out: int
) -> None:
    following = follower(Room(people), counts_more=asked_for)
    seen = [len(following.follow(IMAGE)) for _ in range(ALL_SEEN_TWICE)]
    assert set(seen) == {min(people, 4)}
    assert following.left_out == left_out


def test_what_only_one_glance_takes_for_a_person_is_nobody() -> None:
    room = Room(5)
    fifth = room.noses.pop()
    following = follower(room)
    for _ in range(ALL_SEEN_TWICE):
        following.follow(IMAGE)
    room.noses.append(fifth)
    for _ in range(LOOK_EVERY):
        following.follow(IMAGE)
    assert following.left_out == 0
