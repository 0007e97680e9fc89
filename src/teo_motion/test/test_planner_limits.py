# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""No plan breaks a limit, whatever the signs: looked at in the motion itself and through a driver's eyes."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from made_signs import DriverView, random_table

from teo_description.humanoid import load_humanoid
from teo_description.robot import Robot
from teo_motion.planner import Planner
from teo_motion.sentence.plan import Plan
from teo_motion.sentence.sentence_form import STATEMENT, SentenceForm, SentenceType
from teo_motion.trajectory.limits import MotionLimits
from teo_motion.trajectory.ruckig_segment import State
from teo_names import COMMANDED_JOINTS
from teo_signs.errors import PlanError
from teo_signs.look_up_table import Lut, default_lut_directory
from teo_signs.sign import Sign
from teo_signs.tokens import Kind, Token

ROBOTS = ("teo", "gr1t2")
FORMS = [SentenceForm(type=kind, negated=negated) for kind in SentenceType for negated in (False, True)]

KINDS = {"lexical": Kind.LEXICAL, "letter": Kind.LETTER, "number": Kind.NUMBER}
PERIOD = 0.02
LOOK = 0.002  # [s] at which a motion is looked at for knots


def random_tokens(rng: np.random.Generator, table: Mapping[str, Sign], most: int) -> list[Token]:
    tokens = []
    for index in range(rng.integers(1, most + 1)):
        sign = table[str(rng.choice(sorted(table)))]
        pause = rng.random() < 0.1
        tokens.append(
            Token(
                gloss="" if pause else sign.gloss,
                kind=Kind.PAUSE if pause else KINDS[sign.kind],
                duration_scale=float(rng.choice([0.001, 0.3, 1.0, 2.0])),
                # Words of their own: numbers of one word would be one number.
                word_index=index,
                inflection="" if pause else str(rng.choice(["", *sign.forms])),
            )
        )
    return tokens


def check(
    plan: Plan,
    tokens: list[Token],
    table: Mapping[str, Sign],
    limits: MotionLimits,
    start: np.ndarray | None = None,
    form: SentenceForm = STATEMENT,
) -> None:
    """Everything that is promised of every plan."""
    humanoid, rest = limits.humanoid, limits.humanoid.ready

    # The motion itself, sampled densely, with jerk by finite differences.
    times = np.linspace(0.0, plan.duration, 3000)
    dense = [motion.at(times) for motion in plan.motions]
    positions, velocities, accelerations = (np.stack(column, axis=1) for column in zip(*dense, strict=True))
    assert (positions >= limits.lower - 1e-8).all() and (positions <= limits.upper + 1e-8).all()
    assert (np.abs(velocities) <= limits.velocity).all()
    assert (np.abs(accelerations) <= limits.acceleration).all()
    step = times[1]
    jerk = np.abs(np.diff(accelerations, axis=0)) / step
    assert (jerk <= limits.jerk * (1.0 + 1e-6)).all()
    # Derivatives belong together: the mean velocity over a step is between those at its ends, but for jerk.
    mean = np.diff(positions, axis=0) / step
    between = np.maximum(velocities[:-1], velocities[1:]) + limits.jerk * step**2
    assert (mean <= between + 1e-6).all()
    assert (mean >= np.minimum(velocities[:-1], velocities[1:]) - limits.jerk * step**2 - 1e-6).all()

    # What a driver makes of the points.
    view = DriverView(plan)
    assert (view.positions >= limits.lower - 6e-6).all() and (view.positions <= limits.upper + 6e-6).all()
    assert (np.abs(view.velocities) <= limits.velocity).all()
    assert (np.abs(view.accelerations) <= limits.acceleration).all()
    assert (np.abs(view.jerks) <= limits.jerk * (1.0 + 1e-6)).all()
    away = limits.acceleration * PERIOD**2 / 6.0
    for position, motion, atol in zip(plan.positions.T, plan.motions, away.tolist(), strict=True):
        np.testing.assert_allclose(position, motion.at(plan.times)[0], rtol=0.0, atol=atol + 4e-5)

    assert (np.diff(plan.times) > 0.0).all() and np.diff(plan.times).max() <= PERIOD + 1e-9
    assert plan.times[0] == 0.0 and plan.times[-1] == pytest.approx(plan.duration)
    np.testing.assert_allclose(plan.positions[0], rest if start is None else start, atol=1e-12)
    np.testing.assert_array_equal(plan.positions[-1], rest)
    assert (plan.velocities[-1] == 0.0).all() and (plan.accelerations[-1] == 0.0).all()
    for found, expected in zip(plan.at(plan.duration), (rest, 0.0, 0.0), strict=True):
        np.testing.assert_allclose(found, expected, atol=1e-6)

    # Every token once, in order, and every knot of its sign passed in between.
    assert [timing.token for timing in plan.timings] == tokens
    end = 0.0
    for timing in plan.timings:
        assert timing.start >= end - 1e-9 and timing.duration > 0.0 and timing.stretch >= 1.0 - 1e-9
        end = timing.start + timing.duration
        if timing.token.kind == Kind.PAUSE:
            continue
        sign = table[timing.token.gloss].inflected(timing.token.inflection)
        # The form of a sentence moves the head away from where its signs have it.
        kept = [form == STATEMENT or joint not in humanoid.head for joint in sign.joints]
        columns = np.array(humanoid.columns(sign.joints))[kept]
        moments = np.linspace(timing.start, end, 2 + int(timing.duration / LOOK))
        passed = np.stack([plan.motions[column].at(moments)[0] for column in columns], axis=1)
        fastest = max(float(limits.velocity.max()), 1.0)
        ways = (sign.knots, *sign.alternatives)
        assert any(passes(passed, knots[:, kept], fastest) for knots in ways), sign.gloss
    assert end <= plan.duration


