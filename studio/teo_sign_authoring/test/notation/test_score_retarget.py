# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Sign scores: what their words mean on the robot, and what is said of a bad one."""

from __future__ import annotations

from itertools import islice, pairwise
from pathlib import Path

import numpy as np
import pytest
from refusals import refused

from teo_description.robot import Robot
from teo_names import LEFT_ARM, RIGHT_ARM
from teo_sign_authoring.notation.score_file import default_scores_directory, read_score, read_scores
from teo_sign_authoring.notation.score_retarget import score_sign
from teo_sign_capture.retarget.body_map import body_boxes
from teo_sign_capture.signing_space import NAMES, OTHER_HAND, find_place
from teo_signs.look_up_table import Lut
from teo_signs.sign import Sign

GOOD = """\
gloss: PRUEBA
standing: sketched
source: made up
hands: right
steps:
  - right: {shape: flat, place: space, palm: in, fingers: front up}
  - time: 0.5
    right: {place: space 10 up}
    hold: 0.2
"""


INSIDE = "place: upper_chest 6 back, palm: back, fingers: in up"


def write(folder: Path, text: str, name: str = "PRUEBA") -> Path:
    path = folder / f"{name}.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def made(robot: Robot, folder: Path, text: str) -> Sign:
    return score_sign(robot, read_score(write(folder, text)))


def palm(robot: Robot, sign: Sign, knot: int, side: str = "right") -> np.ndarray:
    return np.asarray(robot.placement(robot.configuration(sign.pose(knot)), f"{side}_palm"))


def test_places_of_the_face_are_on_the_surface_that_hands_stop_at(robot: Robot) -> None:
    boxes = body_boxes(robot)
    for name in ("forehead", "temple", "eye", "nose", "ear", "cheek", "mouth", "mouth_corner", "chin"):
        point = find_place(robot.humanoid, name).point
        # How far outside each box, its sides counted from within: 0 on the surface.
        outside = [float((np.abs(point - middle) - half).max()) for middle, half in boxes]
        assert abs(min(outside, key=abs)) < 0.001, name
    for name in set(NAMES) - set(OTHER_HAND):
        point = find_place(robot.humanoid, name).point
        assert all((np.abs(point - middle) - half).max() > -0.001 for middle, half in boxes), name


def test_a_hand_goes_where_the_score_says_and_stays(robot: Robot, tmp_path: Path) -> None:
    sign = made(robot, tmp_path, GOOD)
    first, last = palm(robot, sign, 0), palm(robot, sign, -1)
    # Place and orientation are traded against each other in the air: a few centimetres.
    np.testing.assert_allclose(first[:3, 3], find_place(robot.humanoid, "space").point, atol=0.06)
    np.testing.assert_allclose(last[:3, 3] - first[:3, 3], [0.0, 0.0, 0.10], atol=0.06)
    # "in" is to the robot's left, REP-103's +y; the third axis of the palm's frame looks out of the palm.
    assert np.degrees(np.arccos(first[:3, 2] @ [0.0, 1.0, 0.0])) < 15.0
    assert np.degrees(np.arccos(first[:3, 0] @ [0.7071, 0.0, 0.7071])) < 20.0
    assert sign.times.tolist() == pytest.approx([0.0, 0.5, 0.7])
    np.testing.assert_array_equal(sign.knots[-1], sign.knots[-2])


def test_the_mirrored_hand_mirrors(robot: Robot, tmp_path: Path) -> None:
    sign = made(robot, tmp_path, GOOD.replace("hands: right", "hands: mirrored"))
    right, left = palm(robot, sign, 0), palm(robot, sign, 0, "left")
    np.testing.assert_allclose(left[:3, 3], right[:3, 3] * [1, -1, 1], atol=1e-6)
    assert sign.handedness == "both"


def test_a_hand_can_be_put_on_the_other(robot: Robot, tmp_path: Path) -> None:
    text = """\
gloss: PRUEBA
standing: sketched
source: made up
hands: both
steps:
  - left: {shape: flat, place: low_space, palm: up, fingers: front in}
    right: {shape: fist, place: other_palm 12 up, part: little_side, palm: in, fingers: front up}
  - time: 0.3
    right: {place: other_palm 2 up}
"""
    sign = made(robot, tmp_path, text)
    for knot, gap in ((0, 0.12), (-1, 0.02)):
        q = robot.configuration(sign.pose(knot))
        fist, other = robot.placement(q, "right_palm"), robot.placement(q, "left_palm")
        assert abs(fist[0, 3] - other[0, 3]) < 0.10
        assert fist[2, 3] - other[2, 3] == pytest.approx(gap + 0.05, abs=0.05)
        assert robot.clearance(q).distance > 0.0


