# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The sentence at hand, and what the robot does for it: from a standstill to rest, or on to the next."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from dataclasses import replace

from teo_lut_executor.execution.announcements import Announcements, finished
from teo_lut_executor.execution.events import (
    Activity,
    Begun,
    DriverMode,
    Event,
    Outcome,
    PlanWanted,
    Progress,
    ReturnWanted,
    TrajectoryReady,
)
from teo_lut_executor.execution.halt import Halt
from teo_lut_executor.execution.job import Job, Phase
from teo_lut_executor.execution.joining import LEAST_AHEAD, Joining
from teo_lut_executor.execution.motions import Motions
from teo_lut_executor.execution.path_monitor import PathMonitor
from teo_lut_executor.execution.seam import continued
from teo_lut_executor.execution.situation import Situation
from teo_motion.sentence.plan import Plan
from teo_signs.errors import PlanError

# A motion from a standstill is sent to start so much later [s]: the message's way to the driver, and its
# check there; on two cores with a load of ten they took more than 0.05 s. A driver that gets it later drops
# the points that have passed, or refuses it.
_START_LEAD = 0.1

# How often the way to rest is tried after an interrupted sentence, before the robot is left where it is.
_MOST_RETURNS = 3

# Errors of planning that lie in where the robot is, not in the sentence: from a standstill it may go well.
_OF_THE_START = ("self_collision", "outside_limits", "start_outside_limits", "bad_start", "no_timing")


