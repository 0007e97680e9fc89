# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What becomes of sentences when a process is killed with SIGKILL at a random moment, and started again.

Each time a text of two short sentences is typed; at a random moment translator, executor, its planner or the
driver is killed, and started again a second later, as a supervisor would. Another text is typed meanwhile,
unless it is the translator that is dead. Then the robot must come to rest, having kept its speed limits, and
every sentence that the translator published must have been signed or named. A text that dies with the
translator before it was answered can be named by nobody: it is counted.
"""

from __future__ import annotations

import os
import random
import signal
import subprocess
import tempfile
import time
from collections import Counter
from pathlib import Path

from std_msgs.msg import String
from witness import Witness

from nodes.bench_node import bench_graph
from report import Figure
from teo_bringup.graph import NODES, SIGNING, executable_of

_TEXT = "Hola. Sí."
_LONGEST = 8.0  # [s] until the text is signed, about
_VICTIMS = ("translator", "executor", "planner", "driver")
# [s] until all is at rest again: an executor and its planner load for 7 s of a core, which are minutes where
# seven processes of higher priority wait for each.
_TIMEOUT = 900.0
_RESTART = 1.0  # [s] after which a supervisor starts a process again


class _Processes:
    """The nodes that sign, each a process that can be killed."""

    def __init__(self, journal: Path) -> None:
        self._journal = journal
        self._running: dict[str, subprocess.Popen[bytes]] = {}

    def start(self, name: str) -> None:
        command = [str(executable_of(*NODES[name]))]
        if name == "executor":
            command += ["--ros-args", "-p", f"journal:={self._journal}"]
        quiet = subprocess.DEVNULL
        self._running[name] = subprocess.Popen(command, stdout=quiet, stderr=quiet)

    def kill(self, name: str) -> None:
        if name == "planner":  # the executor's only child, which starts it again
            parent = self._running["executor"].pid
            for child in Path(f"/proc/{parent}/task/{parent}/children").read_text().split():
                os.kill(int(child), signal.SIGKILL)
        else:
            self._running[name].kill()
            self._running[name].wait()

    def end(self) -> None:
        for process in self._running.values():
            process.kill()
            process.wait()


def measure(kills: int = 20, seed: int = 13) -> list[Figure]:
    """Kill processes at random moments, each as often as the others, and count what is lost."""
    dice = random.Random(seed)
    lost: list[str] = []
    restless: list[str] = []
    unanswered = 0
    outcomes: Counter[str] = Counter()
    fastest = longest = 0.0
    with bench_graph() as (node, _), tempfile.TemporaryDirectory() as journal:
        processes, witness = _Processes(Path(journal)), Witness()
        node.spin_too(witness)
        try:
            for name in SIGNING:
                processes.start(name)
            for index in range(kills):
                node.until(lambda: witness.at_rest, _TIMEOUT)
                victim, moment = _VICTIMS[index % len(_VICTIMS)], dice.uniform(0.0, _LONGEST)
                witness.texts.publish(String(data=_TEXT))
                typed = 1
                node.spin(moment)
                processes.kill(victim)
                if victim != "translator":
                    witness.texts.publish(String(data=_TEXT))
                    typed += 1
                node.spin(_RESTART)
                witness.heard.clear()  # what was restarted is there when it is heard again
                if victim != "planner":
                    processes.start(victim)
                began = time.monotonic()
                what = f"{victim} after {moment:.1f} s"
                if not node.until(lambda: witness.at_rest, _TIMEOUT):
                    restless.append(f"{what}: {witness.unrest}")
                longest = max(longest, time.monotonic() - began)
                unanswered += typed - len(witness.answered)
                lost += [what for _ in witness.sentences - witness.accounted.keys()]
                outcomes.update(witness.accounted.values())
                fastest = max(fastest, witness.fastest())
                witness.forget()
        finally:
            processes.end()
            witness.destroy_node()
    told = ", ".join(f"{count} {outcome}" for outcome, count in outcomes.most_common())
    return [
        Figure(f"sentences after {kills} kills", told),
        Figure("sentences neither signed nor named", f"{len(lost)} {'; '.join(lost)}".strip()),
        Figure("texts that died with the translator, unanswered", str(unanswered)),
        Figure("kills after which the robot did not come to rest", f"{len(restless)} {'; '.join(restless)}"),
        Figure("longest from a restart until all is signed and at rest", f"{longest:.0f} s"),
        Figure("greatest speed over the limit", f"{fastest:.3f}"),
    ]
