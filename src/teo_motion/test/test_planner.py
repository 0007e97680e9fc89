# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np
import pytest

from teo_description.robot import Robot
from teo_motion.planner import DEFAULT_PERIOD, Planner
from teo_motion.sentence.signing_style import RestPosture, SigningStyle
from teo_motion.trajectory.limits import MotionLimits
from teo_motion.trajectory.ruckig_segment import State
from teo_names import COMMANDED_JOINTS, RIGHT_ARM
from teo_signs.errors import PlanError
from teo_signs.sign import Sign
from teo_signs.tokens import Kind, Token, parse_printed

LeastDistance = Callable[[np.ndarray], float]
LIMITS = MotionLimits.of_robot()
REST, STILL = LIMITS.humanoid.ready, np.zeros(28)


def state(position: np.ndarray = REST, velocity: np.ndarray = STILL) -> State:
    return State(position, velocity, STILL)


def refused(planner: Planner, tokens: list[Token], start: State | None = None) -> str:
    with pytest.raises(PlanError) as refusal:
        planner.plan(tokens, start)
    assert str(refusal.value)
    return refusal.value.code


def test_an_easy_sign_is_not_stretched_and_a_fast_one_says_by_how_much(
    make_sign: Callable[..., Sign],
) -> None:
    elbow = ("FrontalRightElbow",)
    easy = make_sign("EASY", [[-1.0], [-1.1]], [0.0, 0.5], joints=elbow)
    fast = make_sign("FAST", [[-1.0], [0.0], [-1.0]], [0.0, 0.2, 0.4], joints=elbow)
    signs = {"EASY": easy, "FAST": fast}
    planner = Planner(signs, style=SigningStyle(final_hold=0.0), rest_posture=RestPosture.HANGING)
    assert planner.plan([Token(gloss="EASY")]).stretch == pytest.approx(1.0)
    result = planner.plan([Token(gloss="EASY"), Token(gloss="FAST")])
    # 1 rad at 50 deg/s is 1.15 s, and some to speed up and slow down: twice that instead of 0.4 s.
    assert 2.3 / 0.4 < result.timings[1].stretch < 3.0 / 0.4
    durations = sum(timing.duration for timing in result.timings)
    assert result.stretch == pytest.approx(durations / 0.9)


def test_a_duration_scale_slows_a_sign(table: Mapping[str, Sign]) -> None:
    planner = Planner(table)
    once, twice = (planner.plan([Token(gloss="TÚ", duration_scale=scale)]).timings[0] for scale in (4.0, 8.0))
    assert once.stretch == pytest.approx(1.0)
    assert twice.duration == pytest.approx(2.0 * once.duration)


def test_a_hand_does_not_stop_between_signs_that_go_on(make_sign: Callable[..., Sign]) -> None:
    elbow = ("FrontalRightElbow",)
    signs = {
        "ONE": make_sign("ONE", [[-0.3], [-0.5]], [0.0, 0.5], joints=elbow),
        "TWO": make_sign("TWO", [[-0.8], [-1.0]], [0.0, 0.5], joints=elbow),
    }
    planner = Planner(signs, style=SigningStyle(final_hold=0.0), rest_posture=RestPosture.HANGING)
    result = planner.plan([Token(gloss="ONE"), Token(gloss="TWO")])
    column = COMMANDED_JOINTS.index("FrontalRightElbow")
    first, second = result.timings
    between = (result.times >= first.start) & (result.times <= second.start + second.duration - 0.2)
    assert (result.velocities[between, column] < -0.05).all()


def test_doubled_letters_are_visibly_parted(table: Mapping[str, Sign], robot: Robot) -> None:
    result = Planner(table).plan(parse_printed("A-A"))
    first, second = result.timings
    inside = (result.times >= first.start) & (result.times <= second.start)
    palms = [
        robot.placement(robot.configuration(dict(zip(COMMANDED_JOINTS, row, strict=True))), "right_palm")[
            :3, 3
        ]
        for row in result.positions[inside]
    ]
    moved = max(float(np.linalg.norm(palm - palms[0])) for palm in palms)
    assert moved > 0.04, "half a hand length"
    np.testing.assert_allclose(palms[0], palms[-1], atol=5e-4)