def test_circles_come_round_and_wiggles_come_back(robot: Robot, tmp_path: Path) -> None:
    circle = "    circle: {plane: front, radius: 5, turns: 2, start: up, time: 1.2}\n"
    sign = made(robot, tmp_path, GOOD.replace("    hold: 0.2\n", circle))
    places = np.array([palm(robot, sign, knot)[:3, 3] for knot in range(1, len(sign.times))])
    assert np.ptp(places[:, 1]) == pytest.approx(0.10, abs=0.03)
    assert np.ptp(places[:, 2]) == pytest.approx(0.10, abs=0.03)
    np.testing.assert_allclose(places[1], places[9], atol=0.005)  # the second round as the first

    wiggle = "    wiggle: {joint: forearm, angle: 30, times: 2, time: 0.8}\n"
    sign = made(robot, tmp_path, GOOD.replace("    hold: 0.2\n", wiggle))
    forearm = np.degrees(sign.knots[1:, sign.joints.index("AxialRightWrist")])
    assert np.abs(np.diff(forearm)) == pytest.approx([30.0] * 4, abs=0.1)
    assert sign.duration == pytest.approx(1.3)


@pytest.mark.parametrize(
    "movement",
    [
        "circle: {plane: top, radius: 4, turns: 1, start: front, time: 0.8, hand: right}",
        "wiggle: {joint: forearm, angle: 30, times: 2, time: 0.8, hand: right}",
        "wiggle: {joint: index, angle: 30, times: 2, time: 0.8, hand: right}",
    ],
)
def test_a_movement_of_one_hand_leaves_the_other_still(robot: Robot, tmp_path: Path, movement: str) -> None:
    text = (
        GOOD.replace("hands: right", "hands: both").partition("  - right")[0]
        + f"""\
  - right: {{shape: flat, place: space 10 out, palm: in, fingers: front up}}
    left: {{shape: flat, place: space 10 out, palm: in, fingers: front up}}
    {movement}
"""
    )
    sign = made(robot, tmp_path, text)
    moved = {joint for joint, way in zip(sign.joints, np.ptp(sign.knots, axis=0), strict=True) if way > 0.01}
    assert moved and all("Right" in joint for joint in moved)


def test_a_hand_wanted_inside_the_body_stays_outside_and_says_how_far(robot: Robot, tmp_path: Path) -> None:
    sign = made(robot, tmp_path, GOOD.replace("place: space, palm: in, fingers: front up", INSIDE))
    assert sign.quality["clearance_mm"] > 0.0
    assert sign.quality["place_error_mm"] > 60.0


@pytest.mark.parametrize(
    ("old", "new", "code", "said"),
    [
        ("shape: flat", "shape: flatt", "bad_score", ":6: steps.0.right.shape: expected a handshape among"),
        ("place: space 10 up", "place: space 10", "bad_score", ":8: steps.1.right.place: expected a word"),
        ("place: space,", "place: heaven,", "bad_score", ":6: steps.0.right.place: expected a place among"),
        ("palm: in", "palm: front up", "bad_score", ":1: score: palm and fingers about at a right angle"),
        ("palm: in, ", "", "bad_score", "the first step to say shape, place, palm and fingers"),
        ("standing: sketched", "standing: sure", "bad_score", ":2: standing:"),
        ("time: 0.5", "tempo: 0.5", "bad_score", ":7: steps.1.tempo:"),
        (
            "    hold: 0.2",
            "    wiggle: {joint: thumb, angle: 9, times: 1, time: 1, hand: right}",
            "bad_score",
            "no hand named for a movement where hands is 'right'",
        ),
        ("gloss: PRUEBA", "gloss: OTRA", "gloss_mismatch", "expected 'PRUEBA'"),
        ("hands: right", "hands: [right", "not_yaml", "PRUEBA.yaml"),
        (GOOD, "", "bad_score", "PRUEBA.yaml:1"),
        (GOOD, "x" * 200_000, "too_large", "PRUEBA.yaml"),
    ],
)
def test_a_bad_score_is_refused_with_line_and_field(
    tmp_path: Path, old: str, new: str, code: str, said: str
) -> None:
    with refused(code) as caught:
        read_score(write(tmp_path, GOOD.replace(old, new)))
    assert said in str(caught.value)


