# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the console costs, and how soon its page is there.

In `bench`: `PYTHONPATH=../test/support python -m nodes.console_page`.
"""

from __future__ import annotations

import os
import re
import statistics
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple, TypeVar

import rclpy
from browsers import BROWSERS, OPTIONS, browser_path
from playwright.sync_api import Browser, Page, WebSocket, sync_playwright
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from trajectory_msgs.msg import JointTrajectory

from nodes.driver_rate import cpu_seconds, wave
from report import Figure
from teo_bringup.graph import NODES, Graph, executable_of

WATCHED = 15.0  # [s] of the robot in motion, with and without a page
VISITS = 7  # of a page, each by a browser that has not been there
T = TypeVar("T")
_TIMEOUT = 60.0  # [s] for the nodes to start
_FIRST_PAINT = "performance.getEntriesByName('first-contentful-paint')[0]?.startTime"


def measure() -> list[Figure]:
    """Figures of the node without and with a page, and of the page."""
    os.environ.setdefault("ROS_DOMAIN_ID", "19")
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    browser_file = browser_path()
    if browser_file is None:
        raise RuntimeError(f"expected a browser on the path, one of {', '.join(BROWSERS)}")
    with Graph(Path(tempfile.mkdtemp())) as graph, sync_playwright() as playwright:
        graph.start("driver", str(executable_of(*NODES["driver"])))
        graph.start("console", str(executable_of(*NODES["console"])), "--ros-args", "-p", "port:=0")
        address = _wait(lambda: re.search(r"http://\S+", graph.tail("console"))).group()
        browser = playwright.chromium.launch(executable_path=browser_file, args=list(OPTIONS))
        # In turn with a page of a few words from the same server: what is not the page's is in both.
        paints, plain = [], []
        for _ in range(VISITS):
            paints.append(_first_paint(browser, address))
            plain.append(_first_paint(browser, f"{address}i18n/es.json"))
        console = graph.process_id("console")
        _move()
        alone = _busy(console, None)
        undrawn = _watched(browser, f"{address}#review", console)
        drawn = _watched(browser, address, console)
        browser.close()
    return [
        Figure("console while the robot moves, no page open, of one core", f"{alone * 100.0:.1f} %"),
        Figure(
            f"the same with a page open that does not draw, and gets {undrawn.rate:.1f} poses/s",
            f"{undrawn.busy * 100.0:.1f} %",
        ),
        Figure(
            f"the same with one that draws by the processor, and gets {drawn.rate:.1f} poses/s",
            f"{drawn.busy * 100.0:.1f} %",
        ),
        Figure(
            f"first paint of the page ({VISITS} new browsers)",
            f"median {statistics.median(paints):.2f} s, longest {max(paints):.2f} s",
        ),
        Figure(
            "baseline, in turn: of a file of text from the same server",
            f"median {statistics.median(plain):.2f} s, longest {max(plain):.2f} s",
        ),
    ]


class _Watched(NamedTuple):
    """What a page that is open costs and gets."""

    busy: float
    """Share of a core that the node uses."""
    rate: float
    """Poses that the page receives [Hz]."""


def _watched(browser: Browser, address: str, console: int) -> _Watched:
    """Open a page while the robot moves."""
    page = browser.new_context().new_page()
    poses: list[float] = []
    page.on("websocket", lambda socket: _count(socket, poses))
    page.goto(address)
    page.wait_for_timeout(2000)
    _move()
    poses.clear()
    begin = time.monotonic()
    busy = _busy(console, page)
    rate = len(poses) / (time.monotonic() - begin)
    page.context.close()
    return _Watched(busy, rate)


def _first_paint(browser: Browser, address: str) -> float:
    """From asking for a page to its first words, in a browser that has not been there [s]."""
    page = browser.new_context().new_page()
    page.goto(address)
    paint: float = _wait(lambda: page.evaluate(_FIRST_PAINT)) * 1e-3
    page.context.close()
    return paint


def _move() -> None:
    """Have the robot move for twice as long as is watched."""
    rclpy.init()
    node = Node("bench")
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    commands = node.create_publisher(JointTrajectory, "joint_trajectory", 10)
    try:
        while not commands.get_subscription_count():
            executor.spin_once(timeout_sec=0.1)
        commands.publish(wave(2 * WATCHED))
        executor.spin_once(timeout_sec=0.5)
    finally:
        node.destroy_node()
        rclpy.shutdown()


def _busy(process: int, page: Page | None) -> float:
    """Share of a core that a process uses while it is watched."""
    begin, used = time.monotonic(), cpu_seconds(process)
    if page is None:
        time.sleep(WATCHED)
    else:
        page.wait_for_timeout(WATCHED * 1e3)  # the browser's messages are taken meanwhile
    return (cpu_seconds(process) - used) / (time.monotonic() - begin)


def _count(socket: WebSocket, poses: list[float]) -> None:
    socket.on("framereceived", lambda frame: poses.append(0.0) if isinstance(frame, bytes) else None)


def _wait(condition: Callable[[], T | None]) -> T:
    deadline = time.monotonic() + _TIMEOUT
    while not (result := condition()):
        if time.monotonic() > deadline:
            raise TimeoutError(f"the console or its page were not there within {_TIMEOUT:.0f} s")
        time.sleep(0.05)
    return result


if __name__ == "__main__":
    for figure in measure():
        print(f"{figure.what}: {figure.value}")
