# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the executor has done so far, and how it is."""

from __future__ import annotations

from collections import Counter, deque
from dataclasses import dataclass, field

import numpy as np

from teo_common.diagnostics import Diagnosis, Level
from teo_lut_executor.execution.interface import Activity, Outcome, Status
from teo_lut_executor.execution.journal import Journal

# Latest plans whose times are kept; enough for a 99th percentile.
_KEPT = 1000

_LEVELS = {
    Activity.FAULT: Level.ERROR,
    Activity.STOPPED: Level.WARN,
    Activity.PAUSED: Level.WARN,
}


@dataclass
class Statistics:
    """Counts of sentences, and how long planning took.

    Attributes:
        ended: Sentences by how they ended.
        codes: Refusals and faults by code.
        last_problem: Code and sentence of the latest of them; empty if there was none.
        status: What was told last, refusals aside.
    """

    ended: Counter[Outcome] = field(default_factory=Counter)
    codes: Counter[str] = field(default_factory=Counter)
    last_problem: str = ""
    status: Status | None = None
    _planning: deque[float] = field(default_factory=lambda: deque(maxlen=_KEPT))

    def add_plan(self, took: float) -> None:
        """Count a plan and how long it took [s]."""
        self._planning.append(took)

    def add_status(self, status: Status) -> None:
        """Take what is told to everybody."""
        if status.code:
            self.codes[status.code] += 1
            self.last_problem = f"[{status.code}] {status.message}"
        if status.activity != Activity.REFUSED:
            self.status = status

    def planning(self, percentile: float) -> str:
        """A percentile, 0 to 100, of planning times in milliseconds; empty if there are none."""
        times = list(self._planning)
        return f"{float(np.percentile(times, percentile)) * 1000.0:.0f}" if times else ""


def diagnose(
    statistics: Statistics,
    *,
    active: bool,
    queued: int,
    planner_restarts: int,
    others_refused: int,
    journal: Journal,
) -> Diagnosis:
    """How the executor is; a sentence that it refuses is no fault of its own.

    Args:
        statistics: What it has done.
        active: Whether it may move the robot.
        queued: Sentences that wait.
        planner_restarts: How often the process that plans has died.
        others_refused: Trajectories of others that the driver has refused.
        journal: Where sentences are written down.
    """
    status = statistics.status
    activity = Activity.WAITING if status is None else status.activity
    values = {
        "state": activity.name if active else "inactive",
        "sentences waiting": str(queued),
        **{f"sentences {outcome.name}": str(statistics.ended[outcome]) for outcome in Outcome},
        "planning median [ms]": statistics.planning(50.0),
        "planning p99 [ms]": statistics.planning(99.0),
        "planner restarts": str(planner_restarts),
        "trajectories of others refused": str(others_refused),
        "journal problem": journal.problem,
        "journal lines spoilt": str(journal.unread),
        "last problem": statistics.last_problem,
        **{f"problem {code}": str(count) for code, count in sorted(statistics.codes.items())},
    }
    message = status.message if active and status is not None else values["state"]
    level = _LEVELS.get(activity, Level.OK) if active else Level.OK
    if journal.problem:
        level = max(level, Level.WARN)
        message += f"; a killed executor would forget sentences: {journal.problem}"
    return Diagnosis(level, message, values)
