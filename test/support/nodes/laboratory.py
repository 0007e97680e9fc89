# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Laptop, workstation and robot on one network, set up by typing `docs/machines.md` word for word."""

from __future__ import annotations

import json
import os
import shutil
import time
from collections.abc import Callable
from pathlib import Path

from hosts import Host, Network
from typed_page import Shell, blocks_of
from witness import Seen

ROOT = Path(__file__).parents[3]
PAGE = ROOT / "docs" / "machines.md"
MACHINES = {"laptop": "192.168.10.1", "workstation": "192.168.10.2", "robot": "192.168.10.3"}
INTRUDER = {"intruder": "192.168.10.66"}
# What the page needs beside namespaces.
PROGRAMS = ("wg", "wireguard-go")
TEXT = "ros2 topic pub --once /text std_msgs/msg/String \"{data: 'Hola'}\""
_PATIENCE = 600.0  # [s] for all nodes to start, on a loaded machine
_WITNESS = "exec python -m witness"
_ENTER = "ip netns exec teo bash"


class Laboratory:
    """Three machines that sign, a witness on the robot, and an intruder's machine on the same switch."""

    def __init__(self, folder: Path) -> None:
        """Set the machines up and start the nodes; all of them are ready.

        Args:
            folder: Where the machines' homes are made.
        """
        self.network = Network(MACHINES | INTRUDER, folder)
        try:
            self._shells = {name: self.shell(name) for name in MACHINES}
            for block in blocks_of(PAGE):
                self._type(block.where, block.text)
            self._witness = self.inside("robot")
            self._witness.type(_WITNESS + " &")
            self.wait(lambda seen: seen.at_rest, _PATIENCE)
        except BaseException:
            self.network.__exit__()
            raise

    def __enter__(self) -> Laboratory:
        return self

    def __exit__(self, *_: object) -> None:
        self.network.__exit__()

    def host(self, name: str) -> Host:
        """One of the machines."""
        return self.network.hosts[name]

    def shell(self, name: str) -> Shell:
        """A new shell of a machine, outside the tunnel, with nothing set of the network."""
        host = self.host(name)
        clean = {key: value for key, value in os.environ.items() if not key.startswith(("ROS_", "FASTRTPS_"))}
        clean["PYTHONPATH"] = f"{Path(__file__).parent}:{clean.get('PYTHONPATH', '')}"
        return Shell(*host.entered("bash"), environment=clean, home=host.home)

    def inside(self, name: str) -> Shell:
        """A new shell of a machine, in the tunnel."""
        shell = self.shell(name)
        for line in (_ENTER, ". ./env.sh", ". ~/teo_network.sh"):
            shell.type(line)
        return shell

    def say(self) -> None:
        """Type the text of the page on the laptop."""
        self._shells["laptop"].type(TEXT + " &")

    @property
    def seen(self) -> Seen | None:
        """What the witness told last."""
        lines = [line for line in self._witness.said if line.startswith("{")]
        return Seen(**json.loads(lines[-1])) if lines else None

    def wait(self, condition: Callable[[Seen], bool], timeout: float) -> Seen:
        """Wait until what the witness sees is so.

        Raises:
            AssertionError: It is not, for `timeout` [s].
        """
        deadline = time.monotonic() + timeout
        while (seen := self.seen) is None or not condition(seen):
            told = {name: shell.said[-8:] for name, shell in self._shells.items()}
            assert time.monotonic() < deadline, (seen, self._witness.said[-3:], told)
            time.sleep(0.05)
        return seen

    def _type(self, where: str, text: str) -> None:
        """Type a block of the recommended way where it belongs."""
        if "apt-get" in text or TEXT in text:  # is here already; is typed by `say`
            return
        for name in MACHINES if where == "each machine" else MACHINES.keys() & {where}:
            self._shells[name].type(text.rstrip() + (" &" if "teo_bringup up" in text else ""))
        if "wg genkey" in text:  # the page: "Carry the three .pub files …"
            for giver in MACHINES:
                for taker in MACHINES.keys() - {giver}:
                    shutil.copy(self.host(giver).home / f"{giver}.pub", self.host(taker).home)
