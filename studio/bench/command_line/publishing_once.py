# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Whether `ros2 topic pub --once` reaches everybody, on a machine that has nothing to do and on a busy one.

`python -m command_line.publishing_once [COMMAND]` in `bench` publishes one text after the other to three
subscriptions in processes of their own, of which two are best effort. Busy: two processes for each core.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time

from command_line.playing import in_domain, own_command
from report import Figure

_TEXTS = 20
_LINGER = 2.0  # [s] for the last text to come
_RELIABILITIES = ("RELIABLE", "BEST_EFFORT", "BEST_EFFORT")
# Prints what comes.
_LISTENER = """
import sys
import rclpy
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node("listener")
profile = QoSProfile(depth=100, reliability=ReliabilityPolicy[sys.argv[1]])
node.create_subscription(String, "text", lambda message: print(message.data, flush=True), profile)
print("listening", flush=True)
rclpy.spin(node)
"""


def measure(command: str = "") -> list[Figure]:
    """Publish, and count what came to each."""
    program = command or str(own_command())
    busy = 2 * (os.cpu_count() or 1)
    return [_published(program, "nothing else to do", 0), _published(program, f"{busy} busy processes", busy)]


def _published(program: str, when: str, burners: int) -> Figure:
    with in_domain():
        listeners = [
            subprocess.Popen([sys.executable, "-c", _LISTENER, kind], stdout=subprocess.PIPE, text=True)
            for kind in _RELIABILITIES
        ]
        for listener in listeners:
            assert listener.stdout is not None
            listener.stdout.readline()
        others = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(burners)]
        begin = time.monotonic()
        try:
            for number in range(_TEXTS):
                words = ("topic", "pub", "--once", "/text", "std_msgs/msg/String", f"{{data: {number}}}")
                subprocess.run([program, *words], check=True, stdout=subprocess.DEVNULL)
            took = (time.monotonic() - begin) / _TEXTS
            time.sleep(_LINGER)
        finally:
            for other in others:
                other.kill()
            for listener in listeners:
                listener.kill()
        came = [listener.communicate()[0].split() for listener in listeners]
    whole = [len(set(texts)) for texts in came]
    counts = ", ".join(f"{kind.lower()} {count}" for kind, count in zip(_RELIABILITIES, whole, strict=True))
    return Figure(f"{_TEXTS} texts, {when}: came to each; one takes", f"{counts}; {took:.1f} s")


if __name__ == "__main__":
    for figure in measure(*sys.argv[1:2]):
        print(f"{figure.what}: {figure.value}")