SECOND = GOOD.replace("PRUEBA", "OTRA").replace("hands: right", "hands: mirrored").replace("10 up", "10 down")
COMPOUND = """\
gloss: LAS_DOS
standing: sketched
source: made up
signs: [PRUEBA, OTRA]
"""


def test_a_compound_is_its_signs_one_after_the_other(robot: Robot, tmp_path: Path) -> None:
    write(tmp_path, GOOD)
    write(tmp_path, SECOND, "OTRA")
    sign = score_sign(robot, read_score(write(tmp_path, COMPOUND, "LAS_DOS")))
    first, second = (score_sign(robot, read_score(tmp_path / f"{name}.yaml")) for name in ("PRUEBA", "OTRA"))
    assert sign.gloss == "LAS_DOS"
    assert sign.handedness == "both"
    assert first.duration + second.duration < sign.duration < first.duration + second.duration + 0.5
    right = [sign.joints.index(joint) for joint in RIGHT_ARM]
    for at, part, knot in ((0, first, 0), (len(first.times) - 1, first, -1), (-1, second, -1)):
        np.testing.assert_allclose(sign.knots[at, right], part.knots[knot, : len(right)], atol=0.05)
    # The left hand takes no part in the first, and is low.
    assert palm(robot, sign, 0, "left")[2, 3] < palm(robot, sign, 0)[2, 3] - 0.10
    np.testing.assert_allclose(palm(robot, sign, -1, "left")[2, 3], palm(robot, sign, -1)[2, 3], atol=0.03)


def test_a_compound_of_one_is_the_same_sign_under_a_second_name(robot: Robot, tmp_path: Path) -> None:
    write(tmp_path, GOOD)
    again = read_score(write(tmp_path, COMPOUND.replace("PRUEBA, OTRA", "PRUEBA"), "LAS_DOS"))
    kept, other = score_sign(robot, read_score(tmp_path / "PRUEBA.yaml")), score_sign(robot, again)
    assert other.gloss == "LAS_DOS"
    np.testing.assert_array_equal(other.knots, kept.knots)
    np.testing.assert_array_equal(other.times, kept.times)


@pytest.mark.parametrize(
    ("signs", "said"),
    [
        ("[PRUEBA, NADA]", ":4: signs.1: expected a sign with a score beside this one, got 'NADA'"),
        ("[LAS_DOS]", ":4: signs.0: expected a sign that is not made of itself"),
        ("[ANILLO]", "ANILLO.yaml:4: signs.0: expected a sign that is not made of itself, got 'LAS_DOS'"),
        ("[]", ":4: signs:"),
    ],
)
def test_a_compound_of_what_is_not_there_is_refused(tmp_path: Path, signs: str, said: str) -> None:
    write(tmp_path, GOOD)
    write(tmp_path, COMPOUND.replace("LAS_DOS", "ANILLO").replace("[PRUEBA, OTRA]", "[LAS_DOS]"), "ANILLO")
    with refused("bad_score") as caught:
        read_score(write(tmp_path, COMPOUND.replace("[PRUEBA, OTRA]", signs), "LAS_DOS"))
    assert said in str(caught.value)


def test_entries_that_scores_made_keep_clearance_between_their_knots(robot: Robot, shipped: Lut) -> None:
    """A second look at every third, denser than the one that made it."""
    for score in islice(read_scores(default_scores_directory()), 0, None, 3):
        sign = shipped[score.gloss]
        assert sign.provenance.standing == score.standing
        ways = [np.linspace(first, second, 9) for first, second in pairwise(sign.knots)]
        rows = np.unique(np.concatenate(ways).round(9), axis=0)  # what is held or repeated is looked at once
        for row in rows.tolist():
            pose = dict(zip(sign.joints, row, strict=True))
            assert robot.clearance(robot.configuration(pose)).distance > 0.0, score.gloss
        uses_left = any(joint in sign.joints for joint in LEFT_ARM)
        assert uses_left == (score.hands != "right")
        assert set(RIGHT_ARM) <= set(sign.joints)
