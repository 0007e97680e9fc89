# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
import rclpy
from control_msgs.action import FollowJointTrajectory
from control_msgs.msg import SpeedScalingFactor
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from rclpy.action import ActionClient
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.serialization import deserialize_message, serialize_message
from sensor_msgs.msg import JointState
from simulated_clock import SECOND, SimulatedClock
from std_msgs.msg import Float64MultiArray, String
from std_srvs.srv import Trigger
from teo_sign_msgs.msg import DriverState
from trajectory_msgs.msg import JointTrajectory

from teo_names import ALL_JOINTS, HOME, LEG_JOINTS, urdf_text
from teo_sim_driver.node.driver_node import DriverNode
from teo_sim_driver.rules import DriverError

PERIOD = 0.01  # [s] of the driver's steps
MESSAGES = 3  # of many points, one after the other

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def test_a_bad_trajectory_is_refused_with_its_reason_and_a_good_one_then_reaches_its_goal(bench, one_way):
    first = bench.states[0]
    assert tuple(first.name) == ALL_JOINTS
    np.testing.assert_array_equal(first.position, [HOME[name] for name in ALL_JOINTS])
    assert list(first.velocity) == [0.0] * 40
    assert list(first.effort) == []

    bad = one_way(duration=2.0, angle=-0.2)
    bad.points[4].positions[7] = float("nan")
    bad.header.frame_id = "the bad one"
    bench.commands.publish(bad)
    bench.until(lambda: bench.diagnostics and bench.said("last refusal code") == "not_finite")
    assert "FrontalLeftElbow" in bench.said("last refusal")
    bench.until(lambda: list(bench.driver_states[-1].refused_frame_ids) == ["the bad one"])
    assert bench.diagnostics[-1].status[0].level == b"\x01"

    good = one_way(duration=2.0, angle=-0.2)
    del bench.states[1:]
    bench.commands.publish(good)
    goal = good.points[-1].positions[13]
    bench.until(lambda: abs(bench.position("FrontalRightElbow") - goal) < 1e-9)
    bench.until(lambda: not any(bench.states[-1].velocity))
    np.testing.assert_allclose(bench.states[-1].position[:28], good.points[-1].positions, atol=1e-12)
    assert list(bench.states[-1].position[28:]) == [HOME[name] for name in LEG_JOINTS]

    stamps = np.array([s.header.stamp.sec + s.header.stamp.nanosec * 1e-9 for s in bench.states])
    motion = np.array([s.position for s in bench.states])
    assert (np.diff(stamps) > 0.0).all()
    assert (np.abs(np.diff(motion, axis=0)).max(axis=1) <= 0.8727 * np.diff(stamps) + 1e-4).all()
    bench.until(lambda: bench.said("state") == "holding" and bench.said("accepted") != "0")
    assert bench.said("limited steps") == "0"


def test_a_late_subscriber_gets_the_robot_description_and_what_the_hands_are_told(bench, one_way):
    heard, hands = [], []
    bench.client.create_subscription(String, "robot_description", heard.append, LATCHED)
    bench.client.create_subscription(Float64MultiArray, "dextra_setpoints", hands.append, LATCHED)
    bench.until(lambda: heard and hands)
    assert heard[0].data == urdf_text()
    at_home = [0.0, 10.0 / 3.0, 0.0, 0.0, 0.0, 0.0] * 2
    np.testing.assert_allclose(hands[0].data, at_home, atol=1e-9)
    assert [dimension.size for dimension in hands[0].layout.dim] == [2, 6]
    bench.commands.publish(one_way(joint="RightIndexFinger", angle=np.radians(39.0), duration=4.0))
    bench.until(lambda: abs(hands[-1].data[8] - 10.0) < 1e-9)  # half of its tendon's way
    np.testing.assert_allclose(np.delete(np.subtract(hands[-1].data, at_home), 8), 0.0, atol=1e-9)


