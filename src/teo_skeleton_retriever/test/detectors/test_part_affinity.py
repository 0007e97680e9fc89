# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest
from drawn_maps import draw, person
from hypothesis import given, settings
from hypothesis import strategies as st

from teo_skeleton_retriever.detectors.part_affinity import (
    BODY_25_MODEL,
    CAREFUL,
    GENEROUS,
    MOST_PER_PART,
    PAF_MODELS,
    PafModel,
    PafThresholds,
    assemble,
    find_limbs,
    find_peaks,
)

SIZE = (656, 368)
"""Of the network's input [px]: OpenPose's own for wide images."""
NEAR = 1.0
"""How far a part may be from where it was drawn [px]: an eighth of a cell."""
CROSSING = 8.0
"""The same where parts may lie on each other, whose peaks are then drawn as one [px]: a cell."""
PLACE = BODY_25_MODEL.layout.index
LEG = ("Hip", "Knee", "Ankle", "BigToe", "SmallToe", "Heel")


def decode(
    maps: np.ndarray,
    fields: np.ndarray,
    size: tuple[int, int] = SIZE,
    model: PafModel = BODY_25_MODEL,
    thresholds: PafThresholds = CAREFUL,
) -> tuple[np.ndarray, ...]:
    peaks = find_peaks(maps, size, thresholds.peak)
    return assemble(peaks, find_limbs(peaks, fields, size, model, thresholds), model, thresholds)


def assert_same_people(found: Sequence[np.ndarray], drawn: Sequence[np.ndarray], near: float = NEAR) -> None:
    """Each drawn person is found once, whole, with nobody else's parts and nothing beside."""
    assert len(found) == len(drawn)
    for parts in drawn:
        seen = np.isfinite(parts[:, 0])
        distance = [
            np.abs(body[seen, :2] - parts[seen]).max() + 1e3 * (body[seen, 2] == 0).any() for body in found
        ]
        body = found[int(np.argmin(distance))]
        assert min(distance) < near, np.round(np.column_stack([body, parts]), 1)
        assert not body[~seen].any()


@given(st.floats(12, 640), st.floats(12, 350))
@settings(max_examples=60, deadline=None)
def test_a_peak_is_found_between_the_cells(x: float, y: float) -> None:
    parts = np.full((25, 2), np.nan)
    parts[7] = x, y
    maps, _ = draw([parts], SIZE)
    peaks = find_peaks(maps, SIZE, 0.05)
    assert peaks.part.tolist() == [7]
    np.testing.assert_allclose(peaks.position[0], [x, y], atol=0.7)
    assert 0.8 < peaks.score[0] <= 1.0


@pytest.mark.parametrize("value", [0.0, 0.04, np.nan, -np.inf])
def test_maps_without_a_peak_give_nobody(value: float) -> None:
    maps = np.full((25, 46, 82), value, np.float32)
    assert decode(maps, np.zeros((52, 46, 82), np.float32)) == ()


ANGLES = st.floats(-np.pi, np.pi)


@pytest.mark.parametrize("model", PAF_MODELS, ids=lambda model: model.layout.name)
@given(
    x=st.floats(165, 490),
    lower=st.floats(0, 1),
    height=st.floats(180, 270),
    # In heights: shorter ones point at us and have no direction in the image.
    upper_arms=st.lists(st.tuples(st.floats(0.09, 0.17), ANGLES), min_size=2, max_size=2),
    forearms=st.lists(st.tuples(st.floats(0.09, 0.3), ANGLES), min_size=2, max_size=2),
)
@settings(max_examples=12, deadline=None)
def test_one_person_is_found_whole_however_the_arms_are_held(
    model: PafModel,
    x: float,
    lower: float,
    height: float,
    upper_arms: list[tuple[float, float]],
    forearms: list[tuple[float, float]],
) -> None:
    places: dict[str, tuple[float, float] | None] = {}
    for side, shoulder, upper, fore in zip("RL", (-0.11, 0.11), upper_arms, forearms, strict=True):
        elbow = np.array([shoulder, 0.0]) + upper[0] * np.array([np.cos(upper[1]), np.sin(upper[1])])
        wrist = elbow + fore[0] * np.array([np.cos(fore[1]), np.sin(fore[1])])
        places |= {f"{side}Elbow": tuple(elbow), f"{side}Wrist": tuple(wrist)}
    # Between arms that are stretched up and the feet all of the person is in the image.
    y = 0.48 * height + lower * (SIZE[1] - 2 - (0.48 + 0.85) * height)
    parts = person(x, y, height, model, **places)
    found = decode(*draw([parts], SIZE, model), model=model)
    # A part beside its neighbour's field may catch it; the drawn arms are one person's all the same.
    assert_same_people(found, [parts], near=CROSSING)


