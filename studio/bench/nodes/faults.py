# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What becomes of sentences when something goes wrong at a random moment, and is set right again.

Each time a text of two short sentences is typed; at a random moment a fault begins, and lasts for some
seconds. Another text is typed meanwhile, unless the translator is dead. Then the robot must come to rest,
having kept its speed limits, and every sentence that was published must have been signed or named. A text
that dies with the translator before it was answered can be named by nobody: it is counted.
"""

from __future__ import annotations

import math
import os
import random
import resource
import signal
import subprocess
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path

from rcl_interfaces.srv import SetParameters
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from rosgraph_msgs.msg import Clock
from std_msgs.msg import String
from teo_sign_msgs.msg import SignSentence, SignToken
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint
from witness import Witness

from nodes.bench_node import BenchNode, bench_graph
from report import Figure
from teo_bringup.graph import NODES, SIGNING, executable_of
from teo_lut_executor.node.parameters import PARAMETERS
from teo_names import COMMANDED_JOINTS

_TEXT = "Hola. Sí."
_LONGEST = 8.0  # [s] until the text is signed, about
_LASTING = (1.0, 8.0)  # [s] for which a fault lasts; a supervisor starts a process again after about a second
_PROCESSES = (*SIGNING, "planner")
_NODES = ("translator", "executor", "teo_sim_driver")
_AT_ONCE = 2  # parameters that change together
_JUMP = 60.0  # [s] by which the clock jumps at most, either way
_TICK = 0.01  # [s] between two times that the clock tells
_AGAIN = 0.5  # [s] between two messages of a stranger
# [s] until all is at rest again: an executor and its planner load for 7 s of a core, which are minutes where
# seven processes of higher priority wait for each.
_TIMEOUT = 900.0


class _World:
    """The nodes that sign, each a process, and somebody beside them who makes trouble."""

    def __init__(self, node: BenchNode, journal: Path, dice: random.Random) -> None:
        self.node, self.dice, self.witness = node, dice, Witness()
        self._journal = journal
        self._running: dict[str, subprocess.Popen[bytes]] = {}
        self.trajectories = node.create_publisher(JointTrajectory, "joint_trajectory", 10)
        kept = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)  # as the translator's
        self.sentences = node.create_publisher(SignSentence, "sign_tokens", kept)
        self.clock = node.create_publisher(Clock, "/clock", 10)
        node.spin_too(self.witness)

    def start(self, name: str) -> None:
        """Start a node."""
        command = [str(executable_of(*NODES[name]))]
        if name == "executor":
            command += ["--ros-args", "-p", f"journal:={self._journal}"]
        quiet = subprocess.DEVNULL
        self._running[name] = subprocess.Popen(command, stdout=quiet, stderr=quiet)

    def send(self, name: str, number: signal.Signals) -> None:
        """Send a process a signal."""
        if name in self._running:
            self._running[name].send_signal(number)
            return
        # The planner is the executor's only child, which starts it again.
        parent = self.pid("executor")
        for child in Path(f"/proc/{parent}/task/{parent}/children").read_text().split():
            with suppress(ProcessLookupError):
                os.kill(int(child), number)

    def pid(self, name: str) -> int:
        """A node's process."""
        return self._running[name].pid

    def set(self, name: str, values: Mapping[str, bool | int | float]) -> None:
        """Set parameters of a node; values that do not go together stay as they were."""
        client = self.node.create_client(SetParameters, f"{name}/set_parameters")
        self.node.wait_for(f"{name}'s parameters", client.service_is_ready, _TIMEOUT)
        parameters = [Parameter(key, value=value).to_parameter_msg() for key, value in values.items()]
        answer = client.call_async(SetParameters.Request(parameters=parameters))
        self.node.wait_for(f"an answer of {name}", answer.done, _TIMEOUT)
        self.node.destroy_client(client)

    def end(self) -> None:
        """End all processes."""
        for process in self._running.values():
            process.kill()
            process.wait()
        self.witness.destroy_node()


