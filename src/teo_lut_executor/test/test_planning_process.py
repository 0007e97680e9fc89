# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A planner that dies or hangs costs time, and no more than the sentence that does it twice."""

from __future__ import annotations

import os
import signal
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from teo_description.humanoid import load_humanoid
from teo_lut_executor import planning_process
from teo_lut_executor.execution.interface import PlanWanted, Sentence
from teo_lut_executor.planning_process import PlanningProcess
from teo_lut_executor.planning_worker import Answer, NotPlanned, Planned, PlannerSettings
from teo_motion.trajectory.ruckig_segment import State
from teo_signs.tokens import parse_printed

REST = load_humanoid().ready


class Planning(PlanningProcess):
    """One whose answers are kept."""

    def __init__(self, table: Path) -> None:
        self.heard: list[Answer] = []
        self._woken = threading.Event()
        super().__init__(PlannerSettings(lut_directory=table), self._woken.set)
        self.until(lambda: self.ready)

    def want(self, number: int) -> None:
        sentence = Sentence(tokens=parse_printed("A"))
        self.ask(PlanWanted(number=number, sentence=sentence, start=State.still(REST)))

    def until(self, condition: Callable[[], bool]) -> None:
        deadline = time.monotonic() + 60.0
        while not condition():
            assert time.monotonic() < deadline, "it did not happen in time"
            self._woken.wait(1.0)
            self._woken.clear()
            self.heard += self.answers()

    def plans(self) -> list[tuple[int, str]]:
        """Number of each request that was answered, and its code; empty for a plan."""
        return [
            (answer.number, answer.code if isinstance(answer, NotPlanned) else "")
            for answer in self.heard
            if isinstance(answer, NotPlanned | Planned)
        ]

    def end(self, how: signal.Signals) -> None:
        os.kill(self.pid, how)


@pytest.fixture
def planning(table_directory: Path) -> Iterator[Planning]:
    planning = Planning(table_directory)
    yield planning
    planning.close()


@pytest.mark.slow
def test_a_planner_that_hangs_is_started_again_and_plans_what_it_was_asked(
    planning: Planning, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(planning_process, "_PLANNING_DEADLINE", 1.0)
    monkeypatch.setattr(planning_process, "_PLANNING_DEADLINE_OF_TOKEN", 0.0)
    planning.end(signal.SIGSTOP)
    planning.want(1)
    planning.want(2)
    monkeypatch.setattr(planning_process, "_PLANNING_DEADLINE", 30.0)
    planning.until(lambda: len(planning.plans()) == 2)
    assert planning.plans() == [(1, ""), (2, "")]
    assert planning.restarts == 1


@pytest.mark.slow
def test_what_a_planner_dies_of_twice_is_named_and_the_others_are_planned(planning: Planning) -> None:
    first = planning.pid
    planning.end(signal.SIGSTOP)
    planning.want(1)
    planning.want(2)
    planning.end(signal.SIGKILL)
    planning.until(lambda: planning.pid != first)
    planning.end(signal.SIGKILL)
    planning.until(lambda: len(planning.plans()) == 2)
    assert planning.plans() == [(1, "planner_lost"), (2, "")]
