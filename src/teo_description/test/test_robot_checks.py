# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`robots check` finds what a newcomer gets wrong, and says which field to look at."""

from __future__ import annotations

import re

import cv2
import numpy as np
import pytest

from teo_description import robots_cli
from teo_description.humanoid import Humanoid, load_humanoid, robot_folders
from teo_description.kinematic_checks import frame_checks, hand_checks, limit_checks, symmetry_checks
from teo_description.robot import Robot
from teo_description.shape_checks import shape_checks
from teo_description.space_checks import ArmReach, collision_checks

SECOND = robot_folders()[1] / "gr1t2"


def failed(findings) -> dict[str, str]:
    return {finding.field: finding.measured for finding in findings if not finding.ok}


@pytest.mark.parametrize(
    ("check", "changed", "value", "field"),
    [
        (hand_checks, "frames.R_palm.rpy_deg", [90.0, 90.0, 0.0], "groups.right_hand.index"),
        (hand_checks, "frames.R_palm.rpy_deg", [0.0, 0.0, 0.0], "hand.palm"),
        (symmetry_checks, "origins", {}, "origins"),
        (symmetry_checks, "limits.R_index_proximal_joint", {"upper_deg": 60.0}, "limits"),
        (limit_checks, "limits", {}, "limits"),
        (limit_checks, "postures.ready_deg.right_elbow_pitch_joint", -150.0, "postures.ready_deg"),
        (limit_checks, "limits.head_yaw_joint", {"velocity_deg": 0.1}, "limits"),
        (frame_checks, "postures.ready_deg.right_shoulder_pitch_joint", 100.0, "postures.ready_deg"),
        (collision_checks, "postures.home_deg", {}, "postures.home_deg"),
        (collision_checks, "collision.shapes.R_hand_base_link", [], "collision.shapes"),
    ],
)
def test_what_is_wrong_is_found_and_its_field_named(change, check, changed, value, field):
    assert field in failed(check(Robot(change(changed, value))))


def test_parts_without_a_shape_and_shapes_beside_their_parts_are_named_with_how_far(change, folder):
    pytest.importorskip("trimesh")
    bare = ("waist_yaw_link", "head_pitch_link", "torso_link")
    collision = load_humanoid("gr1t2").file.collision
    for part in ("torso", "head"):
        change(f"collision.{part}", [link for link in getattr(collision, part) if link not in bare])
    change("collision.shapes.right_upper_arm_yaw_link.0.xyz", [0.0, 0.15, -0.096])
    _, outside, wide = shape_checks(Robot(Humanoid(folder)))
    far = {
        name: int(by) for name, by in re.findall(r"(\w+) is (\d+) mm outside: \{xyz: \[", outside.measured)
    }
    # The trunk is 28 cm wide, and nothing else is near its middle. The rod is 15 cm beside its arm, whose
    # ends the shapes of shoulder and elbow hold.
    assert far["torso_link"] > 80
    assert far["waist_yaw_link"] > 40
    assert 50 < far["right_upper_arm_yaw_link"] < 150
    assert "right_upper_arm_yaw_link 1" in wide.measured
    assert not outside.ok
    assert not wide.ok


@pytest.mark.parametrize(
    ("name", "notes"),
    [
        ("teo", {"arms and hands have the same limits on both sides"}),
        ("gr1t2", {"shapes are compared with meshes"}),  # where its package is not installed
    ],
)
def test_a_well_described_robot_passes(name, notes):
    robot = Robot.load(name)
    for check in (frame_checks, symmetry_checks, limit_checks, hand_checks, collision_checks, shape_checks):
        assert {finding.what for finding in check(robot) if not finding.ok} <= notes


def test_joints_of_simulators_are_passed_over_and_endless_ones_turn_once(folder):
    # As in Valkyrie's URDF: transmissions and sensors name joints, and a laser turns without end.
    path = folder / "urdf" / "gr1t2_inspire_hand.urdf"
    others = '<transmission name="t"><joint name="head_yaw_joint"/></transmission><gazebo><joint/></gazebo>'
    laser = """<link name="laser"/><joint name="laser_joint" type="continuous">
        <parent link="head_yaw_link"/><child link="laser"/><axis xyz="0 0 1"/></joint>"""
    path.write_text(path.read_text().replace("</robot>", f"{others}{laser}</robot>"))
    robot, plain = Robot(Humanoid(folder)), Robot.load("gr1t2")
    for check in (frame_checks, symmetry_checks, limit_checks, hand_checks, collision_checks):
        assert failed(check(robot)) == {}
    bent = {"right_elbow_pitch_joint": -1.0}
    here, there = (one.placement(one.configuration(bent), "R_palm") for one in (robot, plain))
    np.testing.assert_allclose(here, there, atol=1e-12)
    point = np.array([0.3, -0.15, 0.3])
    assert ArmReach(robot, "right").to(point, "R_palm", body=False).ok