def test_told_to_stop_it_comes_to_rest_on_the_way_and_takes_nothing_until_re_armed(bench, one_way):
    gently = {"stop_deceleration": 0.2, "stop_jerk": 1.0}  # on a busy machine too it is not at rest too soon
    bench.driver.set_parameters([Parameter(name, value=value) for name, value in gently.items()])
    bench.commands.publish(one_way(duration=6.0, angle=-1.0))
    bench.until(lambda: bench.position("FrontalRightElbow") < -0.05)
    answer = bench.call("stop")
    assert answer.success
    assert "at rest in" in answer.message
    rearmed = bench.triggers["rearm"].call_async(Trigger.Request())  # waits until it stands
    bench.until(lambda: bench.driver._operator._waiting)
    assert bench.call("stop").success, "which another stop ends"
    bench.until(rearmed.done)
    assert rearmed.result().message.startswith("stopped_again")
    bench.until(lambda: not any(bench.states[-1].velocity))
    where = bench.position("FrontalRightElbow")
    assert -0.9 < where < -0.05
    bench.until(lambda: bench.mode() == DriverState.MODE_STOPPED and bench.driver_states[-1].at_rest)

    home = one_way(duration=1.0, angle=0.0)  # a way back to home
    for point in home.points:
        point.time_from_start.sec += 3
    bench.commands.publish(home)
    bench.until(lambda: bench.driver_states[-1].refusal_code == "stopped")
    assert bench.position("FrontalRightElbow") == where
    instead = bench.call("resume")
    assert not instead.success
    assert "`rearm`" in instead.message
    assert bench.call("rearm").success
    bench.until(lambda: bench.mode() == DriverState.MODE_HOLDING)
    bench.commands.publish(home)
    bench.until(lambda: bench.position("FrontalRightElbow") > where + 0.05)
    assert bench.call("stop").success and bench.call("rearm").success, "at once, when it is at rest"
    bench.until(lambda: bench.mode() == DriverState.MODE_HOLDING and bench.driver_states[-1].at_rest)


def test_a_pause_and_a_slower_speed_keep_to_the_path(bench, one_way):
    factors = bench.client.create_publisher(SpeedScalingFactor, "speed_scaling_input", 1)
    bench.until(factors.get_subscription_count)
    bench.commands.publish(one_way(duration=2.0, angle=-0.2))
    bench.until(lambda: bench.position("FrontalRightElbow") < -0.02)
    assert bench.call("pause").success
    bench.until(lambda: not any(bench.states[-1].velocity))
    bench.until(lambda: bench.mode() == DriverState.MODE_PAUSED and bench.driver_states[-1].at_rest)
    assert bench.position("FrontalRightElbow") > -0.19
    assert bench.driver_states[-1].source == DriverState.SOURCE_TOPIC
    bench.commands.publish(one_way(duration=2.0, angle=-0.2))
    bench.until(lambda: bench.driver_states[-1].refusal_code == "paused")

    factors.publish(SpeedScalingFactor(factor=-1.0))  # ignored
    factors.publish(SpeedScalingFactor(factor=0.5))
    assert bench.call("resume").success
    bench.until(lambda: bench.driver_states[-1].speed_scaling == 0.5)
    bench.until(lambda: abs(bench.position("FrontalRightElbow") + 0.2) < 1e-9)
    assert not bench.call("resume").success
    factors.publish(SpeedScalingFactor(factor=0.0))
    bench.until(lambda: bench.mode() == DriverState.MODE_PAUSED)
    answer = bench.call("resume")
    assert not answer.success
    for said in (answer.message, bench.driver_states[-1].message):
        assert "`speed_scaling_input`" in said and "`resume`" not in said


def test_it_moves_only_while_its_lifecycle_is_active(new_bench, one_way):
    bench = new_bench(parameter_overrides=[Parameter("autostart", value=False)])

    def change(transition):
        answer = changes.call_async(ChangeState.Request(transition=Transition(id=transition)))
        bench.until(answer.done)
        return answer.result().success

    changes = bench.client.create_client(ChangeState, "teo_sim_driver/change_state")
    bench.until(changes.service_is_ready)
    bench.until(lambda: bench.mode() == DriverState.MODE_INACTIVE)
    bench.commands.publish(one_way())
    bench.until(lambda: bench.driver_states[-1].refusal_code == "inactive")
    assert change(Transition.TRANSITION_CONFIGURE)
    assert change(Transition.TRANSITION_ACTIVATE)
    bench.until(lambda: bench.mode() == DriverState.MODE_HOLDING)
    bench.commands.publish(one_way(duration=4.0, angle=-0.5))
    bench.until(lambda: bench.position("FrontalRightElbow") < -0.05)
    assert change(Transition.TRANSITION_DEACTIVATE)
    bench.until(lambda: bench.mode() == DriverState.MODE_INACTIVE and bench.driver_states[-1].at_rest)
    bench.until(lambda: not any(bench.states[-1].velocity))  # the other topic may come later
    assert bench.position("FrontalRightElbow") > -0.5


