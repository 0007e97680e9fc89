# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Several machines on one: namespaces on a switch that delays, loses and cuts."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

_SWITCH = Path(__file__).with_name("lossy_switch.py")
# A machine's own: network, mounts, name, processes, shared memory, run-time files.
_UNSHARE = ("unshare", "--net", "--mount", "--uts", "--pid", "--fork", "--kill-child", "--mount-proc")
_LIVE = (
    "mount -t tmpfs tmpfs /dev/shm && mount -t tmpfs tmpfs /run && hostname {name} && ip link set lo up"
    " && echo up && exec sleep infinity"
)


def missing(*programs: str) -> str:
    """Why machines cannot be made here; empty if they can.

    Args:
        programs: What is needed besides.
    """
    if os.geteuid():
        return "network namespaces need root"
    if not Path("/dev/net/tun").exists():
        return "needs /dev/net/tun"
    absent = [name for name in ("ip", "unshare", "nsenter", *programs) if shutil.which(name) is None]
    return f"needs {', '.join(absent)}" if absent else ""


class Host:
    """One machine."""

    def __init__(self, name: str, address: str, home: Path) -> None:
        """Begin.

        Args:
            name: Its host name.
            address: On the network of all.
            home: Folder of its user.
        """
        self.name, self.address, self.home = name, address, home
        home.mkdir(parents=True, exist_ok=True)
        self._life = subprocess.Popen(
            [*_UNSHARE, "sh", "-c", _LIVE.format(name=name)], stdout=subprocess.PIPE, text=True
        )
        assert self._life.stdout is not None
        if self._life.stdout.readline() != "up\n":
            raise RuntimeError(f"expected namespaces for {name}, could not make them")
        children = Path(f"/proc/{self._life.pid}/task/{self._life.pid}/children").read_text()
        self.process = int(children)
        """A process that is in its namespaces."""

    def entered(self, *command: str) -> list[str]:
        """The same command on this machine, in the present folder."""
        spaces = ("--net", "--mount", "--uts", "--pid")
        return ["nsenter", f"--target={self.process}", *spaces, f"--wd={Path.cwd()}", *command]

    def end(self) -> None:
        """End the machine, and with it all that runs there."""
        self._life.kill()
        self._life.wait()


class Network:
    """Machines on one switch, gone when the `with` block ends."""

    def __init__(self, addresses: Mapping[str, str], folder: Path) -> None:
        """Plug the machines in.

        Args:
            addresses: IPv4 address of each machine by its name, of one /24.
            folder: Where their homes are made.
        """
        self.hosts = {name: Host(name, address, folder / name) for name, address in addresses.items()}
        plugs = [item for host in self.hosts.values() for item in (str(host.process), host.address)]
        self._switch = subprocess.Popen(
            [sys.executable, str(_SWITCH), *plugs], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        self._answered()

    def __enter__(self) -> Network:
        return self

    def __exit__(self, *_: object) -> None:
        for host in self.hosts.values():
            host.end()
        self._switch.communicate()  # its standard input ends, and so does it

    def delay(self, seconds: float) -> None:
        """Delay every frame by this much, each way."""
        self._tell(f"delay {seconds}")

    def lose(self, share: float) -> None:
        """Lose this share of the frames, 0 to 1."""
        self._tell(f"loss {share}")

    def cut(self, name: str) -> None:
        """Let nothing pass to or from a machine."""
        self._tell(f"cut {self.hosts[name].address}")

    def heal(self) -> None:
        """Let all pass again."""
        self._tell("heal")

    def _tell(self, line: str) -> None:
        assert self._switch.stdin is not None
        print(line, file=self._switch.stdin, flush=True)
        self._answered()

    def _answered(self) -> None:
        assert self._switch.stdout is not None
        if self._switch.stdout.readline() != "done\n":
            raise RuntimeError("expected the switch to answer, it has ended")
