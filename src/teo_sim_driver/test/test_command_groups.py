# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Limbs commanded by themselves: the newest command wins, joint by joint."""

import numpy as np
import pytest
from rclpy.serialization import serialize_message

from driver_messages import trajectory_message
from teo_description.humanoid import load_humanoid
from teo_names import COMMANDED_JOINTS
from teo_sim_driver.checking.validation import check
from teo_sim_driver.follower_report import Mode, Source
from teo_sim_driver.motion.path_time import SECOND
from teo_sim_driver.rules import Rules, TrajectoryError, joint_groups

START = 1_700_000_000 * SECOND
PERIOD = 10_000_000
LEFT, RIGHT = "FrontalLeftElbow", "FrontalRightElbow"
GROUPS = {group.name: group for group in joint_groups(load_humanoid())}


def column(joint):
    return COMMANDED_JOINTS.index(joint)


class Robot:
    """A follower, its clock, and everything that it was told to do."""

    def __init__(self, follower, home):
        self.follower, self.home, self.now = follower, home, START
        self.states = []

    def send(self, group, joint, angle, duration=3.0, stamp=0, cubic=False):
        joints = GROUPS[group].joints
        goal = [self.home[column(name)] + (angle if name == joint else 0.0) for name in joints]
        still = np.zeros((1, len(joints)))
        message = trajectory_message(joints, [duration], [goal], still, None if cubic else still, stamp=stamp)
        points = check(serialize_message(message), limits=self.follower.limits, rules=Rules(), group=joints)
        return self.follower.take(points, self.now, Source.TOPIC, group)

    def run(self, seconds):
        for _ in range(round(seconds * SECOND / PERIOD)):
            self.now += PERIOD
            self.states.append(self.follower.step(self.now))
        return np.array([state.positions for state in self.states[-round(seconds * 100) :]])

    def at(self, joint):
        return self.states[-1].positions[column(joint)]


@pytest.fixture
def robot(new_follower, home):
    return Robot(new_follower(), home)


def test_two_limbs_move_at_once_each_as_it_would_alone_to_its_own_end(robot, new_follower, home):
    left = robot.send("left_arm", LEFT, -0.5)
    robot.run(0.37)
    right = robot.send("right_arm", RIGHT, -0.7, duration=4.0, cubic=True)
    both = robot.run(3.0)
    assert left.over
    assert not right.over
    assert robot.follower.report().commands == ("right_arm topic",)
    robot.run(2.0)
    alone, beside = Robot(new_follower(), home), Robot(new_follower(), home)
    alone.send("left_arm", LEFT, -0.5)
    alone.run(0.37)
    beside.run(0.37)
    beside.send("right_arm", RIGHT, -0.7, duration=4.0, cubic=True)
    for joint, single in ((LEFT, alone), (RIGHT, beside)):
        np.testing.assert_allclose(both[:, column(joint)], single.run(3.0)[:, column(joint)], atol=1e-9)
    assert (robot.at(LEFT), robot.at(RIGHT)) == (home[column(LEFT)] - 0.5, home[column(RIGHT)] - 0.7)
    assert right.over
    assert (left.preempted_by, right.preempted_by) == (None, None)
    assert robot.follower.mode is Mode.HOLDING


def test_of_a_command_that_loses_joints_the_others_slow_down_and_hold(robot, limits, home):
    whole = robot.send("", RIGHT, -0.9)
    robot.run(1.5)
    moving = robot.states[-1]
    newer = robot.send("left_arm", LEFT, -0.5)
    assert whole.over
    assert whole.preempted_by is newer
    robot.run(4.0)
    right = np.array([state.positions[column(RIGHT)] for state in robot.states])
    assert moving.velocities[column(RIGHT)] < -0.3
    stopped_at = right[-1]
    assert home[column(RIGHT)] - 0.9 < stopped_at < moving.positions[column(RIGHT)]
    assert (right[150 + 25 :] == stopped_at).all()  # within a quarter of a second
    assert robot.at(LEFT) == home[column(LEFT)] - 0.5
    steps = np.diff([state.positions for state in robot.states], axis=0)
    assert (np.abs(steps) <= limits.velocity * 0.01 * 1.001).all()
    assert np.abs(np.diff(steps, axis=0)).max() / 0.01**2 < 5.2 + 2.5  # the stop's, and the paths' own


