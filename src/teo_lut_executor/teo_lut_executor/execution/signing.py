# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The sentence at hand, and what the robot does for it: from a standstill to rest, or on to the next."""

from __future__ import annotations

from teo_lut_executor.execution.announcements import finished
from teo_lut_executor.execution.events import Begun, Event, Outcome, PlanWanted, ReturnWanted, TrajectoryReady
from teo_lut_executor.execution.interruption import Interruption
from teo_lut_executor.execution.job import Job, Phase
from teo_lut_executor.execution.joining import LEAST_AHEAD
from teo_lut_executor.execution.path_monitor import PathMonitor
from teo_lut_executor.execution.seam import continued
from teo_lut_executor.execution.work import Work
from teo_motion.sentence.plan import Plan, Samples
from teo_signs.errors import PlanError

# How often the way to rest is tried after an interrupted sentence, before the robot is left where it is.
_MOST_RETURNS = 3

# Errors of planning that lie in where the robot is, not in the sentence: from a standstill it may go well.
_OF_THE_START = ("self_collision", "outside_limits", "start_outside_limits", "bad_start", "no_timing")


class Signing:
    """Signs one sentence after the other, and follows the robot meanwhile."""

    def __init__(self, work: Work, interruption: Interruption) -> None:
        """Begin with what is under way.

        Args:
            work: What is under way.
            interruption: Ends a sentence when its motion fails.
        """
        self._work = work
        self._interruption = interruption
        self._early: tuple[int, Plan, float] | None = None  # came before the driver told of its opening

    def step(self) -> list[Event]:
        """Notice what time has brought."""
        events = self._interruption.end_if_blocked() + self._interruption.end_if_lost() + self._take_over()
        match self._work.phase:
            case Phase.SIGNING | Phase.RETURNING:
                events += self._follow()
            case Phase.STOPPING:
                events += self._interruption.await_standstill()
        if self._early is not None:
            number, plan, after = self._early
            events += self.planned(number, plan, after)
        if self._work.phase is Phase.SIGNING:
            events += self._join()
        if self._work.phase is Phase.RESTING:
            events += self._begin()
        return events

    def opened(self, number: int, plan: Plan) -> list[Event]:
        """Take the first motion of a sentence; the whole follows."""
        if number != self._work.asked or self._work.current is None or self._work.current.canceled:
            return []
        return self._depart(plan)

    def planned(self, number: int, plan: Plan, after: float) -> list[Event]:
        """Take a plan that was wanted.

        Args:
            number: Of the request.
            plan: The motion.
            after: Time from the start of the opening at which the plan takes over [s].
        """
        if self._work.joining.planned(number, plan):
            return self._join()
        self._early = None
        if number != self._work.asked:
            return []
        current, opening = self._work.current, self._work.motions.present
        if opening is None:
            self._work.asked = 0
            if current is not None:
                current.plan = None if current.canceled else plan
            signs = current is not None and not current.canceled
            self._work.phase = Phase.SIGNING if signs else Phase.RETURNING
            return self._depart(plan) + self._work.tell()
        assert current is not None
        ahead = after - opening.elapsed
        if after > 0.0 and opening.awaited and ahead >= LEAST_AHEAD:
            self._early = number, plan, after
            return []
        if after > 0.0 and (ahead < LEAST_AHEAD or not self._work.situation.may_continue):
            return self._ask_from_end(current, opening)
        self._work.asked = 0
        current.plan = plan
        if after == 0.0:
            return []  # it begins when the opening has come to a standstill, see `_follow`
        return self._continue(opening, after, plan) + self._work.tell()

    def not_planned(self, number: int, error: PlanError) -> list[Event]:
        """Take why there is no plan."""
        current, motion = self._work.current, self._work.motions.present
        joins = self._work.joining.not_planned(number)
        if joins is not None:
            if error.code in _OF_THE_START:  # from a standstill it may be possible
                return self._interruption.turn_back() if current is not None and current.canceled else []
            self._work.waiting.remove(joins)
            return self._work.announcements.refuse(joins, Outcome.REFUSED, error) + self._work.tell()
        if number != self._work.asked:
            return []
        self._work.asked = 0
        if current is None or current.canceled:
            return self._interruption.stay(error)
        if motion is not None and current.joins and error.code in _OF_THE_START:
            return self._ask_from_end(current, motion)
        self._work.current = None
        events = self._work.announcements.refuse(current, Outcome.REFUSED, error)
        if motion is not None:  # it was opened
            return events + self._interruption.stop_all()
        self._work.phase = Phase.RESTING
        return events + self._begin() + self._work.tell()

    def driver_refused(self, number: int, reason: str) -> list[Event]:
        """The driver did not take a motion; whatever it was doing goes on."""
        error = PlanError("trajectory_refused", f"the driver did not take the motion: {reason}")
        continuation, motion = self._work.motions.continuation, self._work.motions.present
        if continuation is not None and continuation.number == number:
            self._work.motions.continuation = None
            if self._work.waiting and self._work.waiting[0].plan is continuation.motion:
                self._work.waiting[0].plan, self._work.waiting[0].joins = None, False
                return []  # the present sentence goes to its end
            current = self._work.current
            if current is not None and motion is not None and current.joins:
                current.plan = None
                return self._ask_from_end(current, motion)
            return self._interruption.give_up(error)
        if motion is not None and motion.number == number:
            return self._give_up(error)
        self._work.halt.owe(number)
        return []

    def _begin(self) -> list[Event]:
        """From a standstill: the next sentence, or the way to rest."""
        situation, current = self._work.situation, self._work.current
        if (not self._work.waiting and current is None and not self._work.astray) or situation.hindrance:
            return []
        self._work.asked = next(self._work.numbers)
        self._work.phase = Phase.PLANNING
        start = situation.robot.state()
        if current is None and self._work.waiting:
            self._work.current = self._work.waiting.popleft()
            sentence = self._work.current.sentence
            return [PlanWanted(number=self._work.asked, sentence=sentence, start=start, opening=True)]
        if situation.at_rest:
            return self._interruption.rested()
        return [ReturnWanted(number=self._work.asked, start=start)]

    def _ask_from_end(self, current: Job, opening: PathMonitor) -> list[Event]:
        """It cannot go on in motion: the opening comes to a standstill, and the plan begins there."""
        self._work.asked = next(self._work.numbers)
        current.joins = False
        end = opening.state_at(opening.motion.duration)
        return [PlanWanted(number=self._work.asked, sentence=current.sentence, start=end)]

    def _depart(self, plan: Plan) -> list[Event]:
        """Send a motion that begins at a standstill, as soon as the driver has it."""
        current, opening = self._work.current, self._work.motions.present
        self._work.motions.clear()
        events = self._send(plan, plan.samples)
        if opening is not None or current is None or current.canceled:
            return events
        self._work.phase = Phase.SIGNING
        return [*events, self._begun(current)]

    def _continue(self, motion: PathMonitor, seam: float, plan: Plan) -> list[Event]:
        """Send a motion that takes over from the one in force at that one's path time [s]."""
        situation, ahead = self._work.situation, seam - motion.elapsed
        samples = continued(motion.motion, seam, plan)
        start = situation.now + situation.clock_time(ahead - float(samples.times[1]))
        return self._send(plan, samples, start, elapsed=-ahead)

    def _send(
        self, plan: Plan, samples: Samples, start: float | None = None, *, elapsed: float = 0.0
    ) -> list[Event]:
        number, situation = next(self._work.numbers), self._work.situation
        awaited = start is None and situation.driver is not None
        self._work.motions.add(
            PathMonitor(
                number=number, motion=plan, elapsed=elapsed, settings=situation.settings, awaited=awaited
            )
        )
        return [TrajectoryReady(number=number, plan=plan, samples=samples, start=start)]

    @staticmethod
    def _begun(job: Job) -> Begun:
        job.attempts += 1
        return Begun(ticket=job.ticket)

    def _join(self) -> list[Event]:
        """Have the next sentence planned so that it continues the present one, and send it in time."""
        current, motion = self._work.current, self._work.motions.present
        if motion is None or current is None or current.plan is not motion.motion:
            return []
        if self._work.motions.continuation is not None or motion.awaited:
            return []
        if not self._work.situation.may_join:
            self._work.joining.drop()
            return []
        wanted = self._work.joining.want(current, motion)
        due = self._work.joining.due(motion)
        if due is None:
            return wanted
        plan, seam = due
        return self._continue(motion, seam, plan)

    def _take_over(self) -> list[Event]:
        """Let the motion that continues the present one be in force when its time has come."""
        plan = self._work.motions.take_over()
        current = self._work.current
        if plan is None or (current is not None and current.plan is plan):
            return []
        self._work.current = self._work.waiting.popleft()
        events: list[Event] = [self._begun(self._work.current)]
        if current is not None:
            ended = Outcome.CANCELED if current.canceled else Outcome.SUCCESS
            events = [*finished(current, ended, message=current.canceled), *events]
        return events + (self._interruption.turn_back() if self._work.current.canceled else [])

    def _follow(self) -> list[Event]:
        """See whether the robot follows, and whether it is at the end."""
        motion, current = self._work.motions.present, self._work.current
        assert motion is not None
        situation, continues = self._work.situation, self._work.motions.continuation is not None
        robot, age = situation.robot, situation.age * situation.pace
        if motion.is_reached(robot, age) and not continues:
            if current is not None and not current.canceled and current.plan is not motion.motion:
                if current.plan is None or situation.hindrance:
                    return []
                return self._depart(current.plan)  # that was its opening
            if self._work.phase is Phase.RETURNING:
                return self._interruption.rested()
            assert current is not None
            self._work.current, self._work.motions.present, self._work.phase = None, None, Phase.RESTING
            self._work.joining.drop()
            ended = Outcome.CANCELED if current.canceled else Outcome.SUCCESS
            return finished(current, ended, message=current.canceled)
        problem = motion.problem(robot, age)
        if problem is None or (problem.code == "not_reached" and continues):
            return []
        return self._give_up(problem)

    def _give_up(self, error: PlanError) -> list[Event]:
        if self._work.phase is not Phase.RETURNING:
            return self._interruption.give_up(error)
        self._work.returns += 1
        if self._work.returns >= _MOST_RETURNS:
            return self._interruption.stay(error)
        return self._interruption.return_again(error)