@pytest.mark.parametrize("apart", [60.0, 45.0, 30.0])
def test_people_who_overlap_are_told_apart(apart: float) -> None:
    behind, before = person(300, 70, 200), person(300 + apart, 90, 290)
    assert_same_people(decode(*draw([behind, before], SIZE)), [behind, before], near=2.0)


@pytest.mark.parametrize(
    "hidden",
    [
        ("LWrist",),
        ("LElbow", "LWrist"),
        tuple(f"R{part}" for part in LEG),
        ("Nose", "REye", "LEye", "REar", "LEar"),
        ("MidHip", *(f"{side}{part}" for side in "RL" for part in LEG)),
    ],
    ids=lambda hidden: hidden[0],
)
def test_hidden_parts_are_left_open_and_the_rest_stays_together(hidden: tuple[str, ...]) -> None:
    people = [person(220, 80, 280, **dict.fromkeys(hidden)), person(430, 90, 270)]
    assert_same_people(decode(*draw(people, SIZE)), people)


def test_noise_hides_nobody_and_invents_nobody() -> None:
    rng = np.random.default_rng(1)
    people = [person(200, 80, 280), person(430, 90, 270)]
    maps, fields = draw(people, SIZE)
    noisy_maps = maps + rng.normal(0.0, 0.06, maps.shape).astype(np.float32)
    noisy_fields = fields + rng.normal(0.0, 0.1, fields.shape).astype(np.float32)
    assert_same_people(decode(noisy_maps, noisy_fields), people, near=4.0)
    assert decode(noisy_maps - maps, noisy_fields - fields) == ()


def test_of_noise_only_the_strongest_peaks_are_looked_at() -> None:
    maps = np.random.default_rng(2).uniform(0.0, 1.0, (25, 46, 82)).astype(np.float32)
    assert np.bincount(find_peaks(maps, SIZE, 0.05).part).max() == MOST_PER_PART


def test_a_limb_whose_field_has_a_gap_is_no_limb_unless_asked_for() -> None:
    parts = person(320, 90)
    maps, fields = draw([parts], SIZE)
    for limb in (("RElbow", "RWrist"), ("LShoulder", "LElbow")):
        a, b = (PLACE[part] for part in limb)
        channels = BODY_25_MODEL.fields[BODY_25_MODEL.limbs.tolist().index([a, b])]
        middle = int((parts[a, 1] + parts[b, 1]) / 2 / 8)
        fields[channels, middle : middle + 2] = 0.0
    careful, generous = decode(maps, fields)[0], decode(maps, fields, thresholds=GENEROUS)[0]
    for part in ("RWrist", "LElbow"):
        assert not careful[PLACE[part]].any()
        assert generous[PLACE[part]].any()


def only(*names: str) -> dict[str, Any]:
    return {name: None for name in BODY_25_MODEL.layout.keypoints if name not in names}


def test_two_parts_are_no_person_unless_asked_for() -> None:
    maps, fields = draw([person(320, 90, **only("Neck", "RShoulder"))], SIZE)
    assert decode(maps, fields) == ()
    assert len(decode(maps, fields, thresholds=GENEROUS)) == 1
    maps, fields = draw([person(320, 90, **only("Neck", "RShoulder", "RElbow"))], SIZE)
    assert len(decode(maps, fields)) == 1


def test_feet_with_little_else_are_no_person() -> None:
    foot = ("RBigToe", "RSmallToe", "RHeel", "RAnkle")
    leg = (*foot, "RKnee", "RHip", "MidHip")
    body = (*leg, "Neck")
    found = [decode(*draw([person(320, 60, **only(*names))], SIZE)) for names in (foot, leg, body)]
    assert [len(people) for people in found] == [0, 0, 1]
