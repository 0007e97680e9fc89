# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
import time
from array import array
from collections.abc import Callable

import numpy as np
import pytest
import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray, String
from std_srvs.srv import Trigger
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from teo_description import ALL_JOINTS, HOME, LEG_JOINTS, urdf_text
from teo_sim_driver.driver_node import DriverNode
from teo_sim_driver.parameters import PARAMETERS

PATIENCE = 20.0  # [s]; a busy machine is slow, not wrong
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Bench:
    """The driver and a client that hears everything, in one process and a DDS domain of their own."""

    def __init__(self, context, **driver_arguments):
        self.driver = DriverNode(context=context, **driver_arguments)
        self.client = rclpy.create_node("client", context=context)
        self.executor = SingleThreadedExecutor(context=context)
        self.executor.add_node(self.driver)
        self.executor.add_node(self.client)
        self.states: list[JointState] = []
        self.diagnostics: list[DiagnosticArray] = []
        self.client.create_subscription(JointState, "joint_states", self.states.append, 10)
        self.client.create_subscription(DiagnosticArray, "diagnostics", self.diagnostics.append, 10)
        self.commands = self.client.create_publisher(JointTrajectory, "joint_trajectory", 10)
        self.stop = self.client.create_client(Trigger, "stop")
        self.until(lambda: self.states and self.commands.get_subscription_count())

    def until(self, condition: Callable[[], object]) -> None:
        deadline = time.monotonic() + PATIENCE
        while not condition():
            assert time.monotonic() < deadline, "it did not happen in time"
            self.executor.spin_once(timeout_sec=0.1)

    def position(self, joint):
        return self.states[-1].position[ALL_JOINTS.index(joint)]

    def said(self, key):
        return {pair.key: pair.value for pair in self.diagnostics[-1].status[0].values}[key]

    def close(self):
        self.executor.shutdown()
        self.client.destroy_node()
        self.driver.destroy_node()


@pytest.fixture
def context(domain_id):
    context = rclpy.Context()
    rclpy.init(context=context, domain_id=domain_id)
    yield context
    rclpy.try_shutdown(context=context)


@pytest.fixture
def bench(context):
    bench = Bench(context)
    yield bench
    bench.close()


def as_ros(plain):
    message = JointTrajectory(joint_names=list(plain.joint_names))
    message.header.stamp.sec = plain.header.stamp.sec
    message.header.stamp.nanosec = plain.header.stamp.nanosec
    for point in plain.points:
        ros = JointTrajectoryPoint(
            positions=array("d", point.positions),
            velocities=array("d", point.velocities),
            accelerations=array("d", point.accelerations),
        )
        ros.time_from_start.sec = point.time_from_start.sec
        ros.time_from_start.nanosec = point.time_from_start.nanosec
        message.points.append(ros)
    return message


