# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the driver costs and how regular it is: one step, one trajectory's check, and the node over DDS."""

from __future__ import annotations

import time
from functools import partial

import numpy as np
from control_msgs.action import FollowJointTrajectory
from numpy.typing import NDArray
from rclpy.action import ActionClient
from rclpy.publisher import Publisher
from rclpy.serialization import serialize_message
from sensor_msgs.msg import JointState
from trajectory_msgs.msg import JointTrajectory

from driver_messages import trajectory_message
from nodes.bench_node import BenchNode, bench_graph, cpu_seconds, seconds
from report import Figure, percentiles
from teo_names import COMMANDED_JOINTS, HOME, joint_limits
from teo_sim_driver import JointFollower, check

PERIOD = 0.01  # [s]
SECOND = 1_000_000_000  # [ns]
_TIMEOUT = 30.0  # [s] for the node to start
_REPEATED = 3  # long messages of each length
_RECEIVED = 2.0  # [s] after which a long message has been received
_LONG = 60.0  # trajectory [s], points 100 times a second


def measure(watched: float = 20.0) -> list[Figure]:
    """Figures of the follower alone, then of the node in a process of its own.

    Args:
        watched: The node in motion [s].
    """
    return [*_follower(), *_node(watched)]


def home() -> NDArray[np.float64]:
    """The commanded joints at home [rad]. Shape (28,)."""
    return np.array([HOME[name] for name in COMMANDED_JOINTS])


def wave(duration: float, reach: NDArray[np.float64] | float = 0.1) -> JointTrajectory:
    """All joints away from home and back, again and again, by 0.1 rad at up to 40 % of their greatest speed.

    Args:
        duration: Of the trajectory [s].
        reach: How far each joint goes from home, where its limits let it [rad]; from 0.5 on it is too fast.
    """
    limits, start = joint_limits(), home()
    upward = start + reach <= limits.upper
    reach = np.where(
        upward, np.minimum(reach, limits.upper - start), -np.minimum(reach, start - limits.lower)
    )
    times = np.arange(1, round(duration / PERIOD) + 1) * PERIOD
    # Rises gently, so that the first point asks for no jump.
    rise = np.clip(times / 2.0, 0.0, 1.0)
    shape = rise**3 * (1.0 - np.cos(np.pi * times)) / 2.0
    speed = np.gradient(shape, times)
    speed[-1] = 0.0
    return trajectory_message(COMMANDED_JOINTS, times, start + shape[:, None] * reach, speed[:, None] * reach)


def _follower() -> list[Figure]:
    message = wave(_LONG)
    data = serialize_message(message)
    checks: list[float] = []
    takes: list[float] = []
    for _ in range(10):
        follower = JointFollower(limits=joint_limits(), start=home(), period=PERIOD)
        follower.step(0)
        begin = time.perf_counter()
        points = check(data, limits=follower.limits, rules=follower.rules)
        checks.append(time.perf_counter() - begin)
        begin = time.perf_counter()
        follower.take(points, 0)
        takes.append(time.perf_counter() - begin)
    steps: list[float] = []
    now = 0
    while follower.trajectory is not None:
        now += round(PERIOD * SECOND)
        begin = time.perf_counter()
        follower.step(now)
        steps.append(time.perf_counter() - begin)
    return [
        percentiles("one step of 28 joints in motion", steps),
        percentiles(f"check a trajectory of {len(message.points)} points, beside the steps", checks),
        percentiles(f"take a checked trajectory of {len(message.points)} points, between two steps", takes),
    ]


def _node(watched: float) -> list[Figure]:
    heard: list[JointState] = []
    with bench_graph() as (node, graph):
        node.create_subscription(JointState, "joint_states", heard.append, 100)
        commands = node.create_publisher(JointTrajectory, "joint_trajectory", 10)
        graph.start_nodes(["driver"])
        node.wait_for("joint states", lambda: heard and commands.get_subscription_count(), _TIMEOUT)
        commands.publish(wave(watched + 10.0))
        node.wait_for("the driver to move", lambda: any(heard[-1].velocity), _TIMEOUT)
        heard.clear()
        driver = graph.process_id("driver")
        begin, used = time.monotonic(), cpu_seconds(driver)
        node.spin(watched)
        share = (cpu_seconds(driver) - used) / (time.monotonic() - begin)
        gaps = _gaps(heard)
        long = _long_messages(node, commands, heard)
    low, high = np.percentile(gaps, [1, 99]) * 1e3
    return [
        Figure("driver in motion, of one core", f"{share * 100.0:.1f} %"),
        Figure("joint states", f"{1.0 / gaps.mean():.2f} Hz"),
        Figure(
            f"time between joint states ({len(gaps)} times)",
            f"p1 {low:.2f} ms, p99 {high:.2f} ms, longest {gaps.max() * 1e3:.1f} ms",
        ),
        *long,
    ]


def _long_messages(node: BenchNode, commands: Publisher, heard: list[JointState]) -> list[Figure]:
    """How long joint states are missing when a long message is received: on the topic, and as a goal."""
    figures = []
    goals = ActionClient(node, FollowJointTrajectory, "follow_joint_trajectory")
    node.wait_for("the action", goals.server_is_ready, _TIMEOUT)
    for count in (2_000, 20_000, 100_000):
        # Every point at the same time: it is refused, after it was read.
        message = wave(2 * PERIOD)
        message.points = message.points[:1] * count
        goal = FollowJointTrajectory.Goal(trajectory=message)
        ways = partial(commands.publish, serialize_message(message)), partial(goals.send_goal_async, goal)
        topic, action = (
            float(np.median([_longest_gap(node, heard, send) for _ in range(_REPEATED)])) for send in ways
        )
        figures.append(
            Figure(
                f"longest time between joint states, {count} points received (median of {_REPEATED})",
                f"topic {topic * 1e3:.0f} ms, action goal {action * 1e3:.0f} ms",
            )
        )
    return figures


def _longest_gap(node: BenchNode, heard: list[JointState], send: partial[object]) -> float:
    node.spin(0.3)
    heard.clear()
    send()
    end = time.time() + _RECEIVED
    node.wait_for("joint states", lambda: heard and seconds(heard[-1].header.stamp) > end, _TIMEOUT)
    return float(_gaps(heard).max())


def _gaps(heard: list[JointState]) -> NDArray[np.float64]:
    """Times between joint states [s]."""
    return np.diff([seconds(state.header.stamp) for state in heard])