class Signing:
    """Signs one sentence after the other, and follows the robot meanwhile.

    Attributes:
        current: The sentence at hand, if any.
    """

    def __init__(
        self,
        situation: Situation,
        waiting: deque[Job],
        announcements: Announcements,
        numbers: Iterator[int],
    ) -> None:
        """Begin at a standstill.

        Args:
            situation: What is known at the moment.
            waiting: Sentences that wait; the first is taken when its time comes.
            announcements: What is told.
            numbers: For motions, and plans that are wanted.
        """
        self._situation = situation
        self._waiting = waiting
        self._announcements = announcements
        self._numbers = numbers
        self._motions = Motions()
        self._joining = Joining(situation, waiting, numbers)
        self._halt = Halt(situation)
        self._phase = Phase.RESTING
        self.current: Job | None = None
        self._asked = 0  # number of the plan that is awaited while standing or opening; 0 if none
        self._astray = False  # whether the robot was left somewhere, and is to be brought to rest
        self._returns = 0

    def tick(self, path_time: float, clock_set: float) -> None:
        """Let path time pass, and follow a clock that was set; both [s]."""
        self._halt.shift_clock(clock_set)
        self._motions.advance(path_time)

    def tell(self) -> list[Event]:
        """The present status, if it is not what was told last."""
        return self._announcements.tell(self._phase, self.current, astray=self._astray)

    def synchronise(self, remaining: float) -> None:
        """Take the driver's word for the path time that is left to the end [s]."""
        self._motions.synchronise(remaining)

    def step(self) -> list[Event]:
        """Notice what time has brought."""
        events = self.end_if_blocked() + self._lost() + self._take_over()
        match self._phase:
            case Phase.SIGNING | Phase.RETURNING:
                events += self._follow()
            case Phase.STOPPING:
                events += self._await_standstill()
        if self._phase is Phase.SIGNING:
            events += self._join()
        if self._phase is Phase.RESTING:
            events += self._begin()
        return events

    def opened(self, number: int, plan: Plan) -> list[Event]:
        """Take the first motion of a sentence; the whole follows."""
        if number != self._asked or self.current is None or self.current.canceled:
            return []
        return self._send(plan, self._situation.now + _START_LEAD)

    def planned(self, number: int, plan: Plan, after: float) -> list[Event]:
        """Take a plan that was wanted.

        Args:
            number: Of the request.
            plan: The motion.
            after: Time from the start of the opening at which the plan takes over [s].
        """
        if self._joining.planned(number, plan):
            return self._join()
        if number != self._asked:
            return []
        now, current, opening = self._situation.now, self.current, self._motions.present
        if opening is None:
            self._asked = 0
            if current is not None:
                current.plan = None if current.canceled else plan
            signs = current is not None and not current.canceled
            self._phase = Phase.SIGNING if signs else Phase.RETURNING
            return self._send(plan, now + _START_LEAD) + self.tell()
        assert current is not None
        ahead = after - opening.elapsed if after > 0.0 else opening.motion.duration - opening.elapsed
        if after > 0.0 and ahead < LEAST_AHEAD:
            return self._ask_from_end(current, opening)
        self._asked = 0
        current.plan = plan
        if after == 0.0:  # it begins where the opening has come to a standstill
            return self._send(plan, now + max(ahead, _START_LEAD)) + self.tell()
        return self._send(plan, now + ahead, seam=after) + self.tell()

    def not_planned(self, number: int, error: PlanError) -> list[Event]:
        """Take why there is no plan."""
        current, motion = self.current, self._motions.present
        joins = self._joining.not_planned(number)
        if joins is not None:
            if error.code in _OF_THE_START:  # from a standstill it may be possible
                return self._turn_back() if current is not None and current.canceled else []
            self._waiting.remove(joins)
            return self._announcements.refuse(joins, Outcome.REFUSED, error) + self.tell()
        if number != self._asked:
            return []
        self._asked = 0
        if current is None or current.canceled:
            return self._stay(error)
        if motion is not None and current.joins and error.code in _OF_THE_START:
            return self._ask_from_end(current, motion)
        self.current = None
        events = self._announcements.refuse(current, Outcome.REFUSED, error)
        if motion is not None:  # it was opened
            return events + self._stop_all()
        self._phase = Phase.RESTING
        return events + self._begin() + self.tell()

    def driver_refused(self, number: int, reason: str) -> list[Event]:
        """The driver did not take a motion; whatever it was doing goes on."""
        error = PlanError("trajectory_refused", f"the driver did not take the motion: {reason}")
        continuation, motion = self._motions.continuation, self._motions.present
        if continuation is not None and continuation.number == number:
            self._motions.continuation = None
            if self._waiting and self._waiting[0].plan is continuation.motion:
                self._waiting[0].plan, self._waiting[0].joins = None, False
                return []  # the present sentence goes to its end
            current = self.current
            if current is not None and motion is not None and current.joins:
                current.plan = None
                return self._ask_from_end(current, motion)
            return self._give_up(error)
        if motion is not None and motion.number == number:
            return self._give_up(error)
        return []

    def cancel(self, why: str) -> list[Event]:
        """End the current sentence early: the robot stops and goes back to rest."""
        if self.current is None or self.current.canceled:
            return []
        self.current.canceled = why
        return self._turn_back()

    def supersede(self, current: Job, error: PlanError) -> list[Event]:
        """End the current sentence as soon as the next can take over, and say so."""
        current.canceled = f"{error.code}: {error}"
        named = self._announcements.name(current.sentence, error)
        return named + (self._turn_back() if current.plan is None else [])  # without plan it has hardly begun

    def forget(self, job: Job, why: str) -> list[Event]:
        """End a sentence that waits; one that was sent already ends as soon as it has begun."""
        if job.plan is not None:
            job.canceled = why
            return []
        self._joining.drop(job)
        self._waiting.remove(job)
        return finished(job, Outcome.CANCELED, message=why)

    def interrupt(self, error: PlanError) -> list[Event]:
        """Stop the robot and end the current sentence; one that has not begun waits again."""
        if self._phase is Phase.RESTING:
            return []
        return self._end(Outcome.CANCELED, error) + self._stop_all()

    def end_if_blocked(self) -> list[Event]:
        """End what is going on when the driver says that it takes nothing more."""
        situation = self._situation
        if situation.driver is None or situation.block is None:
            return []
        if self._phase in (Phase.RESTING, Phase.STOPPING) and self.current is None:
            return []
        code, meaning = situation.block
        said = situation.driver.message
        error = PlanError(code, f"{said}: {meaning}" if said else meaning)
        stopped = situation.mode is DriverMode.STOPPED
        ended = self._end(Outcome.CANCELED if stopped else Outcome.NOT_REACHED, error)
        return ended + self._stop_all(send=False)

    def progress(self) -> Progress | None:
        """How far the current sentence is; None while none is signed."""
        current = self.current
        if self._phase is not Phase.SIGNING or current is None or current.plan is None or current.canceled:
            return None
        plan = current.plan
        elapsed = self._motions.of(plan).elapsed
        signed = plan.token_at(elapsed)
        following = next((i for i, timing in enumerate(plan.timings) if timing.start > elapsed), None)
        return Progress(
            ticket=current.ticket,
            token=next(i for i in (signed, following, len(plan.timings) - 1) if i is not None),
            gloss="" if signed is None else plan.timings[signed].token.gloss,
            fraction=min(max(elapsed / plan.duration, 0.0), 1.0),
            stretch=plan.stretch,
        )

    def _begin(self) -> list[Event]:
        """From a standstill: the next sentence, or the way to rest."""
        situation, current = self._situation, self.current
        if (not self._waiting and current is None and not self._astray) or situation.hindrance:
            return []
        self._asked = next(self._numbers)
        self._phase = Phase.PLANNING
        start = situation.robot.state()
        if current is None and self._waiting:
            self.current = self._waiting.popleft()
            sentence = self.current.sentence
            return [PlanWanted(number=self._asked, sentence=sentence, start=start, opening=True)]
        if situation.at_rest:
            return self._rested()
        return [ReturnWanted(number=self._asked, start=start)]

    def _ask_from_end(self, current: Job, opening: PathMonitor) -> list[Event]:
        """It cannot go on in motion: the opening comes to a standstill, and the plan begins there."""
        self._asked = next(self._numbers)
        current.joins = False
        end = opening.state_at(opening.motion.duration)
        return [PlanWanted(number=self._asked, sentence=current.sentence, start=end)]

    def _send(self, plan: Plan, start: float, *, seam: float | None = None) -> list[Event]:
        """Send a motion; it is in force at once, or takes over from the one that is.

        Args:
            plan: The motion.
            start: When it begins [s].
            seam: When it continues the present motion, in that one's time [s]; None from a standstill.
        """
        number, present = next(self._numbers), self._motions.present
        opens, elapsed, samples = present is None, self._situation.now - start, plan.samples
        if present is not None and seam is not None:
            samples = continued(present.motion, seam, plan)
            start -= float(samples.times[1])
        settings = self._situation.settings
        self._motions.add(PathMonitor(number=number, motion=plan, elapsed=elapsed, settings=settings))
        events: list[Event] = [TrajectoryReady(number=number, plan=plan, samples=samples, start=start)]
        if not opens or self.current is None or self.current.canceled:
            return events
        self._phase = Phase.SIGNING
        return [*events, self._begun(self.current)]

    @staticmethod
    def _begun(job: Job) -> Begun:
        job.attempts += 1
        return Begun(ticket=job.ticket)

    def _join(self) -> list[Event]:
        """Have the next sentence planned so that it continues the present one, and send it in time."""
        current, motion = self.current, self._motions.present
        if motion is None or current is None or current.plan is not motion.motion:
            return []
        if self._motions.continuation is not None:
            return []
        if not self._situation.may_join:
            self._joining.drop()
            return []
        wanted = self._joining.want(current, motion)
        due = self._joining.due(motion)
        if due is None:
            return wanted
        plan, seam = due
        return self._send(plan, self._situation.now + seam - motion.elapsed, seam=seam)

    def _take_over(self) -> list[Event]:
        """Let the motion that continues the present one be in force when its time has come."""
        plan = self._motions.take_over()
        current = self.current
        if plan is None or (current is not None and current.plan is plan):
            return []
        self.current = self._waiting.popleft()
        events: list[Event] = [self._begun(self.current)]
        if current is not None:
            ended = Outcome.CANCELED if current.canceled else Outcome.SUCCESS
            events = [*finished(current, ended, message=current.canceled), *events]
        return events + (self._turn_back() if self.current.canceled else [])

    def _follow(self) -> list[Event]:
        """See whether the robot follows, and whether it is at the end."""
        motion, current = self._motions.present, self.current
        assert motion is not None
        robot, age = self._situation.robot, self._situation.age * self._situation.pace
        whole = current is None or current.canceled or current.plan is motion.motion
        if motion.is_reached(robot, age) and whole and self._motions.continuation is None:
            if self._phase is Phase.RETURNING:
                return self._rested()
            assert current is not None
            self.current, self._motions.present, self._phase = None, None, Phase.RESTING
            self._joining.drop()
            ended = Outcome.CANCELED if current.canceled else Outcome.SUCCESS
            return finished(current, ended, message=current.canceled)
        problem = motion.problem(robot, age)
        if problem is None or (problem.code == "not_reached" and not whole):
            return []
        if self._phase is Phase.RETURNING:
            self._returns += 1
            if self._returns >= _MOST_RETURNS:
                return self._stay(problem)
        return self._give_up(problem)

    def _stay(self, error: PlanError) -> list[Event]:
        """There is no way to rest: say so, and stay."""
        events = self._rested()
        why = PlanError(error.code, f"the robot does not go to rest: {error}")
        return events + self._announcements.name(None, why)

    def _rested(self) -> list[Event]:
        self._asked = self._returns = 0
        self._astray = False
        self._phase = Phase.RESTING
        self._motions.present = None
        current, self.current = self.current, None
        return [] if current is None else finished(current, Outcome.CANCELED, message=current.canceled)

    def _turn_back(self) -> list[Event]:
        """End the current sentence early, and go to rest, unless it is on its way there already."""
        current, motion = self.current, self._motions.present
        assert current is not None
        if self._phase is Phase.PLANNING and motion is None:
            self._asked, self.current, self._phase = 0, None, Phase.RESTING
            return finished(current, Outcome.CANCELED, message="canceled before it began")
        if self._phase is not Phase.SIGNING or motion is None:
            return []
        if current.plan is motion.motion and self._motions.continuation is None:
            last = current.plan.timings[-1]
            if motion.elapsed >= last.start + last.duration:
                self._joining.drop()
                return []
        return self._stop_all()

    def _stop_all(self, *, send: bool = True) -> list[Event]:
        """Drop every plan, and have the robot stop."""
        motion = self._motions.present
        if self._motions.continuation is not None and self._waiting:
            self._waiting[0].plan = None
        moving = self._situation.robot.state()
        if motion is not None:  # joint states tell no acceleration
            moving = replace(moving, acceleration=motion.state_at(motion.elapsed).acceleration)
        self._motions.clear()
        self._joining.drop()
        self._asked = 0
        self._astray = True
        self._phase = Phase.STOPPING
        self._halt.begin()
        return [*self._halt.stop(moving, next(self._numbers))] if send else []

    def _await_standstill(self) -> list[Event]:
        if self._halt.stands:
            self._phase = Phase.RESTING
            return []
        if self._halt.is_overdue:
            return [*self._halt.stop(self._situation.robot.state(), next(self._numbers))]
        return []

    def _lost(self) -> list[Event]:
        """Give up what is going on when nothing is heard of the robot."""
        if not self._situation.is_stale or self._phase is Phase.RESTING:
            return []
        events = self._give_up(PlanError("stale_joint_states", self._situation.hindrance))
        self._phase = Phase.RESTING  # nothing tells how it moves
        return events

    def _give_up(self, error: PlanError) -> list[Event]:
        """The robot does not do what was sent: stop it, and sign the sentence again, or name it."""
        current = self.current
        again = (
            current is not None
            and not current.canceled
            and error.code != "not_reached"
            and current.attempts < self._situation.settings.attempts
        )
        if current is None or not again:
            return self._end(Outcome.NOT_REACHED, error) + self._stop_all()
        self.current, current.plan = None, None
        halting = self._stop_all()
        self._waiting.appendleft(current)
        error = PlanError(error.code, f"{error}; the sentence will be signed again")
        return [*self._announcements.name(current.sentence, error, Activity.FAULT), *halting]

    def _end(self, outcome: Outcome, error: PlanError) -> list[Event]:
        """End the current sentence and say why; one that has not begun waits again."""
        current, self.current = self.current, None
        if current is None:
            return []
        if self._phase is Phase.PLANNING and not current.canceled:
            self._waiting.appendleft(current)
            return []
        return self._announcements.refuse(current, outcome, error)
