# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from importlib import resources
from pathlib import Path

import numpy as np
import pytest

from teo_description.humanoid import load_humanoid
from teo_description.robot import Robot
from teo_sign_authoring.alphabet.letter_clips import load_letter_clips
from teo_sign_capture.entries.take import capture_take
from teo_sign_capture.recordings.recording import open_recording, track_of
from teo_sign_capture.retarget.arm_kinematics import ArmKinematics, arm_bounds
from teo_sign_capture.retarget.hand_goals import HandGoals, before_folded_arm
from teo_sign_languages import DEFAULT_LANGUAGE, load_language

COUNT = 200


@pytest.fixture(scope="module")
def robot():
    return Robot.load()


@pytest.fixture(scope="module")
def chain(robot):
    return ArmKinematics(robot)


def goals_of(poses, local, contact):
    return HandGoals.without_arm(
        local=local,
        place=poses.points(local),
        contact=np.full(len(local), contact),
        palm=poses.rotation[:, :, 2],
        fingers=poses.rotation[:, :, 0],
    )


def test_what_an_arm_has_reached_stays_where_it_is(chain):
    random = np.random.default_rng(0)
    arms = random.uniform(*arm_bounds(load_humanoid(), "both"), (COUNT, 6))
    goals = goals_of(chain.poses(arms), random.uniform(-0.1, 0.1, (COUNT, 3)), 0.0)
    assert before_folded_arm(chain, goals).place == pytest.approx(goals.place, abs=1e-9)


def test_what_is_too_near_goes_forwards_as_far_as_a_folded_arm_and_a_touch_stays(chain):
    random = np.random.default_rng(1)
    arms = random.uniform(*arm_bounds(load_humanoid(), "both"), (COUNT, 6))
    arms[:, 3] = np.radians(random.uniform(-150.0, -105.0, COUNT))  # as a person's elbow closes
    poses = chain.poses(arms)
    local = np.zeros((COUNT, 3))
    moved = before_folded_arm(chain, goals_of(poses, local, 0.0)).place - poses.place
    assert (moved[:, 0] > 0.0).all()
    assert moved[:, 1:] == pytest.approx(0.0, abs=1e-12)
    arms[:, 3] = arm_bounds(load_humanoid(), "both")[0][3]
    folded = np.linalg.norm(chain.poses(arms).origins[:, 5] - chain.shoulder, axis=1)
    wrists = poses.origins[:, 5] + moved
    assert np.linalg.norm(wrists - chain.shoulder, axis=1) == pytest.approx(folded, abs=1e-9)
    assert before_folded_arm(chain, goals_of(poses, local, 1.0)).place == pytest.approx(poses.place)


def test_a_letter_held_beside_the_shoulder_stands_up(robot, tmp_path: Path):
    folder = Path(str(resources.files("spoken_to_signed"))) / "assets" / "fingerspelling_lexicon" / "ssp"
    clip = open_recording(folder / load_letter_clips(load_language(DEFAULT_LANGUAGE))["L"].file)
    motion = capture_take(robot, track_of(clip, cache=tmp_path)[0]).motion
    # An L that is tilted by half a right angle is read as another letter.
    assert np.degrees(np.nanmax(motion.finger_error)) < 45.0
    assert np.degrees(np.nanmax(motion.palm_error)) < 45.0
    assert not np.nansum(motion.wrong_place)
