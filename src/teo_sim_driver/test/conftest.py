# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np
import pytest
import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from numpy.typing import NDArray
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger
from teo_sign_msgs.msg import DriverState
from trajectory_msgs.msg import JointTrajectory

from driver_messages import trajectory_message
from teo_description import JointLimits
from teo_description.humanoid import Humanoid, load_humanoid
from teo_names import ALL_JOINTS, HOME
from teo_sim_driver.joint_follower import JointFollower
from teo_sim_driver.node.driver_node import DriverNode
from teo_sim_driver.parameters import PARAMETERS

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
PERIOD = 0.01  # [s]
START = 1_700_000_000_000_000_000  # a time of day as ROS counts it [ns]


@pytest.fixture(scope="module")
def humanoid() -> Humanoid:
    """The robot; a module of tests may have them run on others."""
    return load_humanoid("teo")


@pytest.fixture(scope="module")
def limits(humanoid: Humanoid) -> JointLimits:
    return humanoid.limits()


@pytest.fixture(scope="module")
def home(humanoid: Humanoid) -> NDArray[np.float64]:
    return humanoid.hanging


@pytest.fixture(scope="module")
def new_follower(limits: JointLimits, home: NDArray[np.float64]) -> Callable[..., JointFollower]:
    """A follower that stands at home and has made its first step at START."""

    def make(**arguments: object) -> JointFollower:
        follower = JointFollower(**{"limits": limits, "start": home, "period": PERIOD, **arguments})
        follower.step(START)
        return follower

    return make


@pytest.fixture(scope="module")
def swing(
    humanoid: Humanoid, limits: JointLimits, home: NDArray[np.float64]
) -> Callable[..., JointTrajectory]:
    """From home, one joint to an angle and back as (4 u (1 - u))^3: no acceleration at either end."""

    def make(
        joint: str = humanoid.elbows[0],
        angle: float = -0.5,
        duration: float = 4.0,
        **stamp: int,
    ) -> JointTrajectory:
        times = np.arange(1, round(duration / 0.1) + 1) * 0.1
        shape = np.zeros(len(home))
        shape[limits.names.index(joint)] = angle
        curve = 64.0 * np.polynomial.Polynomial([0.0, 1.0 / duration, -1.0 / duration**2]) ** 3
        derivatives = [shape * curve.deriv(order)(times)[:, None] for order in range(3)]
        derivatives[0] += home
        derivatives[1][-1] = 0.0
        return trajectory_message(limits.names, times, *derivatives, **stamp)

    return make


@pytest.fixture(scope="module")
def one_way(swing: Callable[..., JointTrajectory]) -> Callable[..., JointTrajectory]:
    """The first half of a swing; it ends at rest at its angle."""

    def make(**arguments: object) -> JointTrajectory:
        message = swing(**arguments)
        del message.points[len(message.points) // 2 :]
        return message

    return make


PATIENCE = 20.0  # [s]; a busy machine is slow, not wrong


class Bench:
    """The driver and a client that hears everything, in one process and a DDS domain of their own."""

    def __init__(self, context, **driver_arguments):
        self.driver = DriverNode(context=context, **driver_arguments)
        self.client = rclpy.create_node(
            "client", context=context, namespace=driver_arguments.get("namespace")
        )
        self.executor = SingleThreadedExecutor(context=context)
        self.executor.add_node(self.driver)
        self.executor.add_node(self.client)
        self.states: list[JointState] = []
        self.diagnostics: list[DiagnosticArray] = []
        self.client.create_subscription(JointState, "joint_states", self.states.append, 10)
        self.client.create_subscription(DiagnosticArray, "diagnostics", self.diagnostics.append, 10)
        self.commands = self.client.create_publisher(JointTrajectory, "joint_trajectory", 10)
        self.driver_states: list[DriverState] = []
        self.client.create_subscription(DriverState, "driver_state", self.driver_states.append, LATCHED)
        self.triggers = {
            name: self.client.create_client(Trigger, name) for name in ("stop", "rearm", "pause", "resume")
        }
        self.until(lambda: self.states and self.commands.get_subscription_count())

    def until(self, condition: Callable[[], object]) -> None:
        deadline = time.monotonic() + PATIENCE
        while not condition():
            assert time.monotonic() < deadline, "it did not happen in time"
            self.executor.spin_once(timeout_sec=0.1)

    def begin_anew(self):
        """Bring it to rest at home, ready to move; restore its parameters, and forget what was heard."""
        changeable = [Parameter(row.name, value=row.default) for row in PARAMETERS if not row.read_only]
        self.driver.set_parameters(changeable)
        follower, now = self.driver._follower, self.driver.get_clock().now().nanoseconds
        follower.resume(now)
        follower.scale(1.0, now)
        follower.cancel(now)
        self.until(lambda: follower.trajectory is None)
        self.driver._rearm()
        follower.move_rest(load_humanoid().hanging)
        self.until(lambda: self.mode() == DriverState.MODE_HOLDING and self.driver_states[-1].at_rest)
        heard = len(self.states)
        self.until(
            lambda: (
                list(self.states[-1].position) == [HOME[name] for name in ALL_JOINTS]
                and len(self.states) > heard
            )
        )
        assert not any(self.states[-1].velocity)
        del self.states[:-1], self.driver_states[:-1], self.diagnostics[:]

    def call(self, name):
        """Answer of one of the driver's Trigger services."""
        client = self.triggers[name]
        self.until(client.service_is_ready)
        answer = client.call_async(Trigger.Request())
        self.until(answer.done)
        return answer.result()

    def mode(self):
        return self.driver_states[-1].mode if self.driver_states else None

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
def new_bench(context):
    """Makes a bench; the arguments are the driver's."""
    made = []

    def make(**driver_arguments):
        made.append(Bench(context, **driver_arguments))
        return made[-1]

    yield make
    for each in made:
        each.close()


class SharedBench:
    """A bench for many tests, handed on only at rest at home."""

    def __init__(self, domain_id):
        self._context = rclpy.Context()
        rclpy.init(context=self._context, domain_id=domain_id)
        self._bench = None

    def bench(self):
        if self._bench is not None:
            try:
                self._bench.begin_anew()
            except AssertionError:  # the test before has failed: that is its own matter
                self._bench.close()
                self._bench = None
        self._bench = self._bench or Bench(self._context)
        return self._bench

    def close(self):
        if self._bench is not None:
            self._bench.close()
        rclpy.try_shutdown(context=self._context)


@pytest.fixture(scope="module")
def shared(module_domain_id):
    shared = SharedBench(module_domain_id)
    yield shared
    shared.close()


@pytest.fixture
def bench(shared):
    return shared.bench()
