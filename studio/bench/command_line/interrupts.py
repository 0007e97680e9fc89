# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Whether a command that is interrupted at any moment ends in silence and with its status.

`python -m command_line.interrupts [INTERRUPTS [SEED [COMMAND]]]` in `bench` starts the verbs in turn in a
graph with a node that has a topic and a service, and sends SIGINT or SIGTERM at a random moment.
"""

from __future__ import annotations

import contextlib
import random
import signal
import subprocess
import sys
import tempfile
import threading
from collections import Counter

from std_msgs.msg import String
from std_srvs.srv import SetBool

from command_line.playing import in_domain, own_command
from report import Figure

INTERRUPTS, _SEED = 50, 5
_LATEST = 3.0  # [s] after its start that a command is interrupted
_PATIENCE = 20.0  # [s] that it gets to end
_VERBS = (
    "topic pub -r 20 /text std_msgs/msg/String",
    "topic pub --once /nobody std_msgs/msg/String",
    "topic echo /text",
    "topic hz /text",
    "topic bw /text",
    "topic list -v",
    "topic info -v /text",
    "node list",
    "node info /bench",
    "param list",
    "param dump /bench",
    "service list",
    "service call -r 5 /switch std_srvs/srv/SetBool",
    "service call /nobody std_srvs/srv/SetBool",
    "service echo /switch",
    "action list",
    "action send_goal /nobody teo_sign_msgs/action/ExecuteSentence",
    "lifecycle nodes",
    "doctor",
    "multicast receive",
    "interface list",
    "bag record -a -o {folder}/bag{number}",
)
# What no command may tell of a signal.
_NOISE = ("Traceback", "Error", "error:", "terminate called", "Exception")
# By signal: the command's own status, or its death of the signal; commands that end first give 0 or 1.
_STATUSES = {signal.SIGINT: {0, 1, 2, -2}, signal.SIGTERM: {0, 1, 143, -15}}
# Where a traceback begins that Python prints before the command's own code runs.
_COMMAND = "teo_ros2cli/main.py"


def measure(interrupts: int = INTERRUPTS, seed: int = _SEED, command: str = "") -> list[Figure]:
    """Interrupt so many commands, and judge how each ended."""
    dice = random.Random(seed)
    bad: list[str] = []
    early = 0
    statuses: Counter[int] = Counter()
    with in_domain() as (node, executor), tempfile.TemporaryDirectory() as folder:
        publisher = node.create_publisher(String, "text", 10)
        node.create_timer(0.05, lambda: publisher.publish(String(data="x")))
        node.create_service(SetBool, "switch", lambda _request, response: response)
        over = threading.Event()

        def spin() -> None:
            while not over.is_set():
                executor.spin_once(timeout_sec=0.1)

        spinning = threading.Thread(target=spin)
        spinning.start()
        for number in range(interrupts):
            words = _VERBS[number % len(_VERBS)].format(folder=folder, number=number).split()
            kind = dice.choice((signal.SIGINT, signal.SIGTERM))
            running = subprocess.Popen(
                [command or str(own_command()), *words],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.PIPE,
                text=True,
            )
            moment = dice.uniform(0.0, _LATEST)
            with contextlib.suppress(subprocess.TimeoutExpired):
                running.wait(moment)
            running.send_signal(kind)
            try:
                told = running.communicate(timeout=_PATIENCE)[1]
            except subprocess.TimeoutExpired:
                running.kill()
                told = f"Error: it did not end within {_PATIENCE} s"
                running.communicate()
            statuses[running.returncode] += 1
            if "Traceback" in told and _COMMAND not in told:
                early += 1
            elif any(noise in told for noise in _NOISE) or running.returncode not in _STATUSES[kind]:
                how = f"{kind.name} after {moment:.2f} s, status {running.returncode}"
                bad.append(f"{' '.join(words)}: {how}: {told.strip()}")
        over.set()
        spinning.join()
    counts = ", ".join(f"{status}: {count}" for status, count in sorted(statuses.items()))
    return [
        Figure(f"of {interrupts} interrupted commands, ended with noise or another status", str(len(bad))),
        Figure("Python itself was interrupted, before it ran the command: its traceback", str(early)),
        Figure("exit statuses", counts),
        *(Figure("noise", text) for text in bad),
    ]


if __name__ == "__main__":
    given = dict(enumerate(sys.argv))
    for figure in measure(int(given.get(1, INTERRUPTS)), int(given.get(2, _SEED)), given.get(3, "")):
        print(f"{figure.what}: {figure.value}")