@contextmanager
def _killed(world: _World) -> Iterator[str]:
    victim = world.dice.choice(_PROCESSES)
    world.send(victim, signal.SIGKILL)
    yield victim
    if victim != "planner":
        world.start(victim)


@contextmanager
def _stopped(world: _World) -> Iterator[str]:
    victim = world.dice.choice(_PROCESSES)
    world.send(victim, signal.SIGSTOP)
    yield victim
    world.send(victim, signal.SIGCONT)


@contextmanager
def _bad_messages(world: _World) -> Iterator[str]:
    point = JointTrajectoryPoint(positions=[0.0] * len(COMMANDED_JOINTS))
    unknown = JointTrajectory(joint_names=["foo"], points=[JointTrajectoryPoint(positions=[0.0])])
    standing = JointTrajectory(joint_names=list(COMMANDED_JOINTS), points=[point, point])
    endless = JointTrajectoryPoint(positions=[math.nan] * len(COMMANDED_JOINTS))
    of_no_number = JointTrajectory(joint_names=list(COMMANDED_JOINTS), points=[endless])
    good = SignToken(gloss="HOLA", duration_scale=1.0)
    tokens: tuple[list[SignToken], ...] = (
        [],
        [SignToken(gloss="Ω", duration_scale=1.0)],
        [SignToken(gloss="HOLA", kind=99, duration_scale=1.0)],
        [SignToken(gloss="HOLA", duration_scale=math.nan)],
        [good] * 250,
    )

    def talk() -> None:
        world.trajectories.publish(world.dice.choice((unknown, standing, of_no_number)))
        name = f"stranger {world.dice.getrandbits(64):x}"
        message = SignSentence(utterance_id=name, sentence_count=1, tokens=world.dice.choice(tokens))
        world.sentences.publish(message)

    timer = world.node.create_timer(_AGAIN, talk)
    yield ""
    world.node.destroy_timer(timer)


@contextmanager
def _other_parameters(world: _World) -> Iterator[str]:
    rows = [row for row in PARAMETERS if row.low is not None and not row.read_only]
    values: dict[str, bool | int | float] = {}
    defaults: dict[str, bool | int | float] = {}
    for row in world.dice.sample(rows, _AT_ONCE):
        assert row.low is not None and row.high is not None and isinstance(row.default, int | float)
        ends = row.low, row.high, world.dice.uniform(row.low, row.high)
        values[row.name] = type(row.default)(world.dice.choice(ends))
        defaults[row.name] = row.default
    world.set("executor", values)
    yield ", ".join(f"{name} {value:g}" for name, value in values.items())
    world.set("executor", defaults)


@contextmanager
def _clock_that_jumps(world: _World) -> Iterator[str]:
    offset = 0.0

    def tell() -> None:
        message = Clock()
        message.clock.sec, message.clock.nanosec = divmod(time.time_ns() + round(offset * 1e9), 10**9)
        world.clock.publish(message)

    # All go by a clock that tells the time as theirs does, and then another.
    timer = world.node.create_timer(_TICK, tell)
    for name in _NODES:
        world.set(name, {"use_sim_time": True})
    offset = world.dice.uniform(-_JUMP, _JUMP)
    yield f"by {offset:.0f} s"
    offset = 0.0
    for name in _NODES:
        world.set(name, {"use_sim_time": False})
    world.node.destroy_timer(timer)


@contextmanager
def _full_disk(world: _World) -> Iterator[str]:
    # No file takes another byte from the executor, as on a full disk, for which one would have to be root.
    process = world.pid("executor")
    limits = resource.prlimit(process, resource.RLIMIT_FSIZE)
    resource.prlimit(process, resource.RLIMIT_FSIZE, (0, limits[1]))
    yield ""
    resource.prlimit(process, resource.RLIMIT_FSIZE, limits)


