# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the driver costs and how regular it is: one step, one trajectory's check, and the node over DDS."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
import rclpy
from control_msgs.action import FollowJointTrajectory
from numpy.typing import NDArray
from rclpy.action import ActionClient
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.serialization import serialize_message
from sensor_msgs.msg import JointState
from trajectory_msgs.msg import JointTrajectory

from driver_messages import trajectory_message
from report import Figure, percentiles
from teo_names import COMMANDED_JOINTS, HOME, joint_limits
from teo_sim_driver.checking.validation import check
from teo_sim_driver.follower_report import Mode
from teo_sim_driver.joint_follower import JointFollower
from teo_sim_driver.motion.path_time import SECOND
from teo_sim_driver.rules import Rules

PERIOD = 0.01  # [s]
WATCHED = 20.0  # [s] of the node in motion
_TIMEOUT = 30.0  # [s] for the node to start
_REPEATED = 3  # long messages of each length
_RECEIVED = 2.0  # [s] after which a long message has been received
_LONG, _SHORT = 60.0, 30.0  # trajectories [s], points 100 times a second
_NODE = "from teo_sim_driver.node.driver_node import main; main()"


def measure() -> list[Figure]:
    """Figures of the follower alone, then of the node in a process of its own."""
    return [*_follower(), *_node()]


def wave(duration: float, reach: NDArray[np.float64] | float = 0.1) -> JointTrajectory:
    """All joints away from home and back, again and again, by 0.1 rad at up to 40 % of their greatest speed.

    Args:
        duration: Of the trajectory [s].
        reach: How far each joint goes from home, where its limits let it [rad]; from 0.5 on it is too fast.
    """
    limits = joint_limits()
    home = np.array([HOME[name] for name in COMMANDED_JOINTS])
    upward = home + reach <= limits.upper
    reach = np.where(upward, np.minimum(reach, limits.upper - home), -np.minimum(reach, home - limits.lower))
    times = np.arange(1, round(duration / PERIOD) + 1) * PERIOD
    # Rises gently, so that the first point asks for no jump.
    rise = np.clip(times / 2.0, 0.0, 1.0)
    angle = 2.0 * np.pi * times / 2.0
    shape = rise**3 * (1.0 - np.cos(angle)) / 2.0
    speed = np.gradient(shape, times)
    speed[-1] = 0.0
    positions = home + shape[:, None] * reach
    return trajectory_message(COMMANDED_JOINTS, times, positions, speed[:, None] * reach)


def _follower() -> list[Figure]:
    home = np.array([HOME[name] for name in COMMANDED_JOINTS])
    long = wave(_LONG)
    data = serialize_message(long)
    checks: list[float] = []
    takes: list[float] = []
    for _ in range(10):
        follower = JointFollower(limits=joint_limits(), start=home, period=PERIOD)
        follower.step(0)
        begin = time.perf_counter()
        points = check(data, limits=joint_limits(), rules=Rules())
        checks.append(time.perf_counter() - begin)
        begin = time.perf_counter()
        follower.take(points, 0)
        takes.append(time.perf_counter() - begin)
    steps: list[float] = []
    now = 0
    while follower.mode is Mode.MOVING:
        now += round(PERIOD * SECOND)
        begin = time.perf_counter()
        follower.step(now)
        steps.append(time.perf_counter() - begin)
    return [
        percentiles("one step of 28 joints in motion", steps),
        percentiles(f"check a trajectory of {len(long.points)} points, beside the steps", checks),
        percentiles(f"take a checked trajectory of {len(long.points)} points, between two steps", takes),
    ]


def _node() -> list[Figure]:
    os.environ.setdefault("ROS_DOMAIN_ID", "19")
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    rclpy.init()
    node = Node("bench")
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    heard: list[JointState] = []
    node.create_subscription(JointState, "joint_states", heard.append, 100)
    commands = node.create_publisher(JointTrajectory, "joint_trajectory", 10)

    def wait(condition: Callable[[], bool], seconds: float) -> bool:
        deadline = time.monotonic() + seconds
        while not condition() and time.monotonic() < deadline:
            executor.spin_once(timeout_sec=0.1)
        return condition()

    driver = subprocess.Popen([sys.executable, "-c", _NODE], stderr=subprocess.DEVNULL)
    try:
        if not wait(lambda: bool(heard) and commands.get_subscription_count() > 0, _TIMEOUT):
            raise TimeoutError(f"no joint states within {_TIMEOUT} s")
        commands.publish(wave(_SHORT))
        if not wait(lambda: any(heard[-1].velocity), _TIMEOUT):
            raise TimeoutError(f"the driver did not move within {_TIMEOUT} s")
        heard.clear()
        begin, used = time.monotonic(), cpu_seconds(driver.pid)
        wait(lambda: False, WATCHED)
        stamps = np.array([_stamp(state) for state in heard])
        share = (cpu_seconds(driver.pid) - used) / (time.monotonic() - begin)
        long = _long_messages(node, commands, heard, wait)
    finally:
        driver.send_signal(signal.SIGINT)
        driver.wait()
        node.destroy_node()
        rclpy.shutdown()
    gaps: NDArray[np.float64] = np.diff(stamps)
    low, high = np.percentile(gaps, [1, 99]) * 1e3
    return [
        Figure("driver in motion, of one core", f"{share * 100.0:.1f} %"),
        Figure("joint states", f"{len(gaps) / (stamps[-1] - stamps[0]):.2f} Hz"),
        Figure(
            f"time between joint states ({len(gaps)} times)",
            f"p1 {low:.2f} ms, p99 {high:.2f} ms, longest {gaps.max() * 1e3:.1f} ms",
        ),
        *long,
    ]


def _long_messages(
    node: Node,
    commands: Publisher,
    heard: list[JointState],
    wait: Callable[[Callable[[], bool], float], bool],
) -> list[Figure]:
    """How long joint states are missing when a long message is received: on the topic, and as a goal."""
    figures = []
    goals = ActionClient(node, FollowJointTrajectory, "follow_joint_trajectory")
    wait(goals.server_is_ready, _TIMEOUT)
    for count in (2_000, 6_000, 20_000, 100_000):
        # Every point at the same time: it is refused, after it was read.
        message = wave(2 * PERIOD)
        message.points = message.points[:1] * count
        data = serialize_message(message)
        gaps = []
        goal = FollowJointTrajectory.Goal(trajectory=message)
        for send in (partial(commands.publish, data), partial(goals.send_goal_async, goal)):
            longest = []
            for _ in range(_REPEATED):
                wait(lambda: False, 0.3)
                heard.clear()
                send()
                end = time.time() + _RECEIVED
                wait(partial(_heard_after, heard, end), _TIMEOUT)
                longest.append(np.diff([_stamp(state) for state in heard]).max())
            gaps.append(float(np.median(longest)))
        figures.append(
            Figure(
                f"longest time between joint states, {count} points received (median of {_REPEATED})",
                f"topic {gaps[0] * 1e3:.0f} ms, action goal {gaps[1] * 1e3:.0f} ms",
            )
        )
    return figures


def _stamp(state: JointState) -> float:
    """When it was measured [s]."""
    return float(state.header.stamp.sec + state.header.stamp.nanosec * 1e-9)


def _heard_after(heard: list[JointState], end: float) -> bool:
    return bool(heard) and _stamp(heard[-1]) > end


def cpu_seconds(pid: int) -> float:
    """Processor time that a process has used [s], user and system."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


if __name__ == "__main__":
    for figure in measure():
        print(f"{figure.what}: {figure.value}")