def test_a_joint_that_does_not_follow_is_a_fault_and_afterwards_held_where_it_is(bench, one_way):
    def inject(**faults):
        result = bench.driver.set_parameters(
            [Parameter(f"fault_{name}", value=value) for name, value in faults.items()]
        )
        return all(each.successful for each in result)

    assert not inject(frozen="NoSuchJoint")
    assert inject(frozen="FrontalRightElbow")
    bench.commands.publish(one_way(duration=4.0, angle=-0.5))
    bench.until(lambda: bench.mode() == DriverState.MODE_FAULT and bench.driver_states[-1].at_rest)
    assert "FrontalRightElbow does not follow" in bench.driver_states[-1].message
    assert bench.position("FrontalRightElbow") == HOME["FrontalRightElbow"]
    bench.until(lambda: bench.diagnostics and bench.diagnostics[-1].status[0].level == b"\x02")
    del bench.states[:]
    assert inject(frozen="")
    bench.until(lambda: len(bench.states) > 20)
    assert bench.call("rearm").success
    bench.until(lambda: bench.mode() == DriverState.MODE_HOLDING)
    elbow = bench.states[0].name.index("FrontalRightElbow")
    went = {state.position[elbow] for state in bench.states}
    assert went == {HOME["FrontalRightElbow"]}, "freed, it does not set out for where it was told to be"

    assert inject(limit_switches="AxialNeck, AxialTrunk")
    bench.until(lambda: bench.mode() == DriverState.MODE_FAULT)
    assert "AxialNeck, AxialTrunk" in bench.driver_states[-1].message
    assert not bench.call("rearm").success
    assert inject(limit_switches="")
    assert bench.call("rearm").success


def test_messages_and_goals_of_many_points_do_not_stop_the_joint_states(context, one_way):
    driver = subprocess.Popen(
        [sys.executable, "-c", "from teo_sim_driver.node.driver_node import main; main()"],
        stderr=subprocess.DEVNULL,
    )
    heard: list[JointState] = []
    refusals: list[DriverState] = []
    client = rclpy.create_node("client", context=context)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(client)
    client.create_subscription(JointState, "joint_states", heard.append, 1000)
    client.create_subscription(DriverState, "driver_state", refusals.append, LATCHED)
    commands = client.create_publisher(JointTrajectory, "joint_trajectory", 10)

    def until(condition):
        deadline = time.monotonic() + 30.0
        while not condition():
            assert time.monotonic() < deadline, "it did not happen in time"
            executor.spin_once(timeout_sec=0.1)

    def longest_gap():
        stamps = [state.header.stamp.sec + state.header.stamp.nanosec * 1e-9 for state in heard]
        return np.diff(stamps).max()

    def objects_made():
        """How long this machine now takes to make objects of the message alone [s]."""
        begin = time.monotonic()
        deserialize_message(data, JointTrajectory)
        return time.monotonic() - begin

    try:
        until(lambda: heard and refusals and commands.get_subscription_count())
        message = one_way(duration=2.0, angle=-0.2)
        first = message.points[0]
        message.points = [first] * 20_000
        data = serialize_message(message)
        # What a message makes wait waits at each; another process takes the processor now and then.
        share = []
        for refused in range(1, 1 + MESSAGES):
            as_objects = objects_made()
            executor.spin_once(timeout_sec=0.0)
            heard.clear()
            commands.publish(data)
            until(lambda refused=refused: refusals[-1].refused == refused)
            assert refusals[-1].refusal_code == "times_not_increasing"
            until(lambda: len(heard) > 20)
            share.append(longest_gap() / max(0.5 * as_objects, 0.05))
        assert min(share) < 1.0
        # The same as a goal; its points alone, as objects, take longer than this.
        goals = ActionClient(client, FollowJointTrajectory, "follow_joint_trajectory")
        until(goals.server_is_ready)
        share = []
        for refused in range(1 + MESSAGES, 1 + 2 * MESSAGES):
            as_objects = objects_made()
            answer = goals.send_goal_async(FollowJointTrajectory.Goal(trajectory=message))
            heard.clear()
            until(lambda refused=refused: refusals[-1].refused == refused)
            until(lambda: len(heard) > 20)
            until(answer.done)
            share.append(longest_gap() / max(as_objects, 0.1))
        assert min(share) < 1.0
    finally:
        driver.send_signal(signal.SIGINT)
        driver.wait()
        executor.shutdown()
        client.destroy_node()


def test_a_fault_of_its_own_is_reported_and_does_not_end_it(bench, one_way, monkeypatch):
    def fault(*_, **__):
        raise ZeroDivisionError("on purpose")

    with monkeypatch.context() as patch:
        patch.setattr("teo_sim_driver.checking.validation.check", fault)
        bench.commands.publish(one_way())
        bench.until(lambda: bench.diagnostics and bench.said("last refusal code") == "internal")
    assert "on purpose" in bench.said("last refusal")
    bench.commands.publish(one_way())
    bench.until(lambda: bench.position("FrontalRightElbow") < -0.01)


