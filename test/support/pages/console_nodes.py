# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The nodes that the page's tests meet: started once for a module, in a known state before each test."""

from __future__ import annotations

import asyncio
import itertools
import json
import re
import threading
import time
from collections.abc import Coroutine
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import aiohttp
import pytest

from teo_bringup.graph import NODES, Graph, GraphError, executable_of

START_TIMEOUT = 120.0  # [s] for four processes on a loaded machine: four seconds on an idle one
# For a robot to be stopped, re-armed and back at rest [s]: seconds on an idle machine.
SETTLED_WITHIN = 60.0
# A driver may wait for a processor for longer than the half second in which a robot is taken for lost.
PATIENT = ("--ros-args", "-p", "joint_state_timeout:=3.0")
ORDERS = ("clear_queue", "stop", "rearm")


class ConsoleNodes:
    """Translator, executor, driver and console, on a port that is free.

    Attributes:
        graph: Their processes, between `start` and `stop`.
    """

    graph: Graph

    def __init__(self, folder: Path) -> None:
        """Prepare to start them.

        Args:
            folder: For their logs, and for what users have of their own: signs, reviews.
        """
        self._folder = folder
        self._starts = itertools.count(1)
        self._running = ExitStack()

    @property
    def address(self) -> str:
        """Where the page is."""
        found = re.search(r"http://\S+", self.graph.tail("console"))
        assert found is not None, self.graph.tail("console")
        return found.group()

    def start(self) -> None:
        """Start all of them, and wait until they can serve."""
        folder = self._folder / f"start_{next(self._starts)}"
        self.graph = self._running.enter_context(Graph(folder))
        with pytest.MonkeyPatch.context() as patch:
            patch.setenv("XDG_DATA_HOME", str(folder / "data"))
            self.graph.start_nodes(arguments=PATIENT)
            self.graph.start("console", str(executable_of(*NODES["console"])), "--ros-args", "-p", "port:=0")
        deadline = time.monotonic() + START_TIMEOUT
        while not self.graph.is_ready():
            self.graph.check()
            assert time.monotonic() < deadline, self.graph.tail("console") + self.graph.tail("translator")
            time.sleep(0.05)

    def stop(self) -> None:
        """Stop all of them."""
        self._running.close()

    def settle(self) -> None:
        """Bring them to a known state: all there, the robot armed, at rest, at full speed, nothing waiting.

        Nodes that do not come to it are started again: the test before may have left them in any state.
        """
        try:
            self.graph.check()
            run_apart(settled(self.address))
        except (GraphError, AssertionError, aiohttp.ClientError, TimeoutError) as error:
            print(f"the nodes are started again: {error!r}")
            self.stop()
            self.start()
            run_apart(settled(self.address))


def run_apart(coroutine: Coroutine[Any, Any, None]) -> None:
    """Run a coroutine in a thread of its own: a browser has the event loop of this one."""
    raised: list[Exception] = []

    def run() -> None:
        try:
            asyncio.run(coroutine)
        except Exception as error:
            raised.append(error)

    thread = threading.Thread(target=run)
    thread.start()
    thread.join()
    if raised:
        raise raised[0]


async def settled(address: str) -> None:
    """Bring the nodes of a console to a known state, as a page would.

    Raises:
        TimeoutError: They do not come to it.
        aiohttp.ClientError: The console does not answer.
    """
    async with (
        asyncio.timeout(SETTLED_WITHIN),
        aiohttp.ClientSession() as session,
        session.ws_connect(f"{address}ws", origin=address.rstrip("/")) as socket,
    ):
        situation = await next_message(socket, "situation")
        if not is_idle(situation):
            requests: list[dict[str, Any]] = [{"type": "command", "order": order} for order in ORDERS]
            requests += [{"type": "set_speed", "factor": 1.0}]
            requests += [{"type": "discard_spoken", "spoken": each["id"]} for each in situation["spoken"]]
            for number, request in enumerate(requests):
                await socket.send_json(request | {"id": number})
                await next_message(socket, "answer")
        while not (is_idle(situation) and all(node["state"] == "alive" for node in situation["nodes"])):
            situation = await next_message(socket, "situation")


async def next_message(socket: aiohttp.ClientWebSocketResponse, kind: str) -> dict[str, Any]:
    """The next message of a kind; poses and other messages are passed over."""
    async for message in socket:
        if message.type is aiohttp.WSMsgType.TEXT:
            told: dict[str, Any] = json.loads(message.data)
            if told["type"] == kind:
                return told
    raise aiohttp.ClientConnectionError("the console closed the connection")


def is_idle(situation: dict[str, Any]) -> bool:
    """Whether the robot is armed and at rest, and signs at full speed, and nothing waits."""
    robot = situation["robot"]
    return (robot["mode"], robot["executor"], robot["speed_wanted"]) == ("holding", "idle", 1.0) and not (
        situation["current"] or situation["queue"] or situation["spoken"]
    )
