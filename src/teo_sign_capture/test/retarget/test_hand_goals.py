# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from importlib import resources
from pathlib import Path

import numpy as np
import pytest
from robot_person import JOINTS, goals_of, keypoints, track_of

from teo_description.hand_geometry import HandTable
from teo_description.humanoid import load_humanoid
from teo_description.robot import Robot
from teo_sign_authoring.alphabet.letter_clips import load_letter_clips
from teo_sign_capture.entries.take import capture_take
from teo_sign_capture.recordings.recording import open_recording
from teo_sign_capture.recordings.recording import track_of as recorded_track
from teo_sign_capture.retarget.arm_kinematics import ArmKinematics, arm_bounds
from teo_sign_capture.retarget.body_map import BodyMap
from teo_sign_capture.retarget.hand_goals import before_folded_arm, hand_goals, pair_goals
from teo_sign_capture.retarget.head_motion import follow_head
from teo_sign_capture.signing_space import MIRROR, robot_hand_points
from teo_sign_capture.tracks.head_pose import head_pose
from teo_sign_capture.tracks.signer_motion import measure_person, signer_arm
from teo_sign_languages import DEFAULT_LANGUAGE, load_language

# Among the points of a hand: palm, heel, four knuckles, four middle joints, then the tips.
INDEX_TIP = 10
STRAIGHT = np.zeros((4, 3))
ARM = np.array([[[0.0, -0.35, 0.0], [0.1, -0.35, -0.3], [0.3, -0.2, -0.1]]])


class Scene:
    """A person of TEO's build, and TEO."""

    def __init__(self) -> None:
        robot = Robot.load()
        points = keypoints(robot, JOINTS, np.zeros((1, len(JOINTS))))
        track = track_of(np.zeros(1), points)
        person = measure_person(track)
        self.body = BodyMap(robot, ArmKinematics(robot), person)
        self.head = follow_head(robot, head_pose(track, person.head_shape), person)
        straight = np.radians([[10.0, -60.0, 7.0, 7.0, 7.0, 7.0]])
        self.teo = robot_hand_points(HandTable(robot), straight)
        self.chin = person.places["chin"]
        # A right hand pointing up, its palm to the person: along z, palm out along -x.
        hand = track.right_hand.positions[0] - track.right_hand.positions[0, 0]
        turn = np.array([[0.0, -1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])
        self.hand = hand @ turn.T

    def goals(self, hand, side="right", together=0.0):
        arm = signer_arm(side, ARM if side == "right" else ARM * MIRROR, hand[None], STRAIGHT)
        return hand_goals(self.body, self.head, arm, self.teo, together)[0]

    def pair(self, right, left, joints=None):
        joints = joints or (ARM, ARM * MIRROR)
        arms = {
            side: signer_arm(side, own, hand[None], STRAIGHT)
            for side, own, hand in zip(("right", "left"), joints, (right, left), strict=True)
        }
        return pair_goals(self.body, np.zeros(1), arms, dict.fromkeys(arms, self.teo))


@pytest.fixture(scope="module")
def scene():
    return Scene()


def test_at_the_chin_the_finger_tip_that_touches_it_counts(scene):
    tip = scene.chin + np.array([0.008, 0.0, 0.0])
    # The hand points at the face, its index 5 cm before the others.
    pointing = scene.hand @ np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])
    pointing[8] -= np.array([0.05, 0.0, 0.0])
    goals = scene.goals(pointing - pointing[8] + tip)
    assert goals.contact[0] == 1.0
    assert np.linalg.norm(scene.teo[0] - goals.local[0], axis=1).argmin() == INDEX_TIP
    # A finger's radius before TEO's chin, and somewhat beside it for what else is near.
    assert np.linalg.norm(goals.place[0] - (0.1095, 0.0, 0.640)) < 0.03


def test_a_hand_straight_before_the_chin_is_at_the_face_and_one_before_the_chest_is_not(scene):
    before = scene.hand - scene.hand[8] + scene.chin + np.array([0.3, 0.0, 0.0])
    assert scene.goals(before).at_face[0] == 1.0
    assert scene.goals(before - np.array([0.0, 0.0, 0.3])).at_face[0] == 0.0


def test_before_the_face_what_is_nearest_to_its_middle_counts(scene):
    """A tip that is seen on the chin, 20 cm before it, as on TEO: not the palm, which is larger there."""
    pointing = scene.hand @ np.array([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])  # from the right
    pointing[8] += np.array([0.0, 0.05, 0.0])
    goals = scene.goals(pointing - pointing[8] + scene.chin + np.array([0.2, -0.02, 0.0]))
    assert goals.contact[0] == 0.0
    assert np.linalg.norm(scene.teo[0] - goals.local[0], axis=1).argmin() == INDEX_TIP
    assert goals.place[0, 2] == pytest.approx(0.640, abs=0.03)


def test_hands_at_each_other_before_the_trunk_do_not_touch_it(scene):
    at_chest = scene.hand - scene.hand.mean(axis=0) + np.array([0.12, 0.0, -0.12])
    assert scene.goals(at_chest).contact[0] == 1.0
    assert scene.goals(at_chest, together=1.0).contact[0] == 0.0
    at_chin = scene.hand - scene.hand[8] + scene.chin
    assert scene.goals(at_chin, together=1.0).contact[0] == pytest.approx(scene.goals(at_chin).contact[0])


