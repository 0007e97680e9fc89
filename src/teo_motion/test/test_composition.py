# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
import pytest

from teo_motion.sentence.composition import Composition, compose
from teo_motion.sentence.signing_style import SigningStyle
from teo_motion.trajectory.limits import MotionLimits
from teo_motion.trajectory.ruckig_segment import State
from teo_names import COMMANDED_JOINTS, LEFT_ARM, RIGHT_HAND
from teo_signs.errors import PlanError
from teo_signs.lexicon import Lexicon
from teo_signs.sign import Sign
from teo_signs.tokens import Token, parse_printed

STYLE = SigningStyle()
LIMITS = MotionLimits.of_robot()
HANGING, REST = LIMITS.humanoid.hanging, LIMITS.humanoid.ready
START = State.still(REST)
ELBOW = COMMANDED_JOINTS.index("FrontalRightElbow")
RIGHT_ARM_COLUMNS = [COMMANDED_JOINTS.index(name) for name in COMMANDED_JOINTS if "Right" in name]
LEFT_COLUMNS = [COMMANDED_JOINTS.index(name) for name in COMMANDED_JOINTS if "Left" in name]


def composed(table: Mapping[str, Sign], text: str | list[Token], style: SigningStyle = STYLE) -> Composition:
    tokens = parse_printed(text) if isinstance(text, str) else text
    return compose(Lexicon(table).resolve(tokens), start=START, limits=LIMITS, style=style, rest=REST)


def held(composition: Composition, index: int) -> float:
    """Nominal time of the last step of a token: its hold."""
    return float(composition.nominal[composition.spans[index].last - 1])


def test_letters_are_held_and_the_last_of_a_word_longer(table: Mapping[str, Sign]) -> None:
    composition = composed(table, "A-N C-A 1-7")
    holds = [held(composition, index) for index in range(6)]
    single, last = STYLE.letter_hold, STYLE.letter_hold * STYLE.last_letter_hold
    assert holds == pytest.approx([single, last, single, last, single, last])


@pytest.mark.parametrize("recorded", [0.0, 0.2, 1.2])
def test_a_letter_is_held_alike_however_long_its_recording_holds_it(
    table: Mapping[str, Sign], make_sign: Callable[..., Sign], recorded: float
) -> None:
    knots = table["A"].knots[[0, 0, 0]][: 3 if recorded else 2]
    knots[0, 4] += 0.2
    own = {"B": make_sign("B", knots, [0.0, 0.3, 0.3 + recorded][: len(knots)], kind="letter")} | {
        gloss: sign for gloss, sign in table.items() if gloss != "B"
    }
    assert composed(own, "B-A").spans[0].asked == pytest.approx(0.3 + STYLE.letter_hold)
    last = 0.3 + STYLE.letter_hold * STYLE.last_letter_hold
    assert composed(own, "A-B").spans[1].asked == pytest.approx(last)


def test_the_hands_stay_a_little_after_a_spelled_word(table: Mapping[str, Sign]) -> None:
    composition = composed(table, "A-N TÚ")
    word, sign = composition.spans[1], composition.spans[2]
    assert sign.first == word.last + 2, "one step to stay, one to go"
    assert composition.nominal[word.last] == STYLE.word_pause


def test_a_single_posture_is_held_and_the_last_sign_of_all(
    table: Mapping[str, Sign], make_sign: Callable[..., Sign]
) -> None:
    signs = {"YO": make_sign("YO", table["A"].knots)} | dict(table)
    composition = composed(signs, "YO TÚ")
    assert composition.spans[0].asked == pytest.approx(STYLE.posture_hold)
    assert held(composition, 1) == pytest.approx(STYLE.final_hold)
    assert held(composed(table, "TÚ CASA"), 0) == pytest.approx(0.25), "no other sign is held"


def test_a_pause_keeps_the_hands_where_they_are(table: Mapping[str, Sign]) -> None:
    composition = composed(table, "TÚ _ CASA")
    sign, pause, _ = composition.spans
    assert (pause.first, pause.last) == (sign.last, sign.last + 1)
    assert pause.asked == pytest.approx(STYLE.pause)
    columns = RIGHT_ARM_COLUMNS
    np.testing.assert_array_equal(
        composition.targets[pause.last, columns], composition.targets[sign.last, columns]
    )


def test_joints_of_a_limb_that_a_sign_leaves_out_are_as_in_the_hanging_posture(
    make_sign: Callable[..., Sign],
) -> None:
    one = {"X": make_sign("X", [[-1.0]], joints=("FrontalLeftElbow",))}
    row = composed(one, "X").targets[1]
    columns = [COMMANDED_JOINTS.index(name) for name in LEFT_ARM]
    expected = HANGING[columns].copy()
    expected[3] = -1.0
    np.testing.assert_array_equal(row[columns], expected)


def test_an_arm_stays_for_a_sign_of_its_hand_alone(
    table: Mapping[str, Sign], make_sign: Callable[..., Sign]
) -> None:
    shape = make_sign("X", [np.radians([0, 60, 60, 60, 60, 60])], joints=RIGHT_HAND)
    composition = composed({"X": shape} | dict(table), "TÚ X")
    before, after = (
        composition.targets[composition.spans[0].last],
        composition.targets[composition.spans[1].first],
    )
    np.testing.assert_array_equal(before[RIGHT_ARM_COLUMNS[:6]], after[RIGHT_ARM_COLUMNS[:6]])


def test_a_knot_outside_the_limits_is_refused_by_name(make_sign: Callable[..., Sign]) -> None:
    bad = {"X": make_sign("X", [[-3.0]], joints=("FrontalRightElbow",))}
    with pytest.raises(PlanError, match="FrontalRightElbow") as refusal:
        composed(bad, "X")
    assert refusal.value.code == "sign_outside_limits"


@pytest.mark.parametrize(
    ("dial", "value"),
    [
        ("letter_hold", -0.1),
        ("pause", np.nan),
        ("arm_rest", np.inf),
        ("least_size", 1.5),
        ("head_motion", 1.1),
    ],
)
def test_a_style_of_impossible_dials_is_refused(dial: str, value: float) -> None:
    with pytest.raises(PlanError, match=f"{dial}: expected") as refusal:
        SigningStyle(**{dial: value})
    assert refusal.value.code == "bad_style"
