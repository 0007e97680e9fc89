# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How a sentence ends before its end: canceled, replaced, refused, not followed, stopped."""

from __future__ import annotations

from dataclasses import replace

from teo_lut_executor.execution.announcements import finished
from teo_lut_executor.execution.braking import brake
from teo_lut_executor.execution.events import Activity, DriverMode, Event, Outcome, TrajectoryReady
from teo_lut_executor.execution.job import Job, Phase
from teo_lut_executor.execution.work import Work
from teo_signs.errors import PlanError


class Interruption:
    """Ends what is under way early, and says why."""

    def __init__(self, work: Work) -> None:
        """Interrupt this work."""
        self._work = work

    def cancel(self, why: str) -> list[Event]:
        """End the current sentence early: the robot stops and goes back to rest."""
        if self._work.current is None or self._work.current.canceled:
            return []
        self._work.current.canceled = why
        return self.turn_back()

    def supersede(self, current: Job, error: PlanError) -> list[Event]:
        """End the current sentence as soon as the next can take over, and say so."""
        current.canceled = f"{error.code}: {error}"
        named = self._work.announcements.name(current.sentence, error)
        return named + (self.turn_back() if current.plan is None else [])  # without plan it has hardly begun

    def forget(self, job: Job, why: str) -> list[Event]:
        """End a sentence that waits; one that was sent already ends as soon as it has begun."""
        if job.plan is not None:
            job.canceled = why
            return []
        self._work.joining.drop(job)
        self._work.waiting.remove(job)
        return finished(job, Outcome.CANCELED, message=why)

    def interrupt(self, error: PlanError) -> list[Event]:
        """Stop the robot and end the sentence that it has begun; one that it has not begun waits again."""
        if self._work.phase is Phase.RESTING and self._work.interrupted is None:
            return []
        return self._end(Outcome.CANCELED, error) + self.stop_all()

    def end_if_blocked(self) -> list[Event]:
        """End what is going on when the driver says that it takes nothing more."""
        situation = self._work.situation
        if situation.driver is None or situation.block is None:
            return []
        at_hand = self._work.current or self._work.interrupted
        if self._work.phase in (Phase.RESTING, Phase.STOPPING) and at_hand is None:
            return []
        code, meaning = situation.block
        said = situation.driver.message
        error = PlanError(code, f"{said}: {meaning}" if said else meaning)
        stopped = situation.mode is DriverMode.STOPPED
        ended = self._end(Outcome.CANCELED if stopped else Outcome.NOT_REACHED, error)
        return ended + self.stop_all(send=False)

    def turn_back(self) -> list[Event]:
        """End the current sentence early, and go to rest, unless it is on its way there already."""
        current, motion = self._work.current, self._work.motions.present
        assert current is not None
        if self._work.phase is Phase.PLANNING and motion is None:
            self._work.asked, self._work.current, self._work.phase = 0, None, Phase.RESTING
            return finished(current, Outcome.CANCELED, message="canceled before it began")
        if self._work.phase is not Phase.SIGNING or motion is None:
            return []
        if current.plan is motion.motion and self._work.motions.continuation is None:
            last = current.plan.timings[-1]
            if motion.elapsed >= last.start + last.duration:
                self._work.joining.drop()
                return []
        return self.stop_all()

    def stop_all(self, *, send: bool = True, follows: bool = True) -> list[Event]:
        """Drop every plan, and have the robot stop.

        Args:
            send: Whether it has to be told.
            follows: Whether it does what it was sent last: then it stops from there, within every limit. Else
                from where joint states show it.
        """
        work = self._work
        stopping = self._stop(follows) if send else []
        if work.motions.continuation is not None and work.waiting:
            work.waiting[0].plan = None
        work.motions.clear()
        work.joining.drop()
        work.asked = 0
        work.astray = True
        work.phase = Phase.STOPPING
        return stopping

    def _stop(self, follows: bool) -> list[Event]:
        work, motion = self._work, self._work.motions.present
        work.halt.begin()
        situation = work.situation
        departs = motion is not None and motion.awaited
        known = follows and situation.may_continue and not departs
        way = brake(work.motions, situation.limits) if known else None
        if way is not None:
            number = next(work.numbers)
            work.halt.expect(number, situation.clock_time(way.ahead + way.plan.duration))
            start = situation.now + situation.clock_time(way.ahead)
            return [TrajectoryReady(number=number, plan=way.plan, samples=way.samples, start=start)]
        moving = situation.robot.state()
        if departs or (motion is not None and not situation.may_be_told):
            work.halt.owe()
        if motion is not None and not departs:  # joint states tell no acceleration
            moving = replace(moving, acceleration=motion.state_at(motion.elapsed).acceleration)
        return [*work.halt.stop(moving, next(work.numbers))]

    def await_standstill(self) -> list[Event]:
        """See whether the robot that was told to stop stands; tell it again if it should."""
        if self._work.halt.stands:
            self._work.phase = Phase.RESTING
            return []
        if self._work.halt.is_overdue:
            return [*self._work.halt.stop(self._work.situation.robot.state(), next(self._work.numbers))]
        return []

    def end_if_lost(self) -> list[Event]:
        """Give up what is going on when nothing is heard of the robot."""
        if not self._work.situation.is_stale or self._work.phase in (Phase.RESTING, Phase.STOPPING):
            return []
        return self.give_up(PlanError("stale_joint_states", self._work.situation.hindrance))

    def give_up(self, error: PlanError) -> list[Event]:
        """The robot does not do what was sent: stop it, and sign the sentence again, or name it."""
        current = self._work.current
        again = (
            current is not None
            and not current.canceled
            and error.code != "not_reached"
            and current.attempts < self._work.situation.settings.attempts
        )
        if current is None or not again:
            return self._end(Outcome.NOT_REACHED, error) + self.stop_all(follows=False)
        self._work.current, current.plan, current.again = None, None, True
        halting = self.stop_all(follows=False)
        self._work.waiting.appendleft(current)
        error = PlanError(error.code, f"{error}; the sentence will be signed again")
        return [*self._work.announcements.name(current.sentence, error, Activity.FAULT), *halting]

    def return_again(self, error: PlanError) -> list[Event]:
        """The robot does not go to rest as it was sent: stop it, and try again."""
        current = self._work.current
        again = PlanError(error.code, f"{error}; the way to rest will be tried again")
        named = self._work.announcements.name(
            None if current is None else current.sentence, again, Activity.FAULT
        )
        return named + self.stop_all(follows=False)

    def _end(self, outcome: Outcome, error: PlanError) -> list[Event]:
        """End the sentence that was begun and say why; one that was not waits again."""
        current, self._work.current = self._work.current, None
        if current is None and self._work.interrupted is not None:
            current = self._work.waiting.popleft()
        if current is None:
            return []
        if self._work.phase is Phase.PLANNING and not current.canceled and not current.again:
            self._work.waiting.appendleft(current)
            return []
        return self._work.announcements.refuse(current, outcome, error)

    def stay(self, error: PlanError) -> list[Event]:
        """There is no way to rest: say so, and stay."""
        events = self.rested()
        why = PlanError(error.code, f"the robot does not go to rest: {error}")
        return events + self._work.announcements.name(None, why)

    def rested(self) -> list[Event]:
        """The robot is at rest, or is left where it is; a sentence that was canceled has ended."""
        self._work.asked = self._work.returns = 0
        self._work.astray = False
        self._work.phase = Phase.RESTING
        self._work.motions.present = None
        current, self._work.current = self._work.current, None
        return [] if current is None else finished(current, Outcome.CANCELED, message=current.canceled)
