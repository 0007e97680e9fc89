# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Two robots in namespaces, and simulated time."""

import threading

import numpy as np
import pytest
import rclpy
from rclpy.parameter import Parameter
from rosgraph_msgs.msg import Clock
from teo_sign_msgs.msg import DriverState

from teo_description import ALL_JOINTS

ELBOW = ALL_JOINTS.index("FrontalRightElbow")
SECOND = 10**9


class SimulatedClock:
    """Publishes /clock from a thread: 10 ms of simulated time every 4 ms, unless it is paused."""

    def __init__(self, context):
        self.node = rclpy.create_node("simulator", context=context)
        self._publisher = self.node.create_publisher(Clock, "/clock", 10)
        self._end, self._running = threading.Event(), threading.Event()
        self._running.set()
        self.now = 1000 * SECOND  # [ns]
        self._thread = threading.Thread(target=self._run)
        self._thread.start()

    def pause(self):
        self._running.clear()

    def go_on(self):
        self._running.set()

    def close(self):
        self._end.set()
        self._thread.join()
        self.node.destroy_node()

    def _run(self):
        while not self._end.wait(0.004):
            if self._running.is_set():
                self.now += SECOND // 100
                message = Clock()
                message.clock.sec, message.clock.nanosec = divmod(self.now, SECOND)
                self._publisher.publish(message)


@pytest.fixture
def clock(context):
    clock = SimulatedClock(context)
    yield clock
    clock.close()


def stamp(state):
    return state.header.stamp.sec * SECOND + state.header.stamp.nanosec


def test_by_a_simulators_clock_the_path_is_executed_in_simulated_time(clock, new_bench, one_way):
    bench = new_bench(parameter_overrides=[Parameter("use_sim_time", value=True)])
    trajectory = one_way(duration=2.0, angle=-0.4)
    start = clock.now + SECOND
    trajectory.header.stamp.sec, trajectory.header.stamp.nanosec = divmod(start, SECOND)
    bench.commands.publish(trajectory)
    bench.until(lambda: bench.states[-1].position[ELBOW] < -0.1)
    clock.pause()
    for _ in range(10):
        bench.executor.spin_once(timeout_sec=0.02)
    heard = len(bench.states)
    for _ in range(10):
        bench.executor.spin_once(timeout_sec=0.02)
    assert len(bench.states) == heard  # no time passes, nothing moves
    clock.go_on()
    bench.until(lambda: bench.states[-1].position[ELBOW] == -0.4)
    # Where the elbow is says nothing but the stamp: the curve that was sent, in closed form.
    u = np.clip([(stamp(state) - start) / (2.0 * SECOND) for state in bench.states], 0.0, 0.5)
    truth = -0.4 * (4.0 * u * (1.0 - u)) ** 3
    np.testing.assert_allclose([state.position[ELBOW] for state in bench.states], truth, atol=1e-4)
    assert len(np.unique(u)) > 10


def test_two_robots_in_namespaces_do_not_hear_each_other(new_bench, one_way):
    ana, eva = new_bench(namespace="ana"), new_bench(namespace="eva")

    def both_until(condition):
        ana.until(lambda: eva.executor.spin_once(timeout_sec=0.0) or condition())

    ana.commands.publish(one_way(duration=2.0, angle=-0.2))
    both_until(lambda: ana.states[-1].position[ELBOW] < -0.05)
    stop = eva.triggers["stop"]
    both_until(stop.service_is_ready)
    answer = stop.call_async(stop.srv_type.Request())
    both_until(answer.done)
    both_until(lambda: ana.states[-1].position[ELBOW] == -0.2)
    both_until(lambda: eva.mode() == DriverState.MODE_STOPPED)
    both_until(lambda: ana.mode() == DriverState.MODE_HOLDING)
    assert not any(state.position[ELBOW] for state in eva.states)
