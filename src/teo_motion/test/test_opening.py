# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The first motion of a sentence: safe by itself, and a start for the whole plan."""

from __future__ import annotations

import numpy as np
import pytest
from made_signs import make_sign

from teo_description.humanoid import load_humanoid
from teo_description.robot import Robot
from teo_motion.collision.motion_clearance import MotionClearance
from teo_motion.planner import Planner
from teo_motion.trajectory.ruckig_segment import State
from teo_signs.errors import PlanError
from teo_signs.look_up_table import Lut
from teo_signs.tokens import parse_printed

REST = load_humanoid().ready

STILL = State.still(REST)
SENTENCES = ("HOLA", "TÚ AGUA BEBER", "A-N-A", "NO")


@pytest.fixture(scope="module")
def planner(robot: Robot, lut: Lut) -> Planner:
    return Planner(lut, robot=robot)


@pytest.mark.parametrize("text", SENTENCES)
def test_an_opening_is_safe_by_itself_and_the_whole_plan_takes_as_long(
    planner: Planner, robot: Robot, text: str
) -> None:
    tokens = parse_printed(text)
    opened = planner.plan_opening(tokens, STILL, lasting=0.4)
    assert opened is not None
    opening, until = opened
    limits = planner.limits
    times = np.linspace(0.0, opening.duration, 400)
    positions, velocities, accelerations = map(np.array, zip(*map(opening.at, times), strict=True))
    assert (positions >= limits.lower - 1e-6).all() and (positions <= limits.upper + 1e-6).all()
    assert (np.abs(velocities) <= limits.velocity + 1e-6).all()
    assert (np.abs(accelerations) <= limits.acceleration + 1e-6).all()
    np.testing.assert_allclose(positions[0], REST, atol=1e-9)
    np.testing.assert_allclose(velocities[-1], 0.0, atol=1e-9)
    assert MotionClearance(robot).nearest(opening.samples).distance > 0.0

    moving = opening.at(until)
    assert np.abs(moving.velocity).max() > 0.1, "the plan takes over from a robot in motion"
    going_on, whole = planner.plan(tokens, moving), planner.plan(tokens)
    assert until + going_on.duration < whole.duration + 0.1


def test_no_joint_stops_beyond_its_place_in_the_first_sign(robot: Robot) -> None:
    """The arms need longer to stop than the neck, which has less far to go."""
    turn = make_sign("TURN", [[0.1, 0.05], [0.05, 0.0]], [0.0, 0.2], joints=("AxialNeck", "FrontalNeck"))
    planner = Planner({"TURN": turn}, robot=robot)
    hanging = State.still(load_humanoid().hanging)
    opened = planner.plan_opening(parse_printed("TURN"), hanging, lasting=0.4)
    assert opened is not None
    neck = opened[0].positions[:, opened[0].names.index("AxialNeck")]
    assert 0.02 < neck.max() < 0.11  # within the smoothness of the stop


def test_no_opening_is_made_for_a_pause_that_moves_nothing(planner: Planner) -> None:
    assert planner.plan_opening(parse_printed("_"), STILL, lasting=0.4) is None


@pytest.mark.parametrize("away", [0.0, 1e-12, 0.01])
def test_no_opening_is_made_for_a_robot_that_is_at_the_first_sign_already(
    planner: Planner, away: float
) -> None:
    tokens = parse_printed("A")
    plan = planner.plan(tokens)
    there = plan.at(plan.timings[0].start + plan.timings[0].duration).position - away
    assert planner.plan_opening(tokens, State.still(there), lasting=0.4) is None


def test_a_sentence_that_cannot_be_looked_up_is_refused_at_once(planner: Planner) -> None:
    with pytest.raises(PlanError) as refused:
        planner.plan_opening(parse_printed("A Ω"), STILL, lasting=0.4)
    assert refused.value.code == "unknown_sign"
