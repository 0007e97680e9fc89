# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the head does in sentences of the package's table and of random ones."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from teo_description.humanoid import load_humanoid
from teo_description.robot import Robot
from teo_motion.planner import Planner
from teo_motion.sentence.plan import Plan, TokenTiming
from teo_motion.sentence.sentence_form import STATEMENT, GestureKind, SentenceForm, SentenceType
from teo_motion.sentence.signing_style import SigningStyle
from teo_motion.trajectory.limits import MotionLimits
from teo_motion.trajectory.stopping import stop
from teo_signs.look_up_table import Lut
from teo_signs.sign import Sign
from teo_signs.tokens import Kind, Token, parse_printed

LeastDistance = Callable[[np.ndarray], float]
REST = load_humanoid().ready

LIMITS = MotionLimits.of_robot()
YAW, PITCH = (LIMITS.names.index(name) for name in ("AxialNeck", "FrontalNeck"))
HEAD = [YAW, PITCH]
HANDS = [column for column in range(28) if column not in HEAD]
KINDS = {"lexical": Kind.LEXICAL, "letter": Kind.LETTER, "number": Kind.NUMBER}
FORMS = [SentenceForm(type=kind, negated=negated) for kind in SentenceType for negated in (False, True)]
YES_NO = SentenceForm(type=SentenceType.YES_NO_QUESTION)
WH = SentenceForm(type=SentenceType.WH_QUESTION)
EXCLAMATION = SentenceForm(type=SentenceType.EXCLAMATION)
NEGATED = SentenceForm(negated=True)


def during(plan: Plan, timing: TokenTiming) -> np.ndarray:
    """Yaw and pitch [deg] at fifty instants of a token. Shape (50, 2)."""
    times = np.linspace(timing.start, timing.start + timing.duration, 50)
    return np.degrees(np.stack([plan.motions[column].at(times)[0] for column in HEAD], axis=1))


def sides(angles: np.ndarray) -> int:
    """How often an angle changes its sign, however little it is beyond 3 deg."""
    signs = np.sign(angles[np.abs(angles) > 3.0])
    return int((np.diff(signs) != 0.0).sum())


def random_sentence(rng: np.random.Generator, table: Mapping[str, Sign]) -> list[Token]:
    glosses = rng.choice(sorted(table), rng.integers(1, 5)).tolist()
    return [
        Token(gloss=gloss, kind=KINDS[table[gloss].kind], word_index=index)
        for index, gloss in enumerate(glosses)
    ]


@settings(max_examples=20)
@given(seed=st.integers(0, 2**32 - 1), form=st.sampled_from(FORMS), strength=st.sampled_from([0.3, 1.0]))
def test_the_head_alone_shows_a_form_and_in_a_statement_nothing_does(
    lut: Lut, seed: int, form: SentenceForm, strength: float
) -> None:
    tokens = random_sentence(np.random.default_rng(seed), lut)
    plan, without = (
        Planner(lut, style=SigningStyle(head_motion=motion), least_standing="sketched").plan(
            tokens, form=form
        )
        for motion in (strength, 0.0)
    )
    assert form != STATEMENT or plan.head == ()
    same = slice(None) if form == STATEMENT else HANDS
    np.testing.assert_array_equal(plan.times, without.times)
    assert (plan.timings, plan.stretch) == (without.timings, without.stretch)
    for now, before in zip(plan.samples[1:], without.samples[1:], strict=True):
        np.testing.assert_array_equal(now[:, same], before[:, same])


@pytest.mark.parametrize("verb", ["VENIR", "COMPRAR", "COMER"])
def test_the_head_shakes_over_verb_and_negation(lut: Lut, verb: str) -> None:
    plan = Planner(lut).plan(parse_printed(f"YO {verb} NO"), form=NEGATED)
    subject, *_, negation = plan.timings
    assert sides(during(plan, negation)[:, 0]) >= 2
    assert np.abs(during(plan, subject)[:, 0]).max() < 12.5
    verb_start = next(timing.start for timing in plan.timings if timing.token.word_index == 1)
    times = np.arange(verb_start, negation.start + negation.duration, 0.01)
    yaw = np.degrees(plan.motions[YAW].at(times)[0])
    turned = times[np.abs(yaw) > 9.0]
    assert np.diff(turned).max() < 1.0, "it does not stop on the way"
    assert turned[0] - verb_start < 0.5
    assert yaw.max() > 11.9 and yaw.min() < -11.9
    assert sides(yaw) >= (times[-1] - times[0]) / 0.7 - 2.0, "a swing takes 0.7 s"


def test_a_spelled_negation_is_shaken_at_all_along(lut: Lut) -> None:
    plan = Planner(lut).plan(parse_printed("YO VENIR TAMPOCO"), form=NEGATED)
    letters = [timing for timing in plan.timings if timing.token.kind == Kind.LETTER]
    times = np.arange(letters[0].start, letters[-1].start + letters[-1].duration, 0.01)
    assert sides(np.degrees(plan.motions[YAW].at(times)[0])) >= (times[-1] - times[0]) / 0.7 - 2.0


def test_a_single_negation_shakes_as_its_entry_has_it(lut: Lut) -> None:
    planner = Planner(lut)
    plan = planner.plan(parse_printed("NO"), form=NEGATED)
    assert sides(during(plan, plan.timings[0])[:, 0]) == 2
    np.testing.assert_array_equal(plan.positions, planner.plan(parse_printed("NO")).positions)


