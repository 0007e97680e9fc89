# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
from collections.abc import Callable
from itertools import pairwise, product

import numpy as np
import pytest

from teo_common.arrays import Array
from teo_description.humanoid import load_humanoid
from teo_motion.planner import Planner
from teo_motion.sentence.posture_choice import choose_postures, postures_of, shortest_postures
from teo_motion.trajectory.limits import MotionLimits
from teo_names import COMMANDED_JOINTS, LEFT_ARM, RIGHT_ARM, joint_limits
from teo_signs.lexicon import SignedToken
from teo_signs.sign import Sign
from teo_signs.tokens import Kind, Token

REST = load_humanoid().ready

LIMITS = MotionLimits.of_robot()
MakeSign = Callable[..., Sign]


def with_alternatives(sign: Sign, *others: Array) -> Sign:
    return dataclasses.replace(sign, alternatives=others)


def total_time(signs: list[Sign], postures: tuple[int, ...]) -> float:
    """Time of the slowest joint of every way, added one by one."""
    place, known, time = dict(zip(COMMANDED_JOINTS, REST.tolist(), strict=True)), set(COMMANDED_JOINTS), 0.0
    for sign, posture in zip(signs, postures, strict=True):
        path = postures_of(sign)[posture]
        ways = {j: path[0, i] - place[j] for i, j in enumerate(sign.joints) if j in known}
        time += slowest(ways)
        for (before, after), step in zip(pairwise(path), np.diff(sign.times), strict=True):
            time += max(float(step), float((np.abs(after - before) / np.radians(50.0)).max()))
        known, place = set(sign.joints), dict(zip(sign.joints, path[-1].tolist(), strict=True))
    return time + slowest({j: REST[COMMANDED_JOINTS.index(j)] - place[j] for j in known})


def slowest(ways: dict[str, float]) -> float:
    columns = [COMMANDED_JOINTS.index(joint) for joint in ways]
    return float(LIMITS.least_times(np.array(list(ways.values())), columns).max()) if ways else 0.0


@pytest.mark.parametrize("seed", range(25))
def test_no_other_choice_of_postures_takes_less_time(make_sign: MakeSign, seed: int) -> None:
    generator = np.random.default_rng(seed)
    signs = []
    for number in range(int(generator.integers(1, 6))):
        joints = (RIGHT_ARM, LEFT_ARM, RIGHT_ARM + LEFT_ARM)[generator.integers(3)]
        limits = joint_limits(joints)
        knots = int(generator.integers(1, 4))
        count = int(generator.integers(1, 4))
        paths = generator.uniform(limits.lower, limits.upper, (count, knots, len(joints)))
        sign = make_sign(f"S{number}", paths[0], 0.3 * np.arange(knots), joints=joints)
        signs.append(with_alternatives(sign, *paths[1:]))
    chosen = shortest_postures(signs, REST, REST, LIMITS)
    every = product(*(range(len(postures_of(sign))) for sign in signs))
    assert total_time(signs, tuple(chosen)) == pytest.approx(min(total_time(signs, one) for one in every))


def test_a_doubled_letter_keeps_its_posture(make_sign: MakeSign) -> None:
    letter = with_alternatives(make_sign("L", np.full((1, 6), -0.8), joints=RIGHT_ARM), np.zeros((1, 6)))
    start = REST.copy()
    start[[COMMANDED_JOINTS.index(name) for name in RIGHT_ARM]] = -0.8
    first, second = shortest_postures([letter, letter], start, REST, LIMITS)
    assert first == second


def test_signs_without_a_choice_and_pauses_stay_as_they_are(make_sign: MakeSign) -> None:
    sign = make_sign("A", np.zeros((1, 6)), joints=RIGHT_ARM)
    signed = (
        SignedToken(token=Token(gloss="A"), sign=sign),
        SignedToken(token=Token(gloss="", kind=Kind.PAUSE), sign=None),
    )
    assert choose_postures(signed, start=REST, end=REST, limits=LIMITS) == signed
    assert choose_postures((), start=REST, end=REST, limits=LIMITS) == ()
    assert shortest_postures([], REST, REST, LIMITS) == []


def test_a_plan_passes_the_posture_that_was_chosen(make_sign: MakeSign) -> None:
    near, far = np.radians([[-20.0, 0, 0, -30.0, 0, 0]]), np.radians([[-60.0, 0, 0, -90.0, 40.0, 0]])
    sign = with_alternatives(make_sign("A", far, joints=RIGHT_ARM), near)
    plan = Planner({"A": sign}).plan([Token(gloss="A")])
    position = plan.at(plan.timings[0].start)[0]
    columns = [COMMANDED_JOINTS.index(name) for name in RIGHT_ARM]
    np.testing.assert_allclose(position[columns], near[0], atol=1e-6)
