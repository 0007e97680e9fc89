# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import numpy as np
import pytest

from teo_skeleton_retriever.tracking.body_size import LimbLength

NEAR = np.array([0.1, 0.2, 1.8])


def ends(length: float, along: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """A limb whose direction has this share along the camera's axis."""
    direction = np.array([math.sqrt(1.0 - along**2), 0.0, along])
    return NEAR, NEAR + length * direction


def test_ours_has_an_estimate_after_a_third_of_a_second() -> None:
    limb = LimbLength()
    for _ in range(9):
        limb.step(*ends(0.28))
    assert limb.value is None
    limb.step(*ends(0.28))
    assert limb.value == pytest.approx(0.28)


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