def passes(positions: np.ndarray, knots: np.ndarray, fastest: float) -> bool:
    """Whether positions come to each knot in turn, within what the fastest joint moves between two looks."""
    at = 0
    for knot in knots:
        near = np.abs(positions[at:] - knot).max(axis=1) <= LOOK / 2.0 * fastest
        if not near.any():
            return False
        at += int(np.argmax(near))
    return True


@pytest.mark.parametrize("robot", ROBOTS)
@settings(max_examples=30)
@given(
    seed=st.integers(0, 2**32 - 1), slow=st.booleans(), anywhere=st.booleans(), form=st.sampled_from(FORMS)
)
def test_no_limit_is_broken_by_random_signs_from_any_start_in_any_form(
    robot: str, seed: int, slow: bool, anywhere: bool, form: SentenceForm
) -> None:
    rng, humanoid = np.random.default_rng(seed), load_humanoid(robot)
    slowness = {"acceleration": 1.0, "jerk": 4.0} if slow else {}
    limits = MotionLimits.of_robot(humanoid, **slowness)
    table = random_table(rng, robot=robot)
    tokens = random_tokens(rng, table, most=4)
    position = rng.uniform(limits.lower, limits.upper) if anywhere else humanoid.ready
    planner = Planner(table, limits=limits, max_duration=1e5)
    plan = planner.plan(tokens, State.still(position), form=form)
    check(plan, tokens, table, limits, position, form)


@pytest.mark.slow
@pytest.mark.parametrize("name", ROBOTS)
def test_a_robot_keeps_clear_of_itself_or_says_that_it_cannot(name: str) -> None:
    """Looked at every 20 ms by exact distances, where the planner looks as seldom as its bound allows."""
    robot, rng = Robot.load(name), np.random.default_rng(4)
    outcomes = Counter[str]()
    for _ in range(15):
        table = random_table(rng, signs=2, robot=name)
        planner = Planner(table, robot=robot, max_duration=1e4)
        try:
            plan = planner.plan(random_tokens(rng, table, most=2))
        except PlanError as error:
            outcomes[error.code] += 1
            continue
        outcomes["planned"] += 1
        for row in plan.positions:
            pose = dict(zip(plan.names, row.tolist(), strict=True))
            assert robot.clearance(robot.configuration(pose)).distance > -1e-3
    assert set(outcomes) == {"planned", "self_collision"}


@pytest.mark.parametrize(("robot", "language"), [("teo", "ssp"), ("gr1t2", "ssp"), ("gr1t2", "ase")])
def test_no_limit_is_broken_by_the_tables_of_the_languages(robot: str, language: str) -> None:
    table = Lut.open(default_lut_directory(language, robot), language=language, robot=robot)
    assert len(table) > 100
    limits = MotionLimits.of_robot(load_humanoid(robot))
    rng = np.random.default_rng(2)
    planner = Planner(table, limits=limits, max_duration=1e4, least_standing="sketched")
    for _ in range(10):
        tokens, form = random_tokens(rng, table, most=8), FORMS[rng.integers(len(FORMS))]
        check(planner.plan(tokens, form=form), tokens, table, limits, form=form)


def test_no_limit_is_broken_by_the_inflected_forms_of_the_package(lut: Lut) -> None:
    limits = MotionLimits.of_robot()
    inflected = [(gloss, inflection) for gloss in lut for inflection in lut[gloss].forms]
    assert len(inflected) > 30
    planner = Planner(lut, max_duration=1e4)
    for first in range(0, len(inflected), 6):
        tokens = [
            Token(gloss=gloss, inflection=inflection, word_index=index)
            for index, (gloss, inflection) in enumerate(inflected[first : first + 6])
        ]
        check(planner.plan(tokens), tokens, lut, limits)


def test_fingers_of_a_slower_drive_are_waited_for(lut: Lut) -> None:
    tokens = [Token(gloss=letter, kind=Kind.LETTER) for letter in "AB"]
    finger = COMMANDED_JOINTS.index("RightIndexFinger")
    # A finger without load at 968:1 with the slowest motors: 13 rpm, 4.5 mm, 78 deg for 20 mm.
    most = math.radians(13.0 / 60.0 * math.tau * 4.5 * 78.0 / 20.0)
    usual = Planner(lut).plan(tokens)
    slow = Planner(lut, limits=MotionLimits.of_robot(hand_drive="spool_1000")).plan(tokens)
    assert np.abs(usual.velocities[:, finger]).max() > most
    assert np.abs(slow.velocities[:, finger]).max() <= most
    assert slow.duration > usual.duration + 1.0
