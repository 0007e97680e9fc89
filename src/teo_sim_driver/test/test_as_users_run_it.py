# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Two robots in namespaces, and simulated time."""

import numpy as np
import pytest
from rclpy.parameter import Parameter
from simulated_clock import SECOND, SimulatedClock
from teo_sign_msgs.msg import DriverState

from teo_names import ALL_JOINTS

ELBOW = ALL_JOINTS.index("FrontalRightElbow")


@pytest.fixture
def clock(context):
    clock = SimulatedClock(context, rate=2.5)
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