def test_an_arm_reaches_what_is_near_and_not_what_is_far():
    robot = Robot.load("gr1t2")
    arm = ArmReach(robot, "right")
    near = np.array([0.3, -0.15, 0.3])
    reached = arm.to(near, arm.palm, body=False)
    assert reached.ok
    palm = robot.placement(robot.configuration(reached.positions), arm.palm)[:3, 3]
    assert np.linalg.norm(palm - near) < 0.01
    # 0.76 m from the shoulder to the tips: two metres before it, 1.3 m are missing.
    far = arm.to(np.array([2.0, -0.2, 0.4]), arm.tip, body=False)
    assert not far.ok
    assert far.distance == pytest.approx(1.24, abs=0.1)
    inside = arm.to(np.array([0.0, 0.0, 0.3]), arm.palm, body=False)
    assert "torso_link" in inside.why


@pytest.fixture
def robots(monkeypatch, capsys):
    def run(*arguments):
        monkeypatch.setattr("sys.argv", ["robots", *map(str, arguments)])
        with pytest.raises(SystemExit) as ended:
            robots_cli.main()
        output = capsys.readouterr()
        return ended.value.code or 0, output.out, output.err

    return run


def test_robots_are_listed_and_shown(robots):
    code, said, _ = robots("list")
    assert code == 0
    assert "teo          TEO" in said
    assert "gr1t2        Fourier" in said
    code, said, _ = robots("show", "gr1t2")
    assert code == 0
    assert "right_elbow_pitch_joint" in said
    assert "-130" in said  # its lower limit, -2.27 rad
    assert "from [deg]" in said


def test_the_links_of_a_bare_urdf_are_told_with_what_moves_them(robots):
    code, said, _ = robots("links", SECOND / "urdf" / "gr1t2_inspire_hand.urdf")
    assert code == 0
    (elbow,) = [line for line in said.splitlines() if line.startswith("right_lower_arm_pitch_link: ")]
    # Its own line of the file: axis y, -2.27 to 2.27 rad, 5.24 rad/s.
    assert "moved by right_elbow_pitch_joint about (0.00, 1.00, 0.00), -130 to 130 deg, 300 deg/s" in elbow


def test_a_posture_is_found_for_a_palm_and_an_elbow_and_written_for_both_sides(robots):
    code, said, _ = robots(
        "pose", "gr1t2", "--palm=0.3,-0.2,0.25", "--elbow=0,-0.3,0.15", "--fingers=1,0.3,0"
    )
    assert code == 0
    angles = dict(re.findall(r"^(\w+): (-?\d+\.0)$", said, re.MULTILINE))
    robot = Robot.load("gr1t2")
    posture = {name: np.radians(float(angle)) for name, angle in angles.items()}
    right, left = robot.placements(robot.configuration(posture), ("R_palm", "L_palm"))[:, :3, 3]
    assert np.linalg.norm(right - (0.3, -0.2, 0.25)) < 0.05
    assert np.linalg.norm(left * (1.0, -1.0, 1.0) - right) < 0.01
    code, _, said = robots("pose", "gr1t2", "--palm=0.3", "--elbow=0,0,0", "--fingers=1,0,0")
    assert code == 1
    assert "bad_point" in said


def test_what_a_left_joint_should_be_as_a_mirror_image_is_told(change):
    (sides, _) = symmetry_checks(Robot(change("origins", {})))
    # As it was worked out by hand for the robot's file.
    assert "L_index_proximal_joint: {xyz: [0.03227, -0.00029, -0.13653], rpy_deg: [88.001, " in sides.measured


@pytest.mark.parametrize("command", ["show", "check"])
def test_an_unknown_robot_ends_with_status_1_and_the_names_that_there_are(robots, command):
    code, _, said = robots(command, "nobody")
    assert code == 1
    assert "expected a robot among" in said
    assert "gr1t2" in said


def test_check_ends_with_status_1_names_the_field_and_leaves_pictures(robots, change, tmp_path, caplog):
    change("meshes")
    change("postures.home_deg", {"right_shoulder_roll_joint": 12.0, "left_shoulder_roll_joint": -12.0})
    code, said, failure = robots("check", "mine", "--out", tmp_path / "seen")
    assert code == 1
    assert "FAIL nothing touches at home" in said
    assert re.search(r"hand\.palm +R_palm +at \(-?0\.\d+, -0\.\d+, -0\.\d+\), x \(", said)
    assert "1 checks failed; look at postures.home_deg in robot.yaml" in failure
    assert "mine is drawn as plain shapes" in caplog.text
    for name in ("hand.png", "postures.png"):
        assert cv2.imread(str(tmp_path / "seen" / name)).std() > 10.0
