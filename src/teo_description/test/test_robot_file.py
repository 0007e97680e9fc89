# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What is wrong with a robot is said with its file and field."""

from __future__ import annotations

import math
import shutil
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from teo_description.errors import DescriptionError
from teo_description.humanoid import Humanoid, available_robots, load_humanoid
from teo_description.robot import Robot


def refused(act) -> str:
    with pytest.raises(DescriptionError) as caught:
        act()
    assert caught.value.code == "bad_robot"
    return str(caught.value)


def test_a_robot_of_ones_own_is_found_first(folder):
    assert "mine" in available_robots()
    assert load_humanoid("mine").urdf_path().is_relative_to(folder)
    shutil.copytree(folder, folder.parent / "gr1t2")
    assert load_humanoid("gr1t2").urdf_path().is_relative_to(folder.parent)


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("", "Expected `object`; got None"),
        ("schema: [1", "expected YAML"),
        ("- a\n- list\n", "Expected `object`; got ['a', 'list']"),
        (b"\xff\xfe\x00", "expected YAML in UTF-8"),
        ("x" * 1_000_001, "expected at most 1000000 bytes"),
    ],
    ids=["empty", "broken", "a list", "binary", "huge"],
)
def test_a_file_that_is_no_description_is_refused(folder, content, said):
    path = folder / "robot.yaml"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    message = refused(lambda: Humanoid(folder))
    assert str(path) in message
    assert said in message


@pytest.mark.parametrize(
    ("field", "value", "said"),
    [
        ("hand.palm", None, "hand.palm: Object missing required field"),
        ("schema", 2, "robot.yaml: schema: expected 1; got 2"),
        (
            "postures.ready_deg.right_elbow_pitch_joint",
            math.nan,
            "_joint: expected a finite number",
        ),
        ("colour", "red", "robot.yaml: colour: Object contains unknown field"),
        ("cameras.sign", None, "cameras: expected sign too"),
        ("natural_arm.lower_deg", [0.0], "natural_arm: expected an angle for each of the arm's 7 joints"),
        ("places.mouth.point", [0.1, 0.0, "x"], "places.mouth.point.2: Expected `float`; got 'x'"),
        ("limits", {"elbow": {"effort": 0}}, "limits.elbow.effort: Expected `float` > 0.0; got 0"),
        ("groups.head", {"jaw": "jaw"}, "groups.head.jaw: expected 'yaw' or 'pitch' or 'roll'; got 'jaw'"),
        ("collision.shapes", {"palm": [{}]}, "collision.shapes.palm.0: expected one of box"),
        # What the URDF lacks, or does not fit.
        ("groups.right_hand.index", "R_index_joint", "groups.right_hand: expected the mirror image"),
        ("groups.head.yaw", "neck_joint", "neck_joint"),
        ("limits", {"elbow": {"lower_deg": 0.0}}, "limits: expected names in the URDF, got elbow"),
        ("hand.palm", "palm", "hand: expected names in the URDF, got palm"),
        ("collision.torso", ["chest"], "collision.torso: expected names in the URDF, got chest"),
        ("origins", {"thumb": {"xyz": [0.0, 0.0, 0.0]}}, "origins: expected names in the URDF, got thumb"),
        ("cameras.hand.follows", "nose", "cameras: expected names in the URDF, got nose"),
        ("hand.fingers", {"index": ["R_palm"] * 4}, "hand.fingers: expected those of groups.right_hand"),
        ("mirror", [["port_", "starboard_"]], "groups.right_arm: expected the mirror image"),
    ],
)
def test_a_wrong_value_is_told_with_its_whole_path_and_what_was_expected(change, field, value, said):
    message = refused(lambda: Robot(change(field, value)).humanoid.limits())
    assert "robot.yaml: " in message
    assert said in message


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "expected XML"),
        ("<html><body/></html>", "expected a robot with one root link, got <html>"),
        ("<robot name='r'/>", "got 0 links that no joint holds"),
        ("<robot name='r'><link name='a'/><link name='b'/></robot>", "got 2 links that no joint holds"),
    ],
    ids=["empty", "a page", "no link", "two roots"],
)
def test_what_is_no_urdf_is_refused(change, folder, text, said):
    (folder / "urdf" / "bad.urdf").write_text(text)
    humanoid = change("urdf.file", "urdf/bad.urdf")
    assert said in refused(humanoid.urdf_text)


def test_what_is_not_there_is_said_with_what_brings_it(change):
    with pytest.raises(DescriptionError, match=r"expected a file .*none\.urdf"):
        change("urdf.file", "none.urdf").urdf_text()
    with pytest.raises(DescriptionError, match="expected the Python package no-such-robot: make robots"):
        change("urdf", {"file": "a.urdf", "package": "no-such-robot", "install": "make robots"}).urdf_text()


def test_limits_followers_and_origins_replace_those_of_the_urdf(change):
    name, follower = "right_elbow_pitch_joint", "R_index_intermediate_joint"
    change("limits", {name: {"lower_deg": -90.0, "velocity_deg": 10.0}})
    change("follows", {follower: {"joint": "R_index_proximal_joint", "multiplier": 0.5, "offset_deg": 3.0}})
    humanoid = change("origins", {"right_shoulder_pitch_joint": {"xyz": [0.1, -0.2, 0.3]}})
    limits = humanoid.limits([name])
    assert np.degrees(limits.lower[0]) == pytest.approx(-90.0)
    assert np.degrees(limits.velocity[0]) == pytest.approx(10.0)
    assert limits.upper[0] == pytest.approx(2.27)  # the URDF's
    robot = Robot(humanoid)
    q = robot.configuration({"R_index_proximal_joint": 1.0})
    row = robot.model.joints[robot.model.getJointId(follower)].idx_q
    assert q[row] == pytest.approx(0.5 + np.radians(3.0))
    torso, shoulder = robot.placements(q, ["torso_link", "right_upper_arm_pitch_link"])[:, :3, 3]
    np.testing.assert_allclose(shoulder - torso, [0.1, -0.2, 0.3], atol=1e-9)


def test_a_mesh_keeps_no_distance_and_shapes_come_on_both_sides(change):
    humanoid = change("collision.shapes.right_hand_yaw_link", [{"sphere": 0.05, "xyz": [0.0, 0.02, -0.1]}])
    shapes = {link.attrib["name"]: link for link in ET.fromstring(humanoid.urdf_text()).iter("link")}
    other = shapes["left_hand_yaw_link"].find("collision")
    assert float(other.find("geometry/sphere").attrib["radius"]) == 0.05
    y = float(other.find("origin").attrib["xyz"].split()[1])
    assert y == pytest.approx(-0.02, abs=1e-3)  # the forearms of the URDF are 0.1 mm unlike
    assert not [link for link in shapes.values() if link.find("collision/geometry/mesh") is not None]
