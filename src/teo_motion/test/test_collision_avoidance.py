# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Sentences in which TEO's arms are in each other's way."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from teo_description.humanoid import load_humanoid
from teo_description.robot import Robot
from teo_motion.collision.motion_clearance import RESOLUTION, MotionClearance
from teo_motion.planner import Planner
from teo_motion.trajectory.driver_points import Samples
from teo_motion.trajectory.ruckig_segment import State
from teo_names import COMMANDED_JOINTS, LEFT_ARM, LEFT_HAND, RIGHT_ARM, RIGHT_HAND, joint_limits
from teo_signs.errors import PlanError
from teo_signs.look_up_table import Lut
from teo_signs.sign import Sign
from teo_signs.tokens import Token, parse_printed

BOTH = RIGHT_ARM + RIGHT_HAND + LEFT_ARM + LEFT_HAND
HANGING, REST = load_humanoid().hanging, load_humanoid().ready
OPEN = np.radians([0.0, -25.0, 7.0, 7.0, 7.0, 7.0])

MakeSign = Callable[..., Sign]
LeastDistance = Callable[[np.ndarray], float]


def arms(lut: Lut, gloss: str, knot: int) -> tuple[np.ndarray, np.ndarray]:
    """Right and left arm of a sign at a knot."""
    pose = lut[gloss].pose(knot)
    right, left = (np.array([pose[joint] for joint in arm]) for arm in (RIGHT_ARM, LEFT_ARM))
    return right, left


def mirrored_arm(arm: np.ndarray) -> np.ndarray:
    """The other arm in the mirror image of this one; both have the same axes in the same order."""
    return arm * load_humanoid().mirror_signs(RIGHT_ARM)


def without_looking(signs: dict[str, Sign], glosses: str, robot: Robot) -> float:
    """How near parts come if nobody looks [m]."""
    plan = Planner(signs).plan(parse_printed(glosses))
    return MotionClearance(robot).nearest(plan.samples).distance


def test_an_idle_left_hand_in_the_way_hangs_first(make_sign: MakeSign, lut: Lut, robot: Robot) -> None:
    right, left = arms(lut, "AMIGO", 0)
    signs = {
        "TWO": make_sign("TWO", [[*right, *OPEN, *left, *OPEN]], joints=BOTH),
        # Where the left hand waits in the meantime, seen in a mirror: across the body, on the other's arm.
        "ONE": make_sign("ONE", [[*mirrored_arm(left), *OPEN]]),
    }
    sentence = "TWO ONE TWO"
    assert without_looking(signs, sentence, robot) < -0.005
    plan = Planner(signs, robot=robot).plan(parse_printed(sentence))
    assert MotionClearance(robot).nearest(plan.samples).distance >= 0.0
    one = plan.timings[1]
    position, _, _ = plan.at(one.start + one.duration / 2.0)
    shown = dict(zip(plan.names, position - HANGING, strict=True))
    assert max(abs(shown[joint]) for joint in LEFT_ARM) < 0.05


def test_two_hands_pass_each_other(make_sign: MakeSign, lut: Lut, robot: Robot) -> None:
    right, left = arms(lut, "TRABAJAR", 0)
    signs = {
        "OVER": make_sign("OVER", [[*right, *OPEN, *left, *OPEN]], joints=BOTH),
        "UNDER": make_sign(
            "UNDER",
            [[*mirrored_arm(left), *OPEN, *mirrored_arm(right), *OPEN]],
            joints=BOTH,
        ),
    }
    sentence = "OVER UNDER OVER"
    assert without_looking(signs, sentence, robot) < -0.005
    plan = Planner(signs, robot=robot).plan(parse_printed(sentence))
    assert MotionClearance(robot).nearest(plan.samples).distance >= 0.0
    for timing in plan.timings:
        sign = signs[timing.token.gloss]
        shown = dict(zip(plan.names, plan.at(timing.start)[0], strict=True))
        for joint, position in sign.pose(0).items():
            assert shown[joint] == pytest.approx(position, abs=1e-3)


@pytest.mark.slow
def test_nearly_every_random_sentence_of_the_table_has_a_way(lut: Lut, robot: Robot) -> None:
    words = [gloss for gloss in lut.glosses() if lut[gloss].kind == "lexical"]
    planner = Planner(lut, robot=robot, least_standing="sketched")
    looking = MotionClearance(robot)
    random = np.random.default_rng(5)
    refused: list[str] = []
    for _ in range(60):
        glosses = [str(gloss) for gloss in random.choice(words, 2)]
        try:
            plan = planner.plan([Token(gloss=gloss) for gloss in glosses])
        except PlanError as error:
            assert error.code == "self_collision"
            refused.append(f"{' '.join(glosses)}: {error}")
            continue
        # A tenth of the plans is looked at sample by sample, by a look that does not trust the planner's.
        if random.integers(10) == 0:
            for row in plan.positions[::3]:
                assert not looking.is_nearer(row, 0.0), glosses
    assert len(refused) <= 2, refused


