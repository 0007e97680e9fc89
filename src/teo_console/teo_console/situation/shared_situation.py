# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The one situation that all pages share."""

from __future__ import annotations

from msgspec.structs import replace

from teo_common.diagnostics import Level
from teo_console.protocol.to_page import (
    NodeRole,
    Queued,
    Refusal,
    Robot,
    RobotMode,
    Sentence,
    Situation,
)
from teo_console.situation.liveness import Liveness
from teo_console.situation.sentences import PathReport, Sentences, SigningReport
from teo_console.situation.spoken import SpokenTexts

# Tasks under which nodes report their health on `diagnostics`: "<node>: <task>", whatever the node is called.
_TASKS: dict[str, NodeRole] = {"texts": "translator", "sentences": "executor", "joints": "driver"}


class SharedSituation:
    """Takes what the nodes say, gives what pages show."""

    def __init__(self) -> None:
        """Begin with nobody heard."""
        self.spoken = SpokenTexts()
        self._liveness = Liveness()
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
        self._liveness.seen(role, present=present)

    def joints(self, now: float) -> None:
        """A joint state has come."""
        self._liveness.heard("driver", now)

    def diagnosis(self, name: str, level: Level, message: str, now: float) -> None:
        """Take one status of `diagnostics`; those of others are passed over."""
        role = _TASKS.get(name.rpartition(": ")[2])
        if role is not None:
            if role != "driver":  # whose joint states tell sooner
                self._liveness.heard(role, now)
            self._liveness.diagnosed(role, level, message)

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
        progress = self._sentences.progress
        return Situation(
            stamp=now,
            nodes=self._liveness.report(now),
            robot=self._robot,
            current=self._sentences.current,
            progress=None if progress is None else progress.report(),
            queue=self._queue,
            history=self._sentences.history,
            spoken=self.spoken.waiting,
            refusal=self._refusal,
            pages=pages,
        )