def one_way(swing, **arguments):
    """The first half of a swing, which ends at rest at its angle."""
    message = as_ros(swing(**arguments))
    del message.points[len(message.points) // 2 :]
    return message


def test_a_bad_trajectory_is_refused_with_its_reason_and_a_good_one_then_reaches_its_goal(bench, swing):
    first = bench.states[0]
    assert tuple(first.name) == ALL_JOINTS
    np.testing.assert_array_equal(first.position, [HOME[name] for name in ALL_JOINTS])
    assert list(first.velocity) == [0.0] * 40
    assert list(first.effort) == []

    bad = one_way(swing, duration=2.0, angle=-0.2)
    bad.points[4].positions[7] = float("nan")
    bench.commands.publish(bad)
    bench.until(lambda: bench.diagnostics and bench.said("refused") == "1")
    assert bench.said("last refusal code") == "not_finite"
    assert "FrontalLeftElbow" in bench.said("last refusal")
    assert bench.diagnostics[-1].status[0].level == b"\x01"

    good = one_way(swing, duration=2.0, angle=-0.2)
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
    bench.until(lambda: bench.said("state") == "holding" and bench.said("accepted") == "1")
    assert bench.said("limited steps") == "0"


def test_the_robot_description_and_the_hand_setpoints_reach_a_late_subscriber(bench):
    heard, hands = [], []
    bench.client.create_subscription(String, "robot_description", heard.append, LATCHED)
    bench.client.create_subscription(Float64MultiArray, "dextra_setpoints", hands.append, LATCHED)
    bench.until(lambda: heard and hands)
    assert heard[0].data == urdf_text()
    np.testing.assert_allclose(hands[0].data, [0.0, 10.0 / 3.0, 0.0, 0.0, 0.0, 0.0] * 2, atol=1e-9)
    assert [dimension.size for dimension in hands[0].layout.dim] == [2, 6]


def test_a_finger_that_moves_is_told_to_the_hand_as_tendon_travel(bench, swing):
    hands = []
    bench.client.create_subscription(Float64MultiArray, "dextra_setpoints", hands.append, LATCHED)
    bench.commands.publish(one_way(swing, joint="RightIndexFinger", angle=np.radians(39.0), duration=4.0))
    bench.until(lambda: hands and abs(hands[-1].data[8] - 10.0) < 1e-9)  # half of its way
    others = np.delete(np.subtract(hands[-1].data, [0.0, 10.0 / 3.0, 0.0, 0.0, 0.0, 0.0] * 2), 8)  # from home
    np.testing.assert_allclose(others, 0.0, atol=1e-9)


def test_told_to_stop_it_comes_to_rest_on_the_way(bench, swing):
    bench.until(bench.stop.service_is_ready)
    bench.commands.publish(one_way(swing, duration=6.0, angle=-1.0))
    bench.until(lambda: bench.position("FrontalRightElbow") < -0.05)
    answer = bench.stop.call_async(Trigger.Request())
    bench.until(answer.done)
    assert answer.result().success
    assert "at rest in" in answer.result().message
    bench.until(lambda: not any(bench.states[-1].velocity))
    assert -0.9 < bench.position("FrontalRightElbow") < -0.05
    where = bench.position("FrontalRightElbow")
    count = len(bench.states)
    bench.until(lambda: len(bench.states) > count + 20)
    assert bench.position("FrontalRightElbow") == where


def test_garbage_is_survived(bench, swing):
    good = one_way(swing, duration=2.0, angle=-0.1)
    garbage = [JointTrajectory() for _ in range(6)]
    garbage[1].joint_names = ["", "\x01", "ñandú"]
    garbage[2].joint_names = list(good.joint_names)
    garbage[3].points = [JointTrajectoryPoint() for _ in range(3)]
    garbage[4].joint_names = list(good.joint_names)
    garbage[4].points = [JointTrajectoryPoint(effort=array("d", [1.0] * 1000)) for _ in range(3)]
    garbage[5].joint_names = ["AxialNeck"] * 5000
    for i, message in enumerate(garbage):
        bench.commands.publish(message)
        bench.until(lambda i=i: bench.driver._follower.report().refused and sum_refused(bench) == i + 1)
    bench.commands.publish(good)
    bench.until(lambda: abs(bench.position("FrontalRightElbow") - good.points[-1].positions[13]) < 1e-9)


def sum_refused(bench):
    return sum(bench.driver._follower.report().refused.values())


def test_a_fault_of_its_own_is_reported_and_does_not_end_it(bench, swing, monkeypatch):
    def fault(*_, **__):
        raise ZeroDivisionError("on purpose")

    with monkeypatch.context() as patch:
        patch.setattr("teo_sim_driver.joint_follower.validate", fault)
        bench.commands.publish(one_way(swing))
        bench.until(lambda: bench.diagnostics and bench.said("last refusal code") == "internal")
    assert "on purpose" in bench.said("last refusal")
    bench.commands.publish(one_way(swing))
    bench.until(lambda: bench.position("FrontalRightElbow") < -0.01)


def test_every_parameter_has_a_description_and_numbers_have_a_range(bench):
    for row in PARAMETERS:
        descriptor = bench.driver.describe_parameter(row.name)
        assert descriptor.description
        assert bench.driver.get_parameter(row.name).value == row.default
        if not isinstance(row.default, bool):
            assert len(descriptor.integer_range) + len(descriptor.floating_point_range) == 1


def test_a_parameter_out_of_range_is_refused_and_a_good_one_takes_effect(bench, swing):
    def set_to(name, value):
        return bench.driver.set_parameters([Parameter(name, value=value)])[0].successful

    assert not set_to("start_tolerance", 1.0)
    assert not set_to("stop_deceleration", float("nan"))
    assert not set_to("update_rate", 50)
    assert set_to("max_points", 5)
    bench.commands.publish(one_way(swing))
    bench.until(lambda: bench.diagnostics and bench.said("last refusal code") == "too_many_points")


def test_parameters_may_be_given_at_the_start(context):
    bench = Bench(context, parameter_overrides=[Parameter("update_rate", value=50)])
    try:
        del bench.states[:]
        begin = time.monotonic()
        bench.until(lambda: len(bench.states) > 25)
        assert time.monotonic() - begin > 0.45
    finally:
        bench.close()
