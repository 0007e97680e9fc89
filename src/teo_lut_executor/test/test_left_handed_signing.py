# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Signing left-handed: mirror images, within the limits of the other arm."""

from __future__ import annotations

import numpy as np
import pytest

from teo_description.robot import Robot
from teo_lut_executor.node.parameters import PARAMETERS, planner_settings_from
from teo_motion.planner import Planner
from teo_motion.sentence.plan import Plan
from teo_names import COMMANDED_JOINTS, LEFT_ARM, RIGHT_ARM, joint_limits
from teo_signs.errors import PlanError
from teo_signs.look_up_table import Lut
from teo_signs.mirroring import MirroredSigns, mirrored_sign
from teo_signs.sign import Sign
from teo_signs.tokens import parse_printed

MIRROR = np.diag([1.0, -1.0, 1.0])
# In a mirror the thumb's side of a hand changes: the y axis of a palm's frame, the x and z axes do not.
PALM = np.diag([1.0, -1.0, 1.0])


def pose(plan: Plan, row: np.ndarray) -> dict[str, float]:
    return dict(zip(plan.names, row.tolist(), strict=True))


@pytest.mark.parametrize("sentence", ["CASA COCHE FELIZ", "T-E-O NO"])
def test_a_left_handed_plan_is_the_mirror_image_of_the_right_handed_one(
    robot: Robot, lut: Lut, sentence: str
) -> None:
    tokens = parse_printed(sentence)
    mirrored = MirroredSigns(lut, robot)
    assert not any("mirror_error_mm" in mirrored[token.gloss].quality for token in tokens)
    right = Planner(lut, robot=robot).plan(tokens)
    left = Planner(mirrored, robot=robot).plan(tokens)
    assert left.duration == pytest.approx(right.duration)
    assert left.nearest is not None and left.nearest.distance >= 0.0
    rows = range(0, len(right.samples.times), 40)
    assert len(rows) > 5
    frames = ("right_palm", "left_palm", "FrontalNeck_link", "RightIndexFingerTip", "LeftIndexFingerTip")
    others = ("left_palm", "right_palm", "FrontalNeck_link", "LeftIndexFingerTip", "RightIndexFingerTip")
    for index in rows:
        one = robot.placements(robot.configuration(pose(right, right.samples.positions[index])), frames)
        two = robot.placements(robot.configuration(pose(left, left.samples.positions[index])), others)
        np.testing.assert_allclose(two[:, :3, 3], one[:, :3, 3] @ MIRROR, atol=1e-6)
        for palm in (0, 1):
            np.testing.assert_allclose(two[palm, :3, :3], MIRROR @ one[palm, :3, :3] @ PALM, atol=1e-6)


@pytest.mark.slow
def test_every_sign_can_be_made_left_handed_within_the_limits_and_says_what_is_lost(
    robot: Robot, lut: Lut
) -> None:
    mirrored = MirroredSigns(lut, robot)
    assert set(mirrored) == set(lut) and len(mirrored) == len(lut)
    for gloss, sign in lut.items():
        other = mirrored[gloss]
        limits = joint_limits(other.joints)
        assert (other.knots >= limits.lower - 1e-6).all(), gloss
        assert (other.knots <= limits.upper + 1e-6).all(), gloss
        assert other.handedness == {"right": "left", "both": "both"}[sign.handedness]
        # Measured here anew: how far each palm is from its mirror image.
        off = 0.0
        for knot in range(len(sign.times)):
            wanted = robot.placement(robot.configuration(sign.pose(knot)), "right_palm")[:3, 3] @ MIRROR
            got = robot.placement(robot.configuration(other.pose(knot)), "left_palm")[:3, 3]
            off = max(off, 1000.0 * float(np.linalg.norm(got - wanted)))
        assert off <= other.quality.get("mirror_error_mm", 0.0) + 0.1, gloss
        assert off < 23.0, gloss


def test_what_is_beyond_the_other_arms_limit_is_brought_near_not_cut_off(robot: Robot, lut: Lut) -> None:
    """MI turns the right upper arm in by 57 deg; the left one turns in by 51.6 deg."""
    sign, other = lut["MI"], mirrored_sign(robot, lut["MI"])
    turn = other.knots[0, other.joints.index("AxialLeftShoulder")]
    assert turn >= joint_limits(("AxialLeftShoulder",)).lower[0]
    cut = dict(zip(LEFT_ARM, [0.0] * 6, strict=True))
    for name, mirror in zip(RIGHT_ARM, LEFT_ARM, strict=True):
        value = sign.pose(0)[name] * (1.0 if name.startswith("Frontal") else -1.0)
        bound = joint_limits((mirror,))
        cut[mirror] = float(np.clip(value, bound.lower[0], bound.upper[0]))
    wanted = robot.placement(robot.configuration(sign.pose(0)), "right_palm")[:3, 3] @ MIRROR

    def off(angles: dict[str, float]) -> float:
        return float(
            np.linalg.norm(robot.placement(robot.configuration(angles), "left_palm")[:3, 3] - wanted)
        )

    assert off(other.pose(0)) < off(cut)
    assert other.quality["mirror_error_mm"] > 0.0
    assert "irrored" in other.provenance.notes


def test_an_arm_brought_within_its_limits_does_not_touch(robot: Robot, lut: Lut) -> None:
    """MÍO has the elbow at the trunk: the arm that is nearest to its mirror image would touch there."""
    for gloss in ("MÍO", "YO", "ABURRIDO"):
        other = mirrored_sign(robot, lut[gloss])
        assert "mirror_error_mm" in other.quality
        for knot in range(len(other.times)):
            assert robot.clearance(robot.configuration(other.pose(knot))).distance > 0.004


def test_a_sign_that_has_changed_is_mirrored_anew(robot: Robot, lut: Lut) -> None:
    signs: dict[str, Sign] = {"X": lut["CASA"]}
    mirrored = MirroredSigns(signs, robot)
    first = mirrored["X"]
    assert mirrored["X"] is first
    signs["X"] = lut["COCHE"]
    assert len(mirrored["X"].times) == len(lut["COCHE"].times)
    assert set(mirrored["X"].joints) <= set(COMMANDED_JOINTS)


def test_the_dominant_hand_is_right_left_or_refused() -> None:
    values = {row.name: row.default for row in PARAMETERS}
    assert not planner_settings_from(values).left_handed
    assert planner_settings_from(values | {"dominant_hand": "left"}).left_handed
    with pytest.raises(PlanError, match="expected one of right, left, got 'both'") as refusal:
        planner_settings_from(values | {"dominant_hand": "both"})
    assert refusal.value.code == "bad_hand"
