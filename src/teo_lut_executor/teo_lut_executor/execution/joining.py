# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Sentences in a row: the next is planned while one is signed, and continues it without a way to rest.

It is planned from the state in which the one before ends its last sign (or, if it comes later, from the
state on the way down), and is sent to start there.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass

from teo_lut_executor.execution.events import Event, PlanWanted
from teo_lut_executor.execution.job import Job
from teo_lut_executor.execution.path_monitor import PathMonitor
from teo_lut_executor.execution.seam import last_seam
from teo_lut_executor.execution.situation import Situation
from teo_motion.sentence.plan import Plan

# With less time than this the driver might get a continuation too late [s]: a period of points, and the
# message's way.
LEAST_AHEAD = 0.07

# A motion that continues another is sent this long before it is to take over [s]: late enough that plans can
# still change, early enough for a loaded machine.
_SEND_AHEAD = 0.5

# On its way to rest a robot is nearly there when so little is left [s]: nothing is won by joining.
_NEARLY_AT_REST = 0.3


@dataclass(kw_only=True, eq=False)
class _Join:
    """The next sentence, in preparation to continue the present one."""

    number: int
    job: Job
    splice: float  # path time of the present motion at which it takes over [s]
    plan: Plan | None = None


class Joining:
    """Has the next sentence planned so that it continues the present one."""

    def __init__(self, situation: Situation, waiting: deque[Job], numbers: Iterator[int]) -> None:
        """Begin with nothing in preparation.

        Args:
            situation: What is known at the moment.
            waiting: Sentences that wait; the first is the one that joins.
            numbers: For plans that are wanted.
        """
        self._situation = situation
        self._waiting = waiting
        self._numbers = numbers
        self._join: _Join | None = None

    def drop(self, job: Job | None = None) -> None:
        """Forget what is in preparation, if it is this sentence, or whatever it is."""
        if job is None or (self._join is not None and self._join.job is job):
            self._join = None

    def planned(self, number: int, plan: Plan) -> bool:
        """Take a plan; tell whether it was wanted here."""
        if self._join is None or number != self._join.number:
            return False
        self._join.plan = plan
        return True

    def not_planned(self, number: int) -> Job | None:
        """Give up joining; the sentence that does not join, None if the plan was not wanted here."""
        join = self._join
        if join is None or number != join.number:
            return None
        self._join = None
        join.job.joins = False
        return join.job

    def want(self, current: Job, motion: PathMonitor) -> list[Event]:
        """Ask for a plan of the next sentence, unless it is there or under way in time."""
        join = self._join
        if join is None:
            return self._ask(current, motion)
        if join.plan is None or join.splice - motion.elapsed >= LEAST_AHEAD:
            return []
        self._join = None
        join.job.planning_time *= 2.0
        return self._ask(current, motion)

    def due(self, motion: PathMonitor) -> tuple[Plan, float] | None:
        """A plan that is to be sent now, and the path time at which it takes over [s]; None if none is."""
        join = self._join
        if join is None or join.plan is None:
            return None
        if join.splice - motion.elapsed > _SEND_AHEAD:
            return None
        self._join = None
        join.job.plan = join.plan
        return join.plan, join.splice

    def _ask(self, current: Job, motion: PathMonitor) -> list[Event]:
        if not self._waiting or not self._waiting[0].joins:
            return []
        job, last = self._waiting[0], motion.motion.timings[-1]
        end = last.start + last.duration
        earliest = motion.elapsed + job.planning_time
        waits = not current.canceled and earliest <= end
        splice = last_seam(motion.motion, end if waits else earliest)
        if splice > motion.motion.duration - _NEARLY_AT_REST:
            return []
        hold = self._situation.settings.sentence_pause + end - splice if waits else 0.0
        self._join = _Join(number=next(self._numbers), job=job, splice=splice)
        start = motion.state_at(splice)
        return [PlanWanted(number=self._join.number, sentence=job.sentence, start=start, hold=hold)]