def test_from_air_to_contact_nothing_jumps(scene):
    ways = np.linspace(0.25, 0.01, 200)
    at_chin = scene.hand - scene.hand[8] + scene.chin
    places = np.stack([scene.goals(at_chin + np.array([way, 0.0, 0.0])).local[0] for way in ways])
    assert np.linalg.norm(np.diff(places, axis=0), axis=1).max() < 0.01


@pytest.mark.parametrize(("apart", "nearness"), [(0.40, 0.0), (0.03, 1.0)])
def test_hands_that_are_near_each_other_keep_the_way_between_them(scene, apart, nearness):
    right = scene.hand + np.array([0.35, 0.0, 0.0])
    left = right + np.array([apart, 0.0, 0.0])  # palm to back, the left one behind
    pair = scene.pair(right, left)
    assert pair.nearness[0] == pytest.approx(nearness)
    assert pair.way[0] == pytest.approx(scene.body.scale * (-apart, 0.0, 0.0), abs=0.01)


@pytest.mark.parametrize(("ahead", "front"), [(0.08, 1.0), (-0.08, -1.0)])
def test_of_arms_that_cross_the_one_in_front_is_told(scene, ahead, front):
    """Each hand on the other side's breast; which forearm is before the other tells them apart."""
    right = scene.hand + np.array([0.25 + ahead, 0.12, 0.0])
    left = scene.hand * MIRROR + np.array([0.25, -0.12, 0.0])
    arms = [
        np.array([[(0.0, -side * 0.2, 0.0), (0.2 + x, -side * 0.15, -0.25), hand[0]]])
        for side, x, hand in ((1.0, ahead, right), (-1.0, 0.0, left))
    ]
    pair = scene.pair(right, left, arms)
    assert pair.order[0, 0] * front > 0.9
    assert pair.order[0, 1] <= 0.0  # beside leads nowhere


def test_a_wrist_near_the_chest_is_no_touch(scene):
    # Held straight forwards, the end of the hand at the skin: palm and knuckles are in the air.
    forwards = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])
    hand = scene.hand @ forwards.T + np.array([0.11, -0.25, -0.05])
    heel, knuckle = scene.body.distance(hand[None], scene.head)[0, [0, 9]]
    assert heel < 0.035 < 0.12 < knuckle
    assert scene.goals(hand).contact[0] < 0.7
    assert scene.goals(hand - np.array([0.1, 0.0, 0.0])).contact[0] == pytest.approx(1.0)


COUNT = 200


def test_what_an_arm_has_reached_stays_where_it_is(chain):
    random = np.random.default_rng(0)
    arms = random.uniform(*arm_bounds(load_humanoid(), "both"), (COUNT, 6))
    goals = goals_of(chain, arms, local=random.uniform(-0.1, 0.1, (COUNT, 3)), contact=0.0)
    assert before_folded_arm(chain, goals).place == pytest.approx(goals.place, abs=1e-9)


def test_what_is_too_near_goes_towards_who_watches_as_far_as_a_folded_arm_and_a_touch_stays(chain):
    random = np.random.default_rng(1)
    arms = random.uniform(*arm_bounds(load_humanoid(), "both"), (COUNT, 6))
    arms[:, 3] = np.radians(random.uniform(-150.0, -105.0, COUNT))  # as a person's elbow closes
    poses = chain.poses(arms)
    moved, touch = (
        before_folded_arm(chain, goals_of(chain, arms, contact=contact)).place - poses.place
        for contact in (0.0, 1.0)
    )
    # Where it is seen does not change for eyes 2.3 m in front, as high as TEO's.
    eyes = np.array([2.3, 0.0, 0.72])
    assert (moved[:, 0] > 0.0).all()
    assert np.cross(moved, eyes - poses.place) == pytest.approx(0.0, abs=1e-9)
    arms[:, 3] = arm_bounds(load_humanoid(), "both")[0][3]
    folded = np.linalg.norm(chain.poses(arms).origins[:, 5] - chain.shoulder, axis=1)
    wrists = poses.origins[:, 5] + moved
    assert np.linalg.norm(wrists - chain.shoulder, axis=1) == pytest.approx(folded, abs=1e-9)
    # At shoulders' height and above, throat and face among it, hands touch; lower up to 10 cm before it.
    high = poses.place[:, 2] >= chain.shoulder[2]
    assert high.sum() > COUNT // 10
    assert touch[high] == pytest.approx(0.0, abs=1e-9)
    low = poses.place[:, 2] <= chain.shoulder[2] - 0.1
    way = np.linalg.norm(moved[low], axis=1)
    assert np.linalg.norm(touch[low], axis=1) == pytest.approx(np.minimum(way, 0.10), abs=1e-9)


def test_a_letter_held_beside_the_shoulder_stands_up(robot, tmp_path: Path):
    folder = Path(str(resources.files("spoken_to_signed"))) / "assets" / "fingerspelling_lexicon" / "ssp"
    clip = open_recording(folder / load_letter_clips(load_language(DEFAULT_LANGUAGE))["L"].file)
    motion = capture_take(robot, recorded_track(clip, cache=tmp_path)[0]).motion
    # An L that is tilted by half a right angle is read as another letter.
    assert np.degrees(np.nanmax(motion.finger_error)) < 45.0
    assert np.degrees(np.nanmax(motion.palm_error)) < 45.0
    assert not np.nansum(motion.wrong_place)
