# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The one situation that all pages share: nodes, robot, sentences, speech; time comes as an argument."""

from __future__ import annotations

from dataclasses import dataclass
from typing import get_args

from msgspec.structs import replace

from teo_common.diagnostics import DIAGNOSTICS_PERIOD, Level
from teo_console.errors import ConsoleError
from teo_console.protocol import (
    TEXT_LENGTH,
    Health,
    NodeRole,
    NodeState,
    Queued,
    Refusal,
    Robot,
    RobotMode,
    Sentence,
    Situation,
    Spoken,
)
from teo_console.sentences import PathReport, Sentences, SigningReport

ROLES: tuple[NodeRole, ...] = get_args(NodeRole)

# Silence after which a node counts as silent [s]. Diagnostics come once a second: two may be missed, half a
# second is for a loaded machine. Joint states come a hundred times a second; a busy machine withholds them
# for half a second, which is over before anybody has read of it.
_SILENCE: dict[NodeRole, float] = {
    "translator": 2.5 * DIAGNOSTICS_PERIOD,
    "executor": 2.5 * DIAGNOSTICS_PERIOD,
    "driver": 1.0,
}


@dataclass
class _Heard:
    """What is known of one node."""

    present: bool = False
    """Whether its topic has a publisher."""
    at: float | None = None
    """When it was heard last [s]."""
    level: Level = Level.OK
    message: str = ""

    def health(self, role: NodeRole, now: float) -> Health:
        """How the node of a role is."""
        quiet = 0.0 if self.at is None else max(now - self.at, 0.0)
        state: NodeState
        if not self.present:
            state = "missing"
        elif self.at is None or quiet >= _SILENCE[role]:
            state = "silent"
        elif self.level is not Level.OK:
            state = "unwell"
        else:
            state = "alive"
        return Health(
            role=role,
            state=state,
            message=self.message if state == "unwell" else "",
            # Whole seconds: what is shown, and no reason to tell all pages the same thing ten times a second.
            quiet=float(int(quiet)) if state in ("silent", "missing") else 0.0,
        )


# What a recogniser says while nobody looks is not worth keeping beyond a few sentences.
MOST_WAITING = 5


class SpokenTexts:
    """Texts that wait for a page to confirm or discard them."""

    def __init__(self) -> None:
        """Begin without a text."""
        self._waiting: dict[str, Spoken] = {}
        self._count = 0

    def hear(self, text: str) -> None:
        """Take a text.

        Raises:
            ConsoleError: "empty_speech", "speech_too_long": nothing is kept of it.
        """
        text = " ".join(text.split())
        if not text:
            raise ConsoleError("empty_speech", "expected words on the topic speech, got none")
        if len(text) > TEXT_LENGTH:
            raise ConsoleError(
                "speech_too_long",
                f"expected at most {TEXT_LENGTH} characters on the topic speech, got {len(text)}",
            )
        self._count += 1
        self._waiting[str(self._count)] = Spoken(id=str(self._count), text=text)
        while len(self._waiting) > MOST_WAITING:
            del self._waiting[next(iter(self._waiting))]

    def take(self, spoken: str) -> Spoken:
        """Give a text and keep it no longer: of two pages, the first that confirms or discards has it.

        Raises:
            ConsoleError: "not_waiting": another page was first, or there was none.
        """
        try:
            return self._waiting.pop(spoken)
        except KeyError:
            raise ConsoleError(
                "not_waiting", f"expected a text that waits, got {spoken!r}: another page may have taken it"
            ) from None

    @property
    def waiting(self) -> tuple[Spoken, ...]:
        """What waits, the oldest first."""
        return tuple(self._waiting.values())


# Tasks under which nodes report their health on `diagnostics`: "<node>: <task>", whatever the node is called.
_TASKS: dict[str, NodeRole] = {"texts": "translator", "sentences": "executor", "joints": "driver"}


def diagnosed_node(name: str) -> NodeRole | None:
    """Whose health a status of `diagnostics` tells, by its name; None: that of a stranger."""
    return _TASKS.get(name.rpartition(": ")[2])


class SharedSituation:
    """Takes what the nodes say, gives what pages show."""

    def __init__(self) -> None:
        """Begin with nobody heard."""
        self.spoken = SpokenTexts()
        self._nodes = {role: _Heard() for role in ROLES}
        self._sentences = Sentences()
        self._queue: tuple[Queued, ...] = ()
        self._refusal: Refusal | None = None
        self._robot = Robot(
            mode="unknown",
            message="",
            executor="unknown",
            executor_code="",
            executor_message="",
            speed=1.0,
            speed_wanted=1.0,
        )

    def publishers(self, role: NodeRole, *, present: bool) -> None:
        """Enter whether anybody publishes a node's topic."""
        self._nodes[role].present = present

    def joints(self, now: float) -> None:
        """A joint state has come."""
        self._nodes["driver"].at = now

    def diagnosis(self, name: str, level: Level, message: str, now: float) -> None:
        """Take one status of `diagnostics`; those of others are passed over."""
        role = diagnosed_node(name)
        if role is None:
            return
        node = self._nodes[role]
        if role != "driver":  # whose joint states tell sooner
            node.at = now
        node.level, node.message = level, message

    def tokens(self, sentence: Sentence) -> None:
        """Take a sentence of the translator's."""
        self._sentences.announce(sentence)

    def refused_text(self, refusal: Refusal) -> None:
        """Take a text that the translator refused."""
        self._refusal = refusal

    def executor(self, report: SigningReport) -> None:
        """Take what the executor says."""
        self._sentences.report(report)
        self._robot = replace(
            self._robot,
            executor=report.state,
            executor_code=report.code,
            executor_message=report.message,
        )

    def driver(self, mode: RobotMode, message: str, path: PathReport) -> None:
        """Take what the driver says."""
        self._robot = replace(self._robot, mode=mode, message=message, speed=path.speed)
        self._sentences.path(path)

    def queue(self, queue: tuple[Queued, ...]) -> None:
        """Take the executor's queue."""
        self._queue = queue

    def speed_wanted(self, factor: float) -> None:
        """Enter the speed that a page has asked for."""
        self._robot = replace(self._robot, speed_wanted=factor)

    def snapshot(self, now: float, *, pages: int) -> Situation:
        """What pages show now.

        Args:
            now: Time [s].
            pages: Pages that are open.
        """
        return Situation(
            stamp=now,
            nodes=tuple(node.health(role, now) for role, node in self._nodes.items()),
            robot=self._robot,
            current=self._sentences.current,
            progress=self._sentences.progress,
            queue=self._queue,
            history=self._sentences.history,
            spoken=self.spoken.waiting,
            refusal=self._refusal,
            pages=pages,
        )
