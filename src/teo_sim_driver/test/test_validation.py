# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Each reason for which a trajectory is refused, by a good message with one thing wrong."""

import numpy as np
import pytest
from builtin_interfaces.msg import Duration, Time
from rclpy.serialization import serialize_message

from driver_messages import trajectory_message
from teo_names import LEG_JOINTS
from teo_sim_driver.checking.scheduling import schedule
from teo_sim_driver.checking.validation import check as check_message
from teo_sim_driver.motion.trajectory import MotionState
from teo_sim_driver.rules import Rules, TrajectoryError

NOW = 1_000_000_000_000  # [ns]
ELBOW = "FrontalRightElbow"


@pytest.fixture
def check(limits, home):
    def check(message, *, state=None, rules=None):
        where = state or MotionState.at_rest(home)
        given = {"limits": limits, "rules": rules or Rules()}
        points = check_message(serialize_message(message), held=LEG_JOINTS, **given)
        return schedule(points, now=NOW, state_in=lambda _: where, **given)

    return check


@pytest.fixture
def refused(check):
    def refused(message, **arguments):
        with pytest.raises(TrajectoryError) as caught:
            check(message, **arguments)
        return caught.value

    return refused


def put(message, point, field, column, value):
    values = list(getattr(message.points[point], field))
    values[column] = value
    setattr(message.points[point], field, values)


def change(field, value, point=3):
    return lambda message: setattr(message.points[point], field, value)


def put_time(seconds, nanoseconds, point=3):
    return change("time_from_start", Duration(sec=seconds, nanosec=nanoseconds), point)


def put_value(field, value, point=3, column=5):
    return lambda message: put(message, point, field, column, value)


def names(changed):
    return lambda message: setattr(message, "joint_names", changed(list(message.joint_names)))


def take_joints(message, columns):
    message.joint_names = [message.joint_names[i] for i in columns]
    for point in message.points:
        for field in ("positions", "velocities", "accelerations"):
            setattr(point, field, [getattr(point, field)[i] for i in columns])


def stamp(seconds, nanoseconds):
    return lambda message: setattr(message.header, "stamp", Time(sec=seconds, nanosec=nanoseconds))


WRONG = {
    "no names": (names(lambda _: []), "no_joints"),
    "a name of no joint": (names(lambda n: ["Elbow", *n[1:]]), "unknown_joint"),
    "a phalanx, led by its tendon": (names(lambda n: ["RightIndexFingerMiddle", *n[1:]]), "unknown_joint"),
    "a leg": (names(lambda n: ["FrontalLeftKnee", *n[1:]]), "held_joint"),
    "a name twice": (names(lambda n: [n[1], *n[1:]]), "duplicate_joint"),
    "a joint left out": (lambda m: take_joints(m, range(27)), "missing_joints"),
    "no points": (lambda m: setattr(m, "points", []), "no_points"),
    "too many points": (lambda m: setattr(m, "points", m.points * 1000), "too_many_points"),
    "no positions": (change("positions", []), "wrong_length"),
    "too many velocities": (change("velocities", [0.0] * 29), "wrong_length"),
    "too few accelerations": (change("accelerations", [0.0]), "wrong_length"),
    "accelerations alone": (change("velocities", []), "accelerations_without_velocities"),
    "effort": (change("effort", [0.0] * 28), "effort_given"),
    "nanoseconds over a second": (put_time(0, 1_000_000_000), "bad_time"),
    "a stamp with nanoseconds over a second": (stamp(5, 4_000_000_000), "bad_time"),
    "a negative time": (put_time(-1, 0, point=0), "negative_time"),
    "a time twice": (put_time(0, 300_000_000), "times_not_increasing"),
    "a time that goes back": (put_time(0, 1), "times_not_increasing"),
    "an absurd duration": (put_time(2**31 - 1, 0, point=-1), "too_long"),
    "an end that has passed": (stamp(*divmod(NOW - 4_000_000_001, 10**9)), "ends_in_the_past"),
    "a negative stamp": (stamp(-5, 0), "ends_in_the_past"),
    "a start in an hour": (stamp(*divmod(NOW + 3600 * 10**9, 10**9)), "starts_too_late"),
    "a position that is no number": (put_value("positions", float("nan")), "not_finite"),
    "a velocity that is no number": (put_value("velocities", float("nan")), "not_finite"),
    "an infinite acceleration": (put_value("accelerations", float("inf")), "not_finite"),
    "a position outside the limits": (put_value("positions", -3.0), "position_limit"),
    "a velocity over the limit": (put_value("velocities", 0.9), "velocity_limit"),
    "a velocity at the end": (put_value("velocities", 0.01, point=-1), "moving_at_end"),
    "a jump between points": (put_value("positions", 0.5), "speed_between_points"),
    "a huge acceleration": (put_value("accelerations", 1e308), "velocity_between_points"),
    "a jump at the start": (
        lambda m: [put(m, i, "positions", 13, -0.3) for i in range(len(m.points))],
        "start_too_fast",
    ),
    "a first point due at once and elsewhere": (
        lambda m: (
            put(m, 0, "positions", 13, -0.05),
            setattr(m.points[0], "time_from_start", Duration(sec=0, nanosec=0)),
        ),
        "start_mismatch",
    ),
}


@pytest.mark.parametrize(("mutate", "code"), WRONG.values(), ids=WRONG.keys())
def test_a_good_message_with_one_thing_wrong_is_refused_for_that_reason(mutate, code, swing, check, refused):
    check(swing())
    message = swing()
    mutate(message)
    refusal = refused(message)
    assert refusal.code == code
    assert len(refusal.sentence) > 20


