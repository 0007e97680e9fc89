# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The executor signs with every value that its parameters may have."""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import fields

import pytest

from teo_description.robot import Robot
from teo_lut_executor.node.parameters import PARAMETERS, planner_settings_from
from teo_lut_executor.planning_worker import PlannerSettings
from teo_motion.planner import Planner
from teo_motion.sentence.sentence_form import SentenceForm, SentenceType
from teo_motion.sentence.signing_style import SigningStyle
from teo_signs.errors import PlanError
from teo_signs.look_up_table import Lut
from teo_signs.tokens import parse_printed

NewPlanner = Callable[[dict[str, float]], Planner]
DEFAULTS = {row.name: row.default for row in PARAMETERS}
DIALS = {field.name for kind in (PlannerSettings, SigningStyle) for field in fields(kind)}
RANGES = {row.name: (row.low, row.high) for row in PARAMETERS if row.name in DIALS and row.low is not None}
# What refuses sentences on purpose, and the code by which it does.
GATES = {"max_duration": "too_long", "least_clearance": "self_collision"}

QUESTION = SentenceForm(type=SentenceType.YES_NO_QUESTION)
SENTENCES = (
    ("TÚ _", SentenceForm()),
    ("A-N-N-A", SentenceForm()),
    ("CASA", QUESTION),
    ("35 _", SentenceForm(negated=True)),
    ("_ A", QUESTION),
)


@pytest.fixture
def planner(robot: Robot, lut: Lut) -> NewPlanner:
    return lambda values: planner_settings_from(DEFAULTS | values).planner(lut, robot, lut.language)


def assert_signs(planner: Planner) -> None:
    for text, form in SENTENCES:
        plan = planner.plan(parse_printed(text), form=form)
        assert plan.duration > 1.0
        assert all(timing.duration >= 0.0 and timing.stretch >= 0.0 for timing in plan.timings)
        assert 0.5 < plan.stretch < 100.0


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "value"), [(name, end) for name, ends in RANGES.items() if name not in GATES for end in ends]
)
def test_each_parameter_at_both_ends_of_its_range_signs(planner: NewPlanner, name: str, value: float) -> None:
    assert_signs(planner({name: value}))


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("end", [0, 1])
def test_any_ends_of_the_ranges_of_parameters_sign(planner: NewPlanner, seed: int, end: int) -> None:
    """What is at its least for one `end` is at its most for the other."""
    dice = random.Random(seed)
    chosen = {name: ends[dice.randrange(2) ^ end] for name, ends in RANGES.items()}
    assert_signs(planner({name: value for name, value in chosen.items() if name not in GATES}))


@pytest.mark.parametrize("seed", range(6))
def test_any_parameters_within_their_ranges_sign(planner: NewPlanner, seed: int) -> None:
    dice = random.Random(seed)
    assert_signs(planner({name: dice.uniform(*ends) for name, ends in RANGES.items() if name not in GATES}))


@pytest.mark.parametrize(("name", "code"), GATES.items())
def test_a_limit_at_its_strictest_refuses_by_its_code_and_at_its_loosest_signs(
    planner: NewPlanner, name: str, code: str
) -> None:
    loosest, strictest = sorted(RANGES[name], key=lambda value: value * (-1 if name == "max_duration" else 1))
    assert_signs(planner({name: loosest}))
    strict = planner({name: strictest})
    for text, form in SENTENCES:
        with pytest.raises(PlanError) as refusal:
            strict.plan(parse_printed(text), form=form)
        assert refusal.value.code == code