def test_one_limb_is_cancelled_while_the_other_goes_on(robot):
    left, right = robot.send("left_arm", LEFT, -0.5), robot.send("right_arm", RIGHT, -0.5)
    robot.run(1.5)
    remaining = robot.follower.cancel(robot.now, left)
    assert 0.0 < remaining < 0.25
    robot.run(remaining + 0.02)
    assert left.over
    stopped_at = robot.at(LEFT)
    robot.run(2.0)
    assert robot.at(LEFT) == stopped_at
    assert robot.at(RIGHT) == robot.home[column(RIGHT)] - 0.5
    assert right.preempted_by is None


def test_a_limb_cancelled_in_a_pause_is_over_at_once(robot):
    left, right = robot.send("left_arm", LEFT, -0.5), robot.send("right_arm", RIGHT, -0.5)
    robot.run(1.0)
    robot.follower.pause(robot.now)
    robot.run(0.5)
    where = robot.at(LEFT)
    robot.follower.cancel(robot.now, left)
    robot.run(0.01)
    assert left.over
    assert not right.over
    robot.follower.resume(robot.now)
    robot.run(3.0)
    assert robot.at(LEFT) == pytest.approx(where, abs=1e-12)
    assert robot.at(RIGHT) == robot.home[column(RIGHT)] - 0.5


def test_random_commands_of_limbs_and_body_break_no_limit_and_never_step(robot, limits):
    rng = np.random.default_rng(5)
    home, taken = robot.home, 0
    for _ in range(150):
        name = str(rng.choice(list(GROUPS)))
        joints = GROUPS[name].joints
        columns = [column(joint) for joint in joints]
        away = rng.uniform(0.0, 0.3, len(joints))
        away = np.where(home[columns] + away <= limits.upper[columns], away, -away)
        still = np.zeros((1, len(joints)))
        message = trajectory_message(
            joints,
            [rng.uniform(1.5, 4.0)],
            [np.clip(home[columns] + away, limits.lower[columns], None)],
            still,
            still,
        )
        points = check(serialize_message(message), limits=limits, rules=Rules(), group=joints)
        try:
            command = robot.follower.take(points, robot.now, Source.ACTION, name)
        except TrajectoryError as refusal:
            assert refusal.code in {"start_leaves_limits", "start_too_fast"}
            continue
        taken += 1
        if rng.random() < 0.3:
            robot.run(0.2)
            robot.follower.cancel(robot.now, command)
            robot.run(0.3)  # a lone command's stop takes nothing new
        robot.run(rng.choice([0.01, 0.1, 0.5, 2.0]))
    assert taken > 100
    positions = np.array([state.positions for state in robot.states])
    velocities = np.array([state.velocities for state in robot.states])
    assert (positions >= limits.lower - 1.5e-5).all()
    assert (positions <= limits.upper + 1.5e-5).all()
    assert (np.abs(velocities) <= limits.velocity * 1.001).all()
    # Nobody's word for it: what is sent moves as it says.
    moved = np.diff(positions, axis=0) / 0.01
    assert np.abs(moved - 0.5 * (velocities[1:] + velocities[:-1])).max() < 0.02
    assert robot.follower.report().limited_steps == 0


def test_until_a_scheduled_limb_starts_all_goes_on(robot):
    robot.send("", RIGHT, -0.5)
    robot.run(0.5)
    robot.send("left_arm", LEFT, -0.5, stamp=robot.now + SECOND)
    positions = robot.run(1.0)
    assert (np.diff(positions[:, column(RIGHT)]) < 0.0).all()
    assert np.abs(positions[:, column(LEFT)] - robot.home[column(LEFT)]).max() < 1e-12
    robot.run(4.0)
    assert robot.at(LEFT) == robot.home[column(LEFT)] - 0.5
    assert robot.at(RIGHT) > robot.home[column(RIGHT)] - 0.5


def test_stop_stops_every_limb(robot):
    left, right = robot.send("left_arm", LEFT, -0.5), robot.send("right_arm", RIGHT, -0.5)
    robot.run(1.0)
    remaining = robot.follower.block(Mode.STOPPED, "stopped", robot.now)
    robot.run(remaining + 0.02)
    assert left.over
    assert right.over
    assert not robot.states[-1].velocities.any()
