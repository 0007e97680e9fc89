# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""No plan breaks a limit, whatever the signs: looked at in the motion itself and through a driver's eyes."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Mapping

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from teo_description.humanoid import load_humanoid
from teo_description.robot import Robot
from teo_motion.planner import Planner
from teo_motion.sentence.plan import Plan
from teo_motion.trajectory.limits import MotionLimits
from teo_motion.trajectory.ruckig_segment import State
from teo_names import COMMANDED_JOINTS
from teo_signs.errors import PlanError
from teo_signs.look_up_table import Lut, default_lut_directory
from teo_signs.sign import Sign
from teo_signs.tokens import Kind, Token

REST = load_humanoid().ready
ROBOTS = ("teo", "gr1t2")

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
    plan: Plan, tokens: list[Token], table: Mapping[str, Sign], start: np.ndarray, driver_view: type
) -> None:
    """Everything that is promised of every plan."""
    humanoid = load_humanoid(next(iter(table.values())).robot)
    limits, rest = MotionLimits.of_robot(humanoid), humanoid.ready

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
    view = driver_view(plan)
    assert (view.positions >= limits.lower - 6e-6).all() and (view.positions <= limits.upper + 6e-6).all()
    assert (np.abs(view.velocities) <= limits.velocity).all()
    assert (np.abs(view.accelerations) <= limits.acceleration).all()
    assert (np.abs(view.jerks) <= limits.jerk * (1.0 + 1e-6)).all()
    away = limits.acceleration * PERIOD**2 / 6.0
    for position, motion, atol in zip(plan.positions.T, plan.motions, away.tolist(), strict=True):
        np.testing.assert_allclose(position, motion.at(plan.times)[0], rtol=0.0, atol=atol + 4e-5)

    assert (np.diff(plan.times) > 0.0).all() and np.diff(plan.times).max() <= PERIOD + 1e-9
    assert plan.times[0] == 0.0 and plan.times[-1] == pytest.approx(plan.duration)
    np.testing.assert_allclose(plan.positions[0], start, atol=1e-12)
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
        columns = humanoid.columns(sign.joints)
        moments = np.linspace(timing.start, end, 2 + int(timing.duration / LOOK))
        passed = np.stack([plan.motions[column].at(moments)[0] for column in columns], axis=1)
        fastest = max(float(limits.velocity[columns].max()), 1.0)
        assert any(passes(passed, knots, fastest) for knots in (sign.knots, *sign.alternatives)), sign.gloss
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
@settings(max_examples=30, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(seed=st.integers(0, 2**32 - 1))
def test_no_limit_is_broken_by_random_signs(
    random_table: Callable[..., dict[str, Sign]], driver_view: type, robot: str, seed: int
) -> None:
    rng = np.random.default_rng(seed)
    table, limits = random_table(rng, robot=robot), MotionLimits.of_robot(load_humanoid(robot))
    tokens = random_tokens(rng, table, most=5)
    plan = Planner(table, limits=limits, max_duration=1e4).plan(tokens)
    check(plan, tokens, table, limits.humanoid.ready, driver_view)


@pytest.mark.parametrize("robot", ROBOTS)
@pytest.mark.parametrize("seed", range(4))
def test_no_limit_is_broken_from_any_start(
    random_table: Callable[..., dict[str, Sign]], driver_view: type, robot: str, seed: int
) -> None:
    rng = np.random.default_rng(seed)
    table = random_table(rng, robot=robot)
    limits = MotionLimits.of_robot(load_humanoid(robot))
    tokens = random_tokens(rng, table, most=3)
    start = rng.uniform(limits.lower, limits.upper)
    still = np.zeros_like(start)
    state = State(position=start, velocity=still, acceleration=still)
    plan = Planner(table, limits=limits, max_duration=1e4).plan(tokens, state)
    check(plan, tokens, table, start, driver_view)


@pytest.mark.slow
@pytest.mark.parametrize("name", ROBOTS)
def test_a_robot_keeps_clear_of_itself_or_says_that_it_cannot(
    random_table: Callable[..., dict[str, Sign]], name: str
) -> None:
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


@pytest.mark.slow
def test_no_limit_is_broken_by_thousands_of_tokens(table: Mapping[str, Sign]) -> None:
    rng = np.random.default_rng(1)
    names = sorted(table)
    tokens = [
        Token(gloss=gloss, kind=KINDS[table[gloss].kind], word_index=index)
        for index, gloss in enumerate(rng.choice(names, 1000).tolist())
    ]
    plan = Planner(table, max_duration=1e5).plan(tokens)
    limits = MotionLimits.of_robot()
    for joint, motion in enumerate(plan.motions):
        reached = motion.extremes()
        assert reached.least >= limits.lower[joint] - 1e-8 and reached.greatest <= limits.upper[joint] + 1e-8
        assert reached.velocity <= limits.velocity[joint]
        assert reached.acceleration <= limits.acceleration[joint]
        assert reached.jerk <= limits.jerk[joint] * (1.0 + 1e-9)
    assert [timing.token for timing in plan.timings] == tokens


@pytest.mark.parametrize(("robot", "language"), [("teo", "ssp"), ("gr1t2", "ssp"), ("gr1t2", "ase")])
def test_no_limit_is_broken_by_the_tables_of_the_languages(
    driver_view: type, robot: str, language: str
) -> None:
    table = Lut.open(default_lut_directory(language, robot), language=language, robot=robot)
    assert len(table) > 100
    limits = MotionLimits.of_robot(load_humanoid(robot))
    rng = np.random.default_rng(2)
    planner = Planner(table, limits=limits, max_duration=1e4, least_standing="sketched")
    for _ in range(10):
        tokens = random_tokens(rng, table, most=8)
        check(planner.plan(tokens), tokens, table, limits.humanoid.ready, driver_view)


def test_no_limit_is_broken_by_the_inflected_forms_of_the_package(driver_view: type) -> None:
    table = Lut.open()
    inflected = [(gloss, inflection) for gloss in table for inflection in table[gloss].forms]
    assert len(inflected) > 30
    planner = Planner(table, max_duration=1e4)
    for first in range(0, len(inflected), 6):
        tokens = [
            Token(gloss=gloss, inflection=inflection, word_index=index)
            for index, (gloss, inflection) in enumerate(inflected[first : first + 6])
        ]
        check(planner.plan(tokens), tokens, table, REST, driver_view)


def test_lower_limits_are_kept_too(random_table: Callable[..., dict[str, Sign]], driver_view: type) -> None:
    rng = np.random.default_rng(3)
    table = random_table(rng)
    limits = MotionLimits.of_robot(acceleration=1.0, jerk=4.0)
    plan = Planner(table, limits=limits, max_duration=1e5).plan(random_tokens(rng, table, most=4))
    view = driver_view(plan)
    assert (np.abs(view.accelerations) <= 1.0).all() and (np.abs(view.velocities) <= limits.velocity).all()
    assert max(motion.extremes().jerk for motion in plan.motions) <= 4.0 * (1.0 + 1e-9)
    assert (np.abs(view.jerks) <= 4.0 * (1.0 + 1e-6)).all()


def test_fingers_of_a_slower_drive_are_waited_for() -> None:
    table = dict(Lut.open(default_lut_directory()).items())
    tokens = [Token(gloss=letter, kind=Kind.LETTER) for letter in "AB"]
    finger = COMMANDED_JOINTS.index("RightIndexFinger")
    # A finger without load at 968:1 with the slowest motors: 13 rpm, 4.5 mm, 78 deg for 20 mm.
    most = math.radians(13.0 / 60.0 * math.tau * 4.5 * 78.0 / 20.0)
    usual = Planner(table).plan(tokens)
    slow = Planner(table, limits=MotionLimits.of_robot(hand_drive="spool_1000")).plan(tokens)
    assert np.abs(usual.velocities[:, finger]).max() > most
    assert np.abs(slow.velocities[:, finger]).max() <= most
    assert slow.duration > usual.duration + 1.0