def test_a_parameter_out_of_range_is_refused_and_a_good_one_takes_effect(bench, one_way):
    def set_to(name, value):
        return bench.driver.set_parameters([Parameter(name, value=value)])[0].successful

    assert not set_to("start_tolerance", 1.0)
    assert not set_to("stop_deceleration", float("nan"))
    assert not set_to("update_rate", 50)
    assert set_to("max_points", 5)
    bench.commands.publish(one_way())
    bench.until(lambda: bench.diagnostics and bench.said("last refusal code") == "too_many_points")


def test_parameters_of_the_start_choose_plant_hand_and_rate(new_bench, one_way):
    given = {"plant": "mujoco", "hand_drive": "spool_1000", "update_rate": 50}
    bench = new_bench(parameter_overrides=[Parameter(name, value=value) for name, value in given.items()])
    # Four fifths of what a finger does by default.
    bench.commands.publish(one_way(joint="RightIndexFinger", angle=np.radians(39.0), duration=3.4))
    bench.until(lambda: bench.diagnostics and bench.said("last refusal code") == "velocity_limit")
    assert "RightIndexFinger" in bench.said("last refusal")
    del bench.states[:]
    begin = time.monotonic()
    bench.commands.publish(one_way(duration=2.0, angle=-0.2))
    bench.until(lambda: len(bench.states) > 25)
    assert time.monotonic() - begin > 0.45
    bench.until(lambda: abs(bench.position("FrontalRightElbow") + 0.2) < 0.005)
    assert bench.position("FrontalRightElbow") != -0.2, "nobody with mass is where he was told to be"
    bench.until(lambda: bench.mode() == DriverState.MODE_HOLDING)


def test_a_plant_that_is_not_known_is_refused(context):
    with pytest.raises(DriverError, match="unknown_plant"):
        DriverNode(context=context, parameter_overrides=[Parameter("plant", value="gazebo")])


@pytest.fixture
def clock(context):
    clock = SimulatedClock(context, rate=2.5)
    yield clock
    clock.close()


def stamp(state):
    return state.header.stamp.sec * SECOND + state.header.stamp.nanosec


def test_by_a_simulators_clock_the_path_is_executed_in_simulated_time(clock, new_bench, one_way):
    elbow = ALL_JOINTS.index("FrontalRightElbow")
    bench = new_bench(parameter_overrides=[Parameter("use_sim_time", value=True)])
    trajectory = one_way(duration=2.0, angle=-0.4)
    start = clock.now + SECOND
    trajectory.header.stamp.sec, trajectory.header.stamp.nanosec = divmod(start, SECOND)
    bench.commands.publish(trajectory)
    bench.until(lambda: bench.states[-1].position[elbow] < -0.1)
    clock.pause()
    for _ in range(10):
        bench.executor.spin_once(timeout_sec=0.02)
    heard = len(bench.states)
    for _ in range(10):
        bench.executor.spin_once(timeout_sec=0.02)
    assert len(bench.states) == heard  # no time passes, nothing moves
    clock.go_on()
    bench.until(lambda: bench.states[-1].position[elbow] == -0.4)
    # Where the elbow is says nothing but the stamp: the curve that was sent, in closed form.
    # On a busy machine steps are late, and the elbow is behind it by what they were late together at most.
    times = np.array([(stamp(state) - start) / SECOND for state in bench.states])
    lateness = np.cumsum(np.maximum(np.diff(times, prepend=times[0]) - PERIOD, 0.0))
    early, late = (np.clip(times - behind, 0.0, 1.0) / 2.0 for behind in (PERIOD + lateness, 0.0))
    least, most = (-0.4 * (4.0 * u * (1.0 - u)) ** 3 for u in (late, early))
    positions = np.array([state.position[elbow] for state in bench.states])
    assert (positions >= least - 1e-4).all() and (positions <= most + 1e-4).all()
    assert len(np.unique(positions)) > 10


def test_states_that_are_lost_or_late_are_seen_so(bench, one_way):
    def inject(name, value):
        assert bench.driver.set_parameters([Parameter(name, value=value)])[0].successful

    inject("fault_state_delay", 0.2)
    del bench.states[:]
    bench.until(lambda: len(bench.states) > 3)
    now = bench.driver.get_clock().now().nanoseconds
    stamp = bench.states[-1].header.stamp
    assert now - (stamp.sec * 10**9 + stamp.nanosec) > 0.18e9
    inject("fault_state_loss", 1.0)
    bench.commands.publish(one_way())
    bench.until(lambda: bench.driver_states[-1].path_time > 0.5)  # it moves, and nobody hears of it
    assert len(bench.states) < 50