def test_the_head_is_forward_until_a_yes_no_question_has_ended(lut: Lut) -> None:
    plan = Planner(lut).plan(parse_printed("TÚ COLEGIO IR"), form=YES_NO)
    first, last = plan.timings[0], plan.timings[-1]
    times = np.linspace(first.start, last.start + last.duration, 200)
    np.testing.assert_allclose(np.degrees(plan.motions[PITCH].at(times)[0]), 9.0, atol=1e-6)
    (gesture,) = plan.head
    assert gesture.kind == GestureKind.FORWARD
    assert gesture.start <= first.start + 1e-9 and gesture.end >= last.start + last.duration - 1e-9


def test_the_last_sign_of_a_yes_no_question_is_held(lut: Lut) -> None:
    planner, tokens = Planner(lut), parse_printed("TÚ MANO")
    statement, question = (planner.plan(tokens, form=form).timings[-1] for form in (STATEMENT, YES_NO))
    assert question.duration == pytest.approx(statement.duration + 0.25)


def test_signs_that_bow_or_raise_the_head_do_so_from_a_head_that_is_forward(lut: Lut) -> None:
    tokens = parse_printed("HOY TÚ ENFERMO")
    planner = Planner(lut)
    plan, without = (planner.plan(tokens, form=form) for form in (YES_NO, STATEMENT))
    for index, expected in ((0, (1.0, 9.0)), (2, (3.0, 3.0))):
        pitch = during(plan, plan.timings[index])[:, 1]
        assert (pitch.min(), pitch.max()) == pytest.approx(expected, abs=0.01)
        # As far up and down as in a statement.
        assert np.ptp(pitch) == pytest.approx(np.ptp(during(without, without.timings[index])[:, 1]), abs=1e-6)


def test_the_head_is_back_at_the_question_word_alone(lut: Lut) -> None:
    plan = Planner(lut).plan(parse_printed("TÚ NOMBRE QUÉ"), form=WH)
    np.testing.assert_allclose(during(plan, plan.timings[2])[:, 1], -8.0, atol=0.01)
    assert (during(plan, plan.timings[0])[:, 1] == 0.0).all()


def test_an_exclamation_ends_with_a_nod(lut: Lut) -> None:
    plan = Planner(lut).plan(parse_printed("TÚ VENTANA ROMPER"), form=EXCLAMATION)
    pitch = during(plan, plan.timings[-1])[:, 1]
    assert pitch.max() == pytest.approx(9.0, abs=0.1)
    whole = np.degrees(plan.positions[:, PITCH])
    assert whole.min() == pytest.approx(-5.0, abs=0.1), "up before it goes down"
    assert (during(plan, plan.timings[0])[:, 1] == 0.0).all()


@pytest.mark.parametrize("form", FORMS, ids=str)
def test_a_gesture_begins_from_rest_however_little_time_there_is(lut: Lut, form: SentenceForm) -> None:
    """What a driver is sent begins where the robot stands, and no faster than its limits let it."""
    plan = Planner(lut).plan([Token(gloss="CORAZÓN")], form=form)
    assert (plan.velocities[0] == 0.0).all()
    assert (plan.accelerations[0] == 0.0).all()


def test_half_the_strength_is_half_the_way(lut: Lut) -> None:
    planner = Planner(lut, style=SigningStyle(head_motion=0.5))
    plan = planner.plan(parse_printed("YO CASA"), form=NEGATED)
    assert np.degrees(np.abs(plan.positions[:, YAW]).max()) == pytest.approx(6.0, abs=0.05)


def test_a_head_that_would_touch_a_hand_stays_as_the_sign_has_it(
    lut: Lut, robot: Robot, least_distance: LeastDistance
) -> None:
    # The hand of PENSAR is so near to the forehead that a head bowed by 9 deg would touch it.
    planner, tokens = Planner(lut, robot=robot), parse_printed("PENSAR CASA")
    plan, without = (planner.plan(tokens, form=form) for form in (YES_NO, STATEMENT))
    assert plan.nearest is not None and plan.nearest.distance >= 0.0
    # Seen by somebody else: every point, not only those that the planner looks at.
    first, casa = plan.timings
    assert least_distance(plan.positions[plan.times <= casa.start][::2]) >= 0.0
    np.testing.assert_allclose(during(plan, first), during(without, without.timings[0]), atol=1e-6)
    assert during(plan, casa)[:, 1].max() == pytest.approx(9.0)


@pytest.mark.parametrize("text", ["MADRE ENTENDER NO", "TÚ DELGADO"])
def test_signs_at_the_face_stay_clear_of_the_head(
    lut: Lut, robot: Robot, least_distance: LeastDistance, text: str
) -> None:
    for form in (YES_NO, NEGATED):
        plan = Planner(lut, robot=robot).plan(parse_printed(text), form=form)
        assert plan.nearest is not None and plan.nearest.distance >= 0.0
        found = least_distance(plan.at(plan.nearest.time).position[None])
        assert found == pytest.approx(plan.nearest.distance, abs=1e-3)  # points leave the motion by 0.5 mrad


@pytest.mark.parametrize("share", [0.3, 0.5, 0.7])
def test_a_robot_that_is_stopped_in_a_gesture_finds_its_way_to_rest(lut: Lut, share: float) -> None:
    planner = Planner(lut)
    form = SentenceForm(type=SentenceType.YES_NO_QUESTION, negated=True)
    plan = planner.plan(parse_printed("HOY VENIR NO"), form=form)
    moving = plan.at(share * plan.duration)
    assert np.abs(moving.position[HEAD]).max() > 0.01
    end, _ = stop(moving, LIMITS)
    back = planner.plan_to_rest(end)
    assert back.head == ()
    np.testing.assert_allclose(back.at(back.duration).position, REST, atol=1e-6)
