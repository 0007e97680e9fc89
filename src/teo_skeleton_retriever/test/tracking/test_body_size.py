# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import numpy as np
import pytest
from capsule_person import FOREARM, ROW, SHOULDERS, UPPER_ARM, pose

from teo_skeleton_retriever.tracking.body_size import BodySize, LimbLength


def seen(size: float, images: int = 60, *, noise: float = 0.008) -> BodySize:
    random = np.random.default_rng(2)
    body = pose((-0.5, 0.2, -0.1), (0.5, 0.2, -0.1), size=size).body
    estimate = BodySize()
    for _ in range(images):
        estimate.step(body + random.normal(0.0, noise, body.shape))
    return estimate


@pytest.mark.parametrize("size", [0.75, 1.0, 1.15])
def test_lengths_are_those_of_the_person(size: float) -> None:
    estimate = seen(size)
    assert estimate.length("upper arm")[0] == pytest.approx(size * UPPER_ARM, abs=0.01)
    assert estimate.length("forearm")[0] == pytest.approx(size * FOREARM, abs=0.01)
    assert estimate.scale == pytest.approx(size * SHOULDERS / 0.36, rel=0.05)


def test_arms_that_a_detector_sees_short_for_minutes_are_not_believed_to_be() -> None:
    body = pose((-0.5, 0.2, -0.1), (0.5, 0.2, -0.1), size=1.0).body
    for side in "RL":
        shoulder, elbow = body[ROW[f"{side}Shoulder"]], body[ROW[f"{side}Elbow"]]
        elbow += 0.4 * (shoulder - elbow)
    estimate = BodySize(averaging=True)
    for _ in range(600):
        estimate.step(body)
    length, sigma = estimate.length("upper arm")
    assert length > 0.65 * UPPER_ARM
    assert sigma > 0.01


def test_a_forearm_that_was_never_seen_grows_with_the_shoulders() -> None:
    body = pose((-0.5, 0.2, -0.1), (0.5, 0.2, -0.1), size=1.2).body
    body[[4, 7]] = math.nan
    estimate = BodySize()
    for _ in range(60):
        estimate.step(body)
    assert estimate.length("forearm")[0] > 1.05 * BodySize().length("forearm")[0]


def test_a_leg_twice_as_long_is_beyond_belief() -> None:
    estimate = seen(1.0)
    assert estimate.too_long("thigh", 0.9)
    assert not estimate.too_long("thigh", 0.45)


def test_hands_differ_less_than_shoulders() -> None:
    small, large = seen(0.75), seen(1.15)
    assert 1.0 < large.hand_scale / small.hand_scale < large.scale / small.scale


def test_shoulders_that_are_seen_as_an_average_persons_are_put_right() -> None:
    for true in (0.30, 0.36, 0.44):
        seen_width = 0.36 * (true / 0.36) ** (1.0 / 1.4)
        estimate = BodySize(averaging=True)
        for _ in range(60):
            body = np.full((25, 3), math.nan)
            width = seen_width * estimate.widening
            body[[2, 5]] = (-width / 2.0, -0.3, 1.5), (width / 2.0, -0.3, 1.5)
            estimate.step(body)
        assert estimate.scale * 0.36 == pytest.approx(true, rel=0.02)
        assert estimate.widening * seen_width == pytest.approx(true, rel=0.02)


NEAR = np.array([0.1, 0.2, 1.8])


def ends(length: float, along: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """A limb whose direction has this share along the camera's axis."""
    direction = np.array([math.sqrt(1.0 - along**2), 0.0, along])
    return NEAR, NEAR + length * direction


def test_a_bad_start_is_forgotten() -> None:
    limb = LimbLength()
    for _ in range(41):
        limb.step(*ends(0.45))
    assert limb.value == pytest.approx(0.45)
    for _ in range(300):
        limb.step(*ends(0.27))
    assert limb.value == pytest.approx(0.27)


def test_two_fifths_of_wild_lengths_do_not_move_it() -> None:
    random = np.random.default_rng(2)
    limb = LimbLength()
    for _ in range(300):
        wild = random.random() < 0.4
        limb.step(*ends(random.uniform(0.1, 0.6) if wild else random.normal(0.27, 0.004)))
    assert limb.value == pytest.approx(0.27, abs=0.006)


def test_limbs_across_the_view_count_more_than_limbs_along_it() -> None:
    limb = LimbLength()
    for _ in range(60):
        limb.step(*ends(0.40, along=0.95))
    for _ in range(40):
        limb.step(*ends(0.27, along=0.1))
    assert limb.value == pytest.approx(0.27)


@pytest.mark.parametrize("length", [0.0, 0.05, 0.9, math.nan, math.inf])
def test_lengths_that_no_human_has_do_not_count(length: float) -> None:
    limb = LimbLength()
    for _ in range(50):
        limb.step(NEAR, NEAR + np.array([length, 0.0, 0.0]))
    assert limb.value is None
    assert not limb.too_long(10.0)
