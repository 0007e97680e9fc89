# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""An Ethernet switch in user space that delays, loses and cuts.

`python lossy_switch.py PID ADDRESS [PID ADDRESS …]` gives every network namespace, named by a process that
is in it, an interface `lan0` with an address of one network. The kernel's own netem does the same with less,
where it is compiled in. Needs root.

Lines on standard input: `delay SECONDS` (one way), `loss SHARE`, `cut ADDRESS` (nothing to or from it),
`heal`. Each is answered with `done`; it ends when standard input does.
"""

from __future__ import annotations

import ctypes
import fcntl
import heapq
import os
import random
import selectors
import struct
import subprocess
import sys
import time
from dataclasses import dataclass, field

_TUNSETIFF, _IFF_TAP, _IFF_NO_PI = 0x400454CA, 0x0002, 0x1000  # linux/if_tun.h
_CLONE_NEWNET = 0x40000000  # sched.h
_FRAME = 2048  # [bytes], above the interface's 1500
_SEED = 5  # which frames are lost


def plug_in(process: int, address: str) -> int:
    """Make `lan0` in the network namespace of a process; give the handle of its other end."""
    with open(f"/proc/{process}/ns/net") as namespace:  # noqa: PTH123 - a handle is what setns wants
        if ctypes.CDLL(None, use_errno=True).setns(namespace.fileno(), _CLONE_NEWNET):
            raise OSError(ctypes.get_errno(), "setns")
    handle = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK)
    fcntl.ioctl(handle, _TUNSETIFF, struct.pack("16sH22x", b"lan0", _IFF_TAP | _IFF_NO_PI))
    subprocess.run(["ip", "address", "add", f"{address}/24", "dev", "lan0"], check=True)
    subprocess.run(["ip", "link", "set", "lan0", "up"], check=True)
    return handle


@dataclass
class Switch:
    """Passes frames between ports, each by its own way."""

    ports: dict[int, str]
    """Address at each handle."""
    delay: float = 0.0
    loss: float = 0.0
    cut: set[str] = field(default_factory=set)
    _learned: dict[bytes, int] = field(default_factory=dict)
    _waiting: list[tuple[float, int, int, bytes]] = field(default_factory=list)
    _count: int = 0
    _dice: random.Random = field(default_factory=lambda: random.Random(_SEED))

    def take(self, port: int, now: float) -> None:
        """Take a frame from a port; to whom it goes it goes after the delay, or is lost."""
        frame = os.read(port, _FRAME)
        self._learned[frame[6:12]] = port
        known = self._learned.get(frame[:6])
        for other in self.ports if known is None else (known,):
            if other == port or self.cut & {self.ports[port], self.ports[other]}:
                continue
            if self._dice.random() >= self.loss:
                self._count += 1
                heapq.heappush(self._waiting, (now + self.delay, self._count, other, frame))

    def deliver(self, now: float) -> float | None:
        """Hand over what is due; give the time until the next frame is [s], None if none waits."""
        while self._waiting and self._waiting[0][0] <= now:
            _, _, port, frame = heapq.heappop(self._waiting)
            try:
                os.write(port, frame)
            except OSError:
                continue  # its queue is full or it is down: lost, as on a wire
        return self._waiting[0][0] - now if self._waiting else None

    def obey(self, line: str) -> None:
        """Do what a line says."""
        word, *rest = line.split()
        if word == "delay":
            self.delay = float(rest[0])
        elif word == "loss":
            self.loss = float(rest[0])
        elif word == "cut":
            self.cut.add(rest[0])
        elif word == "heal":
            self.cut.clear()
        else:
            raise ValueError(f"expected delay, loss, cut or heal, got {line!r}")


def main() -> None:
    """Plug in what the command line names, and pass frames until standard input ends."""
    pairs = zip(sys.argv[1::2], sys.argv[2::2], strict=True)
    switch = Switch({plug_in(int(process), address): address for process, address in pairs})
    wakeful = selectors.DefaultSelector()
    for port in switch.ports:
        wakeful.register(port, selectors.EVENT_READ)
    wakeful.register(sys.stdin, selectors.EVENT_READ)
    print("done", flush=True)
    while True:
        for key, _ in wakeful.select(switch.deliver(time.monotonic())):
            if key.fileobj is not sys.stdin:
                switch.take(key.fd, time.monotonic())
            elif line := os.read(0, 1000).decode():
                switch.obey(line)
                print("done", flush=True)
            else:
                return


if __name__ == "__main__":
    main()