def test_a_sign_that_is_swung_into_stands_still_where_its_hands_would_meet(lut: Lut, robot: Robot) -> None:
    tokens = parse_printed("TIERRA MESA")
    planner = Planner(lut, robot=robot)
    plan = planner.plan(tokens)
    assert plan.nearest is not None and plan.nearest.distance >= 0.002
    # The sign itself lasts no longer than half a second more than without looking.
    freely = Planner(lut).plan(tokens)
    assert plan.timings[1].duration < freely.timings[1].duration + 0.5


def test_no_overlap_between_two_looks_stays_unseen(robot: Robot, least_distance: LeastDistance) -> None:
    """On straight ways of the arms from anywhere to anywhere, beside a look at every hundredth."""
    random, limits = np.random.default_rng(3), joint_limits(COMMANDED_JOINTS)
    arms = [COMMANDED_JOINTS.index(name) for name in (*LEFT_ARM, *RIGHT_ARM)]
    looking, still = MotionClearance(robot), np.zeros((2, len(COMMANDED_JOINTS)))
    overlaps = 0
    for _ in range(15):
        ends = np.tile(REST, (2, 1))
        ends[:, arms] = random.uniform(limits.lower[arms], limits.upper[arms], (2, len(arms)))
        samples = Samples(times=np.array([0.0, 1.0]), positions=ends, velocities=still, accelerations=still)
        rows = ends[0] + np.linspace(0.0, 1.0, 101)[:, None] * (ends[1] - ends[0])
        least = least_distance(rows)
        found = looking.nearest(samples).distance
        if least < 0.0:
            overlaps += 1
            assert found < least + RESOLUTION
        else:
            assert found > -RESOLUTION, "a little deeper than at a hundredth"
    assert overlaps > 3


@pytest.mark.parametrize("glosses", ["GRACIAS TÚ", "TÚ GRACIAS", "MUÑECA LUNES"])
def test_hands_that_part_to_pass_stay_before_the_body(glosses: str, lut: Lut, robot: Robot) -> None:
    signs = dict(lut)
    assert without_looking(signs, glosses, robot) < 0.0
    plan = Planner(signs, robot=robot).plan(parse_printed(glosses))
    wrists = [
        robot.placement(robot.configuration(dict(zip(plan.names, plan.at(time)[0], strict=True))), wrist)
        for time in np.arange(0.0, plan.duration, 0.1)
        for wrist in ("FrontalRightWrist_link", "FrontalLeftWrist_link")
    ]
    # Arms that are stretched out to the sides reach 0.75 m.
    assert max(abs(wrist[1, 3]) for wrist in wrists) < 0.5


def test_a_way_on_which_a_hand_passes_through_another_shape_is_led_around_as_well(
    lut: Lut, robot: Robot
) -> None:
    # A thumb passes through another shape half way, where one hand would be in the other.
    plan = Planner(dict(lut), robot=robot).plan(parse_printed("SISTEMA SALSA"))
    assert MotionClearance(robot).nearest(plan.samples).distance >= 0.0


def test_where_no_way_leads_between_two_signs_others_keep_their_size(robot: Robot, lut: Lut) -> None:
    """Made smaller, two of the first three find no way from one to the other; the last three stay small."""
    planner = Planner(lut, robot=robot)
    tokens = parse_printed("MI ADAPTACIÓN ATENCIÓN ECHAR_DE_MENOS GRAVE NEGOCIAR")
    together = planner.plan(tokens).timings
    for token, timing in list(zip(tokens, together, strict=True))[3:]:
        (alone,) = planner.plan([token]).timings
        assert timing.duration == pytest.approx(alone.duration, abs=0.2)


def test_hands_deep_in_each_other_find_their_way_apart(
    robot: Robot, lut: Lut, least_distance: LeastDistance
) -> None:
    """No posture is clear on the straight ways to and from both."""
    tokens, planner = parse_printed("PLASTILINA HIJA MARCAR"), Planner(lut, robot=robot)
    plan = planner.plan(tokens)
    assert least_distance(plan.positions[::2]) > 0.0
    again = planner.plan(tokens)
    assert np.array_equal(again.positions, plan.positions), "what is found by chance is found again"


def test_an_elbow_behind_the_body_finds_its_way_to_rest(
    robot: Robot, lut: Lut, least_distance: LeastDistance
) -> None:
    """Its hand is before the belly, a finger's breadth off it."""
    begin = REST.copy()
    arm = [COMMANDED_JOINTS.index(name) for name in RIGHT_ARM]
    begin[arm] = np.radians([28.8, 1.6, 52.3, -97.5, -53.6, -53.7])
    plan = Planner(lut, robot=robot).plan_to_rest(State.still(begin))
    assert least_distance(plan.positions[::2]) > 0.0
    assert plan.duration < 4.0
