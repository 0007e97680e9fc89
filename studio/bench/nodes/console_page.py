# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the console's node costs while the robot moves: without a page, and with one that draws."""

from __future__ import annotations

import re
import time

from browsers import BROWSERS, OPTIONS, browser_path
from playwright.sync_api import Page, WebSocket, sync_playwright
from trajectory_msgs.msg import JointTrajectory

from nodes.bench_node import BenchNode, bench_graph, cpu_seconds
from nodes.driver_rate import wave
from report import Figure


def measure(watched: float = 15.0) -> list[Figure]:
    """Processor time of the node.

    Args:
        watched: The robot in motion, with and without a page [s].

    Raises:
        RuntimeError: There is no browser.
    """
    browser_file = browser_path()
    if browser_file is None:
        raise RuntimeError(f"expected a browser on the path, one of {', '.join(BROWSERS)}")
    with bench_graph() as (node, graph), sync_playwright() as playwright:
        graph.start_nodes(["driver"])
        graph.start_nodes(["console"], ("--ros-args", "-p", "port:=0"))
        node.wait_for("the console", lambda: "http://" in graph.tail("console"))
        address = re.search(r"http://\S+", graph.tail("console"))
        assert address is not None
        console = graph.process_id("console")
        _move(node, 2.0 * watched)
        alone = _busy(console, watched, None)
        browser = playwright.chromium.launch(executable_path=browser_file, args=list(OPTIONS))
        page = browser.new_page()
        poses: list[bytes] = []
        page.on("websocket", lambda socket: _collect(socket, poses))
        page.goto(address.group())
        page.wait_for_timeout(2000)
        _move(node, 2.0 * watched)
        poses.clear()
        drawn = _busy(console, watched, page)
        rate = len(poses) / watched
        browser.close()
    return [
        Figure("console while the robot moves, no page open, of one core", f"{alone * 100.0:.1f} %"),
        Figure(f"the same with a page that draws and gets {rate:.1f} poses/s", f"{drawn * 100.0:.1f} %"),
    ]


def _move(node: BenchNode, duration: float) -> None:
    commands = node.create_publisher(JointTrajectory, "joint_trajectory", 10)
    node.wait_for("the driver", commands.get_subscription_count)
    commands.publish(wave(duration))
    node.spin(0.5)


def _busy(process: int, watched: float, page: Page | None) -> float:
    """Share of a core that a process uses while it is watched."""
    begin, used = time.monotonic(), cpu_seconds(process)
    if page is None:
        time.sleep(watched)
    else:
        page.wait_for_timeout(watched * 1e3)  # the browser's messages are taken meanwhile
    return (cpu_seconds(process) - used) / (time.monotonic() - begin)


def _collect(socket: WebSocket, poses: list[bytes]) -> None:
    socket.on("framereceived", lambda frame: poses.append(frame) if isinstance(frame, bytes) else None)
