# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A world for tests of the execution queue: its planner, a clock, a driver and a robot."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

import numpy as np

from teo_description.humanoid import load_humanoid
from teo_lut_executor.execution.interface import (
    Activity,
    DriverMode,
    DriverReport,
    Effect,
    Finished,
    HaltReady,
    Outcome,
    PlanWanted,
    QueueSettings,
    ReturnWanted,
    Sentence,
    Status,
    StopReady,
    TrajectoryReady,
)
from teo_lut_executor.execution.queue import ExecutionQueue
from teo_motion.planner import Planner
from teo_motion.sentence.plan import Plan
from teo_motion.trajectory.ruckig_segment import State
from teo_names import COMMANDED_JOINTS
from teo_signs.errors import PlanError
from teo_signs.sign import Sign
from teo_signs.tokens import parse_printed

TICK = 0.02

# Ticks from one word of the driver's to the next while nothing changes: a tenth of a second.
REPORT_TICKS = 5

# A driver takes a motion that begins where the robot will be then, within so much [rad].
START_TOLERANCE = 0.01


class World:
    """A queue, its planner, a clock, and a driver and robot that do what they are sent (or not)."""

    def __init__(self, table: Mapping[str, Sign], settings: QueueSettings | None = None) -> None:
        self.planner = Planner(table)
        self.queue = ExecutionQueue(self.planner.limits, settings)
        self.now = 100.0
        self.obstacle = ""
        self.publishes_states = True
        self.planning_time = 0.0  # [s]
        self.opening_time: float | None = (
            None  # after which an opening is left for the plan; None: no opening
        )
        self.follows: Callable[[Plan], bool] = lambda _: True
        self.sent: list[TrajectoryReady] = []
        self.taken: list[tuple[float, TrajectoryReady | StopReady]] = []  # by the driver, by when it begins
        self.stops: list[StopReady] = []
        self.events: list[Effect] = []
        self.positions = load_humanoid().ready.copy()
        self.velocities = np.zeros(load_humanoid().ready.size)
        self.path: list[tuple[np.ndarray, np.ndarray]] = []  # positions and velocities of every tick
        self.lag = 0.0  # of the robot behind what it was sent [s]
        self.link = 0.0  # of joint states on their way to the executor [s]
        self.pace = 1.0  # path time per time
        self.delay = 0.0  # of motions on their way to the driver [s]
        self.takes_stops = True
        self.accepts: Callable[[TrajectoryReady], bool] = lambda _: True
        self.refused = 0  # motions that began elsewhere, or came too late
        self._mode: DriverMode | None = None  # what the driver was told to be, None: it moves or holds
        self._told: tuple[object, ...] = ()  # of what it said last, what it says at once when it changes
        self._ticks = 0
        self._states: list[tuple[float, list[float], list[float]]] = []  # on their way, by their stamp
        self._mail: list[tuple[float, TrajectoryReady | StopReady]] = []  # by when it reaches the driver
        self._motions: list[tuple[float, Plan]] = []  # by the path time at which each begins
        self._stop: tuple[float, float, np.ndarray, np.ndarray] | None = None
        self._path_time = 0.0
        self._answers: list[tuple[float, Callable[[], list[Effect]]]] = []

    def sign(self, text: str, **fields: object) -> int:
        """Submit a sentence, printed; returns its ticket."""
        sentence = Sentence(tokens=parse_printed(text), **fields)  # type: ignore[arg-type]
        ticket, events = self.queue.submit(sentence, self.now)
        self.take(events)
        return ticket

    def cancel(self, ticket: int) -> None:
        """Cancel a sentence."""
        self.take(self.queue.cancel(ticket, self.now))

    def driver_says(self, mode: DriverMode, *, speed_scaling: float = 1.0) -> None:
        """Let the driver report a mode and a pace."""
        self.pace = 0.0 if mode is DriverMode.PAUSED else speed_scaling
        self._mode = None if mode in (DriverMode.HOLDING, DriverMode.MOVING) else mode
        if self._mode not in (None, DriverMode.PAUSED):
            self._motions, self.velocities = [], np.zeros_like(self.velocities)
        self._report()

    def take(self, events: Iterable[Effect]) -> None:
        """Do what effects ask of the driver and the planner."""
        for event in events:
            self.events.append(event)
            if isinstance(event, PlanWanted | ReturnWanted):
                self._plan(event)
            elif isinstance(event, TrajectoryReady):
                self.sent.append(event)
                if self.follows(event.plan):
                    self._mail.append((self.now + self.delay, event))
            elif isinstance(event, StopReady):
                self.stops.append(event)
                self._mail.append((self.now + self.delay, event))
            elif isinstance(event, HaltReady):
                self.driver_says(DriverMode.STOPPED)
        self._deliver()

    def _deliver(self) -> None:
        due = [event for when, event in self._mail if when <= self.now]
        self._mail = [item for item in self._mail if item[0] > self.now]
        for event in due:
            if isinstance(event, TrajectoryReady):
                self._go(event)
            elif not self.takes_stops:
                self._refuse(event.number)
            elif self._motions or self._stop:
                self.taken.append((self.now, event))
                self._motions = []
                self._stop = self.now, event.lead, self.positions, event.end.position

    def _go(self, event: TrajectoryReady) -> None:
        earlier = event.samples.times[-1] - event.plan.duration  # than the plan begins
        start = self.now if event.start is None else event.start
        begin = self._path_time + (start - self.now) * self.pace + earlier
        elsewhere = np.abs(event.samples.positions[0] - self._position_at(begin - earlier)).max()
        if not self.accepts(event) or start < self.now or elsewhere > START_TOLERANCE:
            self._refuse(event.number)
            return
        self._motions = [item for item in self._motions if item[0] < begin] + [(begin, event.plan)]
        self._stop = None
        self.taken.append((start, event))

    def _report(self) -> None:
        """What the driver says of itself: at once when it changes, and ten times a second while it moves."""
        begun = [item for item in self._motions if item[0] <= self._path_time]
        remaining = None
        if begun and self._mode in (None, DriverMode.PAUSED):
            begin, plan = begun[-1]
            remaining = begin + plan.duration - self._path_time
        moves = self._stop is not None or (remaining is not None and remaining > 0.0)
        mode = self._mode or (DriverMode.MOVING if moves else DriverMode.HOLDING)
        told = (mode, self.pace, begun[-1][0] if begun else None)
        if told == self._told and (mode is not DriverMode.MOVING or self._ticks % REPORT_TICKS):
            return
        self._told = told
        report = DriverReport(
            mode=mode,
            speed_scaling=self.pace,
            stamp=self.now,
            remaining=remaining if mode in (DriverMode.MOVING, DriverMode.PAUSED) else None,
        )
        self.take(self.queue.driver_state(report, self.now))

    def _position_at(self, path_time: float) -> np.ndarray:
        """Where what it was sent has the robot at a path time, if nothing new comes [rad]."""
        position = self.positions
        for begin, plan in self._motions:
            if begin <= path_time:
                position, _ = _sample(plan, path_time - begin)
        return position

    def _refuse(self, number: int) -> None:
        self.refused += 1
        refusal = "[start_mismatch] the robot is elsewhere then"
        self._answers.append((self.now, lambda: self.queue.driver_refused(number, refusal, self.now)))

    def _plan(self, wanted: PlanWanted | ReturnWanted) -> None:
        due, number, start, after = self.now + self.planning_time, wanted.number, wanted.start, 0.0
        try:
            if isinstance(wanted, ReturnWanted):
                plan = self.planner.plan_to_rest(start)
            else:
                tokens = wanted.sentence.tokens
                if wanted.opening and self.opening_time is not None:
                    opened = self.planner.plan_opening(tokens, start, lasting=self.opening_time)
                    assert opened is not None
                    opening, after = opened
                    self._answers.append((self.now, lambda: self.queue.opened(number, opening, self.now)))
                    position, velocity, acceleration = opening.at(after)
                    start = State(position=position, velocity=velocity, acceleration=acceleration)
                plan = self.planner.plan(tokens, start, form=wanted.sentence.form, hold=wanted.hold)
        except PlanError as error:
            refusal = error
            self._answers.append((due, lambda: self.queue.not_planned(number, refusal, self.now)))
        else:
            self._answers.append((due, lambda: self.queue.planned(number, plan, self.now, after=after)))

    def _answer(self) -> None:
        due = [answer for when, answer in self._answers if when <= self.now]
        self._answers = [item for item in self._answers if item[0] > self.now]
        for answer in due:
            self.take(answer())

    def run(self, seconds: float) -> None:
        """Let time pass."""
        end = self.now + seconds
        while self.now < end:
            self.tick()

    def run_until(self, condition: Callable[[], bool], most: float = 120.0) -> None:
        """Let time pass until something holds, at most so long [s]."""
        end = self.now + most
        while not condition():
            assert self.now < end, f"not within {most} s"
            self.tick()

    def tick(self) -> None:
        """Let one period of the node pass."""
        self.now += TICK
        self._path_time += TICK * self.pace
        self._ticks += 1
        self._deliver()
        before = self.positions
        if self._stop is not None:
            began, lead, here, end = self._stop
            share = min((self.now - began) / lead, 1.0)
            self.positions = here + (end - here) * (3.0 * share**2 - 2.0 * share**3)
            self.velocities = (self.positions - before) / TICK
            if share == 1.0 and not self.velocities.any():
                self._stop = None
        for begin, plan in self._motions:
            if self._path_time - self.lag >= begin:
                self.positions, velocities = _sample(plan, self._path_time - self.lag - begin)
                self.velocities = velocities * self.pace
        self.path.append((self.positions, self.velocities))
        if self.publishes_states:
            self._states.append((self.now, self.positions.tolist(), self.velocities.tolist()))
            while self._states and self._states[0][0] <= self.now - self.link:
                stamp, angles, rates = self._states.pop(0)
                self.queue.joint_states(COMMANDED_JOINTS, angles, rates, self.now, stamp=stamp)
            self._report()
        self._answer()
        self.take(self.queue.step(self.now, obstacle=self.obstacle))
        self._answer()
        self.queue.progress(self.now)

    def finished(self) -> list[tuple[int, Outcome]]:
        """Tickets that are done with, and how they ended."""
        return [(event.ticket, event.outcome) for event in self.events if isinstance(event, Finished)]

    def statuses(self) -> list[Status]:
        """Every status, in order."""
        return [event for event in self.events if isinstance(event, Status)]

    def activities(self) -> list[Activity]:
        """What the queue said that it did, in order."""
        return [status.activity for status in self.statuses()]


def _sample(plan: Plan, time: float) -> tuple[np.ndarray, np.ndarray]:
    """Position and velocity between two samples, linearly: ten times as fast as `Plan.at`."""
    after = int(np.clip(np.searchsorted(plan.times, time), 1, len(plan.times) - 1))
    begin, end = plan.times[after - 1], plan.times[after]
    share = float(np.clip((time - begin) / (end - begin), 0.0, 1.0))
    positions = plan.positions[after - 1] + share * (plan.positions[after] - plan.positions[after - 1])
    velocities = plan.velocities[after - 1] + share * (plan.velocities[after] - plan.velocities[after - 1])
    return positions, velocities if time < plan.duration else np.zeros_like(velocities)