_FAULTS: Mapping[str, Callable[[_World], AbstractContextManager[str]]] = {
    "a process killed": _killed,
    "a process stopped and continued": _stopped,
    "a stranger's bad messages": _bad_messages,
    "other parameters in their range": _other_parameters,
    "a clock that jumps, and back": _clock_that_jumps,
    "a full disk": _full_disk,
}


@dataclass
class _Tally:
    """What one kind of fault did."""

    rounds: int = 0
    outcomes: Counter[str] = field(default_factory=Counter)
    lost: list[str] = field(default_factory=list)
    unanswered: int = 0
    restless: list[str] = field(default_factory=list)

    def figure(self, kind: str) -> Figure:
        """The same as a row."""
        named = {code: count for code, count in self.outcomes.most_common() if code != "signed"}
        codes = ", ".join(f"{count} {code}" for code, count in named.items())
        told = [
            f"signed {self.outcomes['signed']}",
            f"named {sum(named.values())}{f' ({codes})' if codes else ''}",
            f"lost {len(self.lost)}{f' ({self.lost})' if self.lost else ''}",
            f"not at rest afterwards {len(self.restless)}{f' ({self.restless})' if self.restless else ''}",
        ]
        if self.unanswered:
            told.append(f"texts that died with the translator {self.unanswered}")
        return Figure(f"{kind}, {self.rounds} times", "; ".join(told))


def measure(minutes: float = 5.0, seed: int = 13) -> list[Figure]:
    """Have each kind of fault as often as the others for so long, and count what is lost."""
    dice = random.Random(seed)
    tallies = {kind: _Tally() for kind in _FAULTS}
    fastest = longest = 0.0
    with bench_graph() as (node, _), tempfile.TemporaryDirectory() as journal:
        world = _World(node, Path(journal), dice)
        try:
            for name in SIGNING:
                world.start(name)
            end = time.monotonic() + 60.0 * minutes
            kinds: list[str] = []
            while time.monotonic() < end:
                kinds = kinds or dice.sample(sorted(_FAULTS), len(_FAULTS))
                kind = kinds.pop()
                seconds, speed = _round(world, kind, tallies[kind])
                longest, fastest = max(longest, seconds), max(fastest, speed)
        finally:
            world.end()
    return [
        *(tally.figure(kind) for kind, tally in tallies.items()),
        Figure("longest from the end of a fault until all is signed and at rest", f"{longest:.0f} s"),
        Figure("greatest speed over the limit", f"{fastest:.3f}"),
    ]


def _round(world: _World, kind: str, tally: _Tally) -> tuple[float, float]:
    """Have one fault; give the time until all is well again [s], and the greatest speed over the limit."""
    node, witness = world.node, world.witness
    node.until(lambda: witness.at_rest, _TIMEOUT)
    witness.forget()
    moment = world.dice.uniform(0.0, _LONGEST)
    witness.texts.publish(String(data=_TEXT))
    typed = 1
    node.spin(moment)
    with _FAULTS[kind](world) as detail:
        if kind != "a process killed" or detail != "translator":
            witness.texts.publish(String(data=_TEXT))
            typed += 1
        node.spin(world.dice.uniform(*_LASTING))
        witness.heard.clear()  # whoever is well is heard again
    began = time.monotonic()
    what = f"{detail} after {moment:.1f} s".strip()
    # A process that goes on may publish what the executor has not heard of yet.
    if not node.until(lambda: witness.at_rest and witness.sentences <= witness.accounted.keys(), _TIMEOUT):
        tally.restless.append(f"{what}: {witness.unrest}")
    of_texts = {name for name in witness.answered if not name.startswith("stranger")}
    tally.rounds += 1
    tally.unanswered += typed - len(of_texts)
    tally.lost += [what for _ in witness.sentences - witness.accounted.keys()]
    tally.outcomes.update(witness.accounted.values())
    print(f"{kind}: {what}: {', '.join(sorted(witness.accounted.values()))}", flush=True)
    return time.monotonic() - began, witness.fastest()