def test_a_pause_at_the_beginning_and_alone_is_time_at_rest(table: Mapping[str, Sign]) -> None:
    planner = Planner(table)
    alone = planner.plan([Token(gloss="", kind=Kind.PAUSE)])
    np.testing.assert_array_equal(alone.positions, np.tile(REST, (len(alone.times), 1)))
    assert alone.duration >= planner.style.pause
    first = planner.plan([Token(gloss="", kind=Kind.PAUSE), Token(gloss="TÚ")])
    assert first.timings[0].start <= DEFAULT_PERIOD and first.timings[1].start > planner.style.pause


def test_a_sentence_can_begin_in_motion(table: Mapping[str, Sign]) -> None:
    position = REST.copy()
    elbow = COMMANDED_JOINTS.index("FrontalRightElbow")
    position[elbow] = -0.5
    velocity = np.zeros(28)
    velocity[elbow] = 0.6
    result = Planner(table).plan(parse_printed("A"), state(position, velocity))
    assert result.velocities[0, elbow] == pytest.approx(0.6, abs=0.007)
    assert (np.abs(result.velocities) <= LIMITS.velocity).all()


def test_a_start_too_fast_to_stay_within_the_limits_is_refused(table: Mapping[str, Sign]) -> None:
    elbow = COMMANDED_JOINTS.index("FrontalRightElbow")
    position, velocity = REST.copy(), np.zeros(28)
    position[elbow], velocity[elbow] = LIMITS.upper[elbow] - 0.01, 0.8
    assert refused(Planner(table), [Token(gloss="A")], state(position, velocity)) == "outside_limits"


def test_a_start_a_little_outside_the_limits_is_on_the_limit_and_more_is_refused(
    table: Mapping[str, Sign],
) -> None:
    planner = Planner(table)
    position = REST.copy()
    finger = COMMANDED_JOINTS.index("LeftIndexFinger")
    position[finger] = LIMITS.lower[finger] - 0.005
    assert planner.plan([Token(gloss="A")], state(position)).positions[0, finger] == LIMITS.lower[finger]
    position[finger] = LIMITS.lower[finger] - 0.02
    assert refused(planner, [Token(gloss="A")], state(position)) == "start_outside_limits"


@pytest.mark.parametrize("bad", [np.full(28, np.nan), np.full(28, np.inf), np.zeros(27), np.zeros((28, 1))])
def test_a_start_that_is_none_is_refused(table: Mapping[str, Sign], bad: np.ndarray) -> None:
    assert refused(Planner(table), [Token(gloss="A")], state(bad)) == "bad_start"
    assert refused(Planner(table), [Token(gloss="A")], state(velocity=bad)) == "bad_start"


def test_a_sentence_that_would_never_end_is_refused(table: Mapping[str, Sign]) -> None:
    assert refused(Planner(table, max_duration=20.0), list(parse_printed("A-N-" * 20 + "A"))) == "too_long"


@pytest.mark.parametrize("settings", [{"period": 0.0}, {"period": math.nan}, {"max_duration": -1.0}])
def test_impossible_settings_are_refused(table: Mapping[str, Sign], settings: dict[str, float]) -> None:
    with pytest.raises(PlanError, match="above 0"):
        Planner(table, **settings)


@pytest.mark.parametrize("limit", [0.0, -1.0, math.nan, math.inf])
def test_impossible_limits_are_refused(limit: float) -> None:
    for name in ("acceleration", "jerk"):
        with pytest.raises(PlanError) as refusal:
            MotionLimits.of_robot(**{name: limit})
        assert refusal.value.code == "bad_limits"


def test_a_sign_that_touches_the_robot_is_refused_by_name(
    make_sign: Callable[..., Sign], robot: Robot
) -> None:
    into_body = make_sign("X", [np.radians([20, 20, 50, -90, 0, 0])], joints=RIGHT_ARM)
    with pytest.raises(PlanError, match=r"^in the sign 'X'") as refusal:
        Planner({"X": into_body}, robot=robot).plan([Token(gloss="X")])
    assert refusal.value.code == "self_collision"


def test_the_nearness_that_is_reported_is_the_least_along_the_way(
    table: Mapping[str, Sign], robot: Robot, least_distance: LeastDistance
) -> None:
    result = Planner(table, robot=robot).plan(parse_printed("CASA A-N CASA"))
    assert result.nearest is not None
    assert result.nearest.distance == pytest.approx(least_distance(result.positions[::2]), abs=0.005)
