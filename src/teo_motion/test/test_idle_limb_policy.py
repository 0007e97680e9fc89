# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from teo_description.humanoid import load_humanoid
from teo_motion.planner import Planner
from teo_motion.sentence.plan import Plan
from teo_motion.trajectory.limits import MotionLimits
from teo_motion.trajectory.ruckig_segment import RuckigSolver, State
from teo_names import COMMANDED_JOINTS, LEFT_ARM
from teo_signs.sign import Sign
from teo_signs.tokens import parse_printed

REST = load_humanoid().ready


def columns(names: tuple[str, ...]) -> list[int]:
    return [COMMANDED_JOINTS.index(name) for name in names]


def during(plan: Plan, token: int, names: tuple[str, ...]) -> np.ndarray:
    timing = plan.timings[token]
    inside = (plan.times >= timing.start - 1e-9) & (plan.times <= timing.start + timing.duration + 1e-9)
    return plan.positions[inside][:, columns(names)]


def test_an_arm_that_is_needed_again_at_once_waits_where_it_is(table: Mapping[str, Sign]) -> None:
    plan = Planner(table).plan(parse_printed("CASA TÚ CASA"))
    waiting = during(plan, 1, LEFT_ARM)
    np.testing.assert_allclose(waiting, np.tile(waiting[0], (len(waiting), 1)), atol=5e-4)
    assert np.abs(waiting[0] - REST[columns(LEFT_ARM)]).max() > 0.5


def test_an_arm_at_rest_sets_out_while_the_other_still_signs(table: Mapping[str, Sign]) -> None:
    plan = Planner(table).plan(parse_printed("TÚ A-N-A CASA"))
    letter, casa = plan.timings[-2:]
    left = columns(LEFT_ARM)
    there = plan.at(casa.start)[0][left]
    takes = MotionLimits.of_robot().least_times(there - REST[left], left).max()
    ways = [
        np.abs(plan.at(time)[0][left] - REST[left]).max() for time in (casa.start - takes / 2.0, letter.start)
    ]
    assert ways[0] > 0.2, "half way up when its least time is half over"
    assert ways[1] == 0.0, "not long before"


def test_an_arm_that_is_not_needed_for_long_goes_to_rest_and_stays_there(table: Mapping[str, Sign]) -> None:
    plan = Planner(table).plan(parse_printed("CASA A-N-A-L CASA"))
    last_letter = during(plan, 4, LEFT_ARM)
    np.testing.assert_allclose(
        last_letter, np.tile(REST[columns(LEFT_ARM)], (len(last_letter), 1)), atol=1e-9
    )


def test_an_arm_on_its_way_to_rest_does_not_hold_up_the_other(table: Mapping[str, Sign]) -> None:
    planner = Planner(table)
    alone, after = (planner.plan(parse_printed(text)) for text in ("TÚ A-N-A", "CASA A-N-A"))
    for token in (2, 3):
        gaps = [plan.timings[token].start - plan.timings[token - 1].start for plan in (alone, after)]
        assert gaps[1] == pytest.approx(gaps[0], abs=1e-6)


@settings(max_examples=200)
@given(
    way=st.floats(-3.0, 3.0).filter(lambda way: abs(way) > 1e-6),
    velocity=st.floats(0.05, 2.0),
    acceleration=st.floats(0.1, 20.0),
    jerk=st.floats(0.5, 500.0),
)
def test_least_times_are_those_that_ruckig_finds(
    way: float, velocity: float, acceleration: float, jerk: float
) -> None:
    one = np.ones(1)
    limits = MotionLimits(
        humanoid=load_humanoid(),
        lower=-10 * one,
        upper=10 * one,
        velocity=velocity * one,
        acceleration=acceleration * one,
        jerk=jerk * one,
    )
    states = [State.still(p * one) for p in (0.0, way)]
    segment = RuckigSolver(1).segment(*states, limits.bounds, duration=0.0)
    assert segment is not None
    assert limits.least_times(way * one, [0])[0] == pytest.approx(segment.duration, rel=1e-5)