def test_names_may_come_in_any_order(swing, check):
    message = swing()
    take_joints(message, np.random.default_rng(0).permutation(28))
    shuffled, straight = check(message).trajectory, check(swing()).trajectory
    np.testing.assert_array_equal(shuffled.positions, straight.positions)
    np.testing.assert_array_equal(shuffled.accelerations, straight.accelerations)


def test_a_close_name_is_proposed(swing, refused):
    message = swing()
    message.joint_names = ["FrontalRightElbov" if name == ELBOW else name for name in message.joint_names]
    assert "did you mean 'FrontalRightElbow'?" in refused(message).sentence


def test_a_motion_of_another_robot_is_refused_with_what_to_do(swing, refused):
    message = swing()
    message.joint_names = [f"right_{name}_joint" for name in message.joint_names]
    assert "parameter robot that it was made for" in refused(message).sentence


def test_a_name_of_a_megabyte_is_not_repeated_in_full(swing, refused):
    message = swing()
    message.joint_names[0] = "x" * 1_000_000
    assert len(refused(message).sentence) < 2000


def test_a_cubic_that_swings_out_of_the_limits_between_good_points_is_refused(limits, home, refused):
    elbow = limits.names.index("FrontalNeck")  # -10 .. 10 deg
    positions = np.tile(home, (3, 1))
    positions[:, elbow] = [limits.upper[elbow] - 0.01, limits.upper[elbow] - 0.01, 0.0]
    velocities = np.zeros((3, 28))
    velocities[0, elbow], velocities[1, elbow] = 0.5, -0.5
    refusal = refused(trajectory_message(limits.names, [1.0, 1.5, 3.0], positions, velocities))
    assert refusal.code == "position_between_points"
    assert "between points 0 and 1" in refusal.sentence
    assert "FrontalNeck" in refusal.sentence


def test_a_quintic_that_is_too_fast_between_slow_points_is_refused(limits, home, refused):
    elbow = limits.names.index(ELBOW)
    positions = np.tile(home, (2, 1))
    positions[1, elbow] = -0.8  # in 1 s: 0.8 rad/s on average, and 1.5 rad/s in the middle
    zeros = np.zeros((2, 28))
    message = trajectory_message(limits.names, [1.0, 2.0], positions, zeros, zeros)
    refusal = refused(message)
    assert refusal.code == "velocity_between_points"
    assert "between points 0 and 1" in refusal.sentence


def test_the_way_to_the_first_point_must_stay_within_the_limits(limits, home, refused):
    neck = limits.names.index("FrontalNeck")
    where = home.copy()
    where[neck] = limits.upper[neck]
    moving = np.zeros(28)
    moving[neck] = 0.5
    state = MotionState(where, moving, np.zeros(28))
    message = trajectory_message(limits.names, [1.0], home[None], np.zeros((1, 28)))
    assert refused(message, state=state).code == "start_leaves_limits"


def test_a_first_point_due_at_once_is_taken_as_where_the_robot_is(limits, home, check):
    positions = np.tile(home, (2, 1))
    positions[0] += 0.005  # within the tolerance, and at the fingers' lower limit inside
    positions[1] = home
    scheduled = check(trajectory_message(limits.names, [0.0, 1.0], positions))
    np.testing.assert_array_equal(scheduled.trajectory.positions[0], home)
    assert scheduled.trajectory.duration == 1.0


def test_a_single_point_due_at_once_where_the_robot_rests_is_a_hold(limits, home, check):
    assert check(trajectory_message(limits.names, [0.0], home[None])).trajectory.duration == 0.0


def test_a_single_point_due_at_once_cannot_stop_a_moving_robot(limits, home, refused):
    moving = MotionState(home, np.full(28, 0.1), np.zeros(28))
    refusal = refused(trajectory_message(limits.names, [0.0], home[None]), state=moving)
    assert refusal.code == "start_mismatch"


def test_what_is_past_is_dropped_and_the_rest_keeps_its_time(swing, check):
    scheduled = check(swing(stamp=NOW - 250_000_000))
    assert scheduled.delay == 0.0
    np.testing.assert_allclose(scheduled.trajectory.times, [0.0, *np.arange(0.05, 3.76, 0.1)])


def test_a_late_message_for_a_robot_that_is_elsewhere_is_refused(limits, home, swing, refused):
    elsewhere = home.copy()
    elsewhere[limits.names.index(ELBOW)] = -1.0
    refusal = refused(swing(stamp=NOW - 250_000_000), state=MotionState.at_rest(elsewhere))
    assert refusal.code == "start_mismatch"


def test_a_point_of_a_late_message_that_is_due_at_once_is_passed(limits, swing, check):
    message = swing(stamp=NOW - 299_600_000)
    due = message.points[2]  # in 0.4 ms, in which 2 mrad cannot be made good
    beside = np.array(due.positions)
    beside[limits.names.index(ELBOW)] += 0.002
    state = MotionState(beside, np.array(due.velocities), np.array(due.accelerations))
    np.testing.assert_allclose(check(message, state=state).trajectory.times[:2], [0.0, 0.1004])


def test_joints_may_be_left_out_where_the_parameter_allows_it(check):
    rules = Rules(allow_partial_joints_goal=True)
    message = trajectory_message([ELBOW], [1.0], [[-0.3]], [[0.0]])
    assert check(message, rules=rules).trajectory.positions[-1].tolist() == [-0.3]
