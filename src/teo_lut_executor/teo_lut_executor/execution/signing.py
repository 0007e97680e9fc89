# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How a sentence is signed: how it begins, how the next one continues it, how it ends, and the way to rest.

The next sentence is planned while one is signed. It is planned from the state in which the one before ends
its last sign (or, if it comes later, from the state on the way down), and is sent to start there.
"""

from __future__ import annotations

from teo_lut_executor.execution.interface import Begun, Effect, Outcome, PlanWanted, ReturnWanted
from teo_lut_executor.execution.sent_motion import LEAST_AHEAD, SentMotion
from teo_lut_executor.execution.work import Job, Join, PlanAnswer, Work, completed, refused
from teo_motion.sentence.plan import Plan
from teo_signs.errors import PlanError


def plan_sentence(work: Work, _: object = None) -> list[Effect]:
    """Have the sentence planned that waits first, with a first motion at once."""
    work.current = work.waiting.popleft()
    work.asked = next(work.numbers)
    start = work.situation.robot.state()
    return [PlanWanted(number=work.asked, sentence=work.current.sentence, start=start, opening=True)]


def plan_rest(work: Work, _: object = None) -> list[Effect]:
    """Have the way to rest planned."""
    work.asked = next(work.numbers)
    return [ReturnWanted(number=work.asked, start=work.situation.robot.state())]


def open_sentence(work: Work, opening: Plan) -> list[Effect]:
    """Send the first motion of the sentence; the whole follows."""
    assert work.current is not None
    return [*_depart(work, opening), begun(work.current)]


def sign(work: Work, answer: PlanAnswer) -> list[Effect]:
    """Send the plan of a sentence that has no opening."""
    assert work.current is not None
    work.asked, work.current.plan = 0, answer.plan
    return [*_depart(work, answer.plan), begun(work.current)]


def go_to_rest(work: Work, answer: PlanAnswer) -> list[Effect]:
    """Send the way to rest."""
    work.asked = 0
    if work.current is not None:
        work.current.plan = None
    return _depart(work, answer.plan)


def continue_opening(work: Work, answer: PlanAnswer) -> list[Effect]:
    """Send the plan so that it takes over from the opening, or keep it until the opening has ended."""
    current, opening = work.current, work.motion
    assert current is not None and opening is not None
    work.early = None
    ahead = answer.after - opening.elapsed
    if answer.after == 0.0:  # planned from the end of the opening
        work.asked, current.plan = 0, answer.plan
        return []
    if opening.awaited and ahead >= LEAST_AHEAD:
        work.early = answer
        return []
    if ahead < LEAST_AHEAD or not work.situation.may_continue:
        return plan_from_end(work)
    work.asked, current.plan = 0, answer.plan
    return _send_continuation(work, opening, answer.after, answer.plan)


def plan_from_end(work: Work, _: object = None) -> list[Effect]:
    """The sentence cannot go on in motion: it begins where the opening comes to a standstill."""
    current, opening = work.current, work.motion
    assert current is not None and opening is not None
    work.continuation, work.asked = None, next(work.numbers)
    current.plan, current.joins = None, False
    end = opening.plan.at(opening.plan.duration)
    return [PlanWanted(number=work.asked, sentence=current.sentence, start=end)]


def begin_plan(work: Work, _: object = None) -> list[Effect]:
    """The plan of the sentence has taken over from its opening."""
    work.motion, work.continuation = work.continuation, None
    return []


def depart(work: Work, _: object = None) -> list[Effect]:
    """Send the plan of a sentence whose opening has come to its end."""
    assert work.current is not None and work.current.plan is not None
    return _depart(work, work.current.plan)


def finish(work: Work, _: object = None) -> list[Effect]:
    """The sentence has come to its end."""
    current, work.current = work.current, None
    assert current is not None
    work.motion = work.join = None
    return completed(current)


def refuse(work: Work, error: PlanError) -> list[Effect]:
    """The sentence cannot be signed; the robot has not moved for it."""
    current, work.current, work.asked = work.current, None, 0
    assert current is not None
    return refused(work, current, Outcome.REFUSED, error)


def _depart(work: Work, plan: Plan) -> list[Effect]:
    """Send a motion that begins at a standstill, as soon as the driver has it."""
    work.motion = work.continuation = None
    return [work.send(plan, plan.samples)]


# A motion that continues another is sent this long before it is to take over [s]: late enough that plans can
# still change, early enough for a loaded machine.
_SEND_AHEAD = 0.5

# On its way to rest a robot is nearly there when so little is left [s]: nothing is won by joining.
_NEARLY_AT_REST = 0.3


def _send_continuation(work: Work, motion: SentMotion, seam: float, plan: Plan) -> list[Effect]:
    """Send a plan that takes over from the motion in force at that motion's path time [s]."""
    situation, ahead = work.situation, seam - motion.elapsed
    samples = motion.continued(seam, plan)
    start = situation.now + situation.clock_time(ahead - float(samples.times[1]))
    return [work.send(plan, samples, start, elapsed=-ahead)]


def prepare_next(work: Work, _: object = None) -> list[Effect]:
    """Have the next sentence planned so that it continues the current one, and send it in time."""
    current, motion = work.current, work.motion
    assert current is not None and motion is not None
    if work.continuation is not None or motion.awaited:
        return []
    if not work.situation.may_join:
        work.join = None
        return []
    wanted: list[Effect] = []
    if work.join is None:
        wanted = _ask(work, current, motion)
    elif work.join.plan is not None and work.join.splice - motion.elapsed < LEAST_AHEAD:  # it came too late
        work.join.job.planning_time *= 2.0
        wanted = _ask(work, current, motion)
    join = work.join
    if join is None or join.plan is None or join.splice - motion.elapsed > _SEND_AHEAD:
        return wanted
    work.join, join.job.plan = None, join.plan
    return _send_continuation(work, motion, join.splice, join.plan)


def keep_next_plan(work: Work, plan: Plan) -> list[Effect]:
    """Take the plan of the next sentence, and send it if it is time."""
    assert work.join is not None
    work.join.plan = plan
    return prepare_next(work)


def leave_next(work: Work, _: PlanError) -> list[Effect]:
    """The next sentence begins from a standstill."""
    assert work.join is not None
    work.join.job.joins, work.join = False, None
    return []


def refuse_next(work: Work, error: PlanError) -> list[Effect]:
    """The next sentence ends before it has begun; the one after it may continue the current one."""
    assert work.join is not None
    job, work.join = work.join.job, None
    work.waiting.remove(job)
    return refused(work, job, Outcome.REFUSED, error)


def withdraw_next(work: Work, _: object = None) -> list[Effect]:
    """The driver did not take the next sentence: it begins from a standstill."""
    work.continuation = None
    if work.waiting:
        work.waiting[0].joins = False
    return unsend_next(work)


def unsend_next(work: Work) -> list[Effect]:
    """Forget a plan of the next sentence that is not executed; the sentence ends if it was canceled."""
    if not work.waiting or work.waiting[0].plan is None:
        return []
    work.waiting[0].plan = None
    return completed(work.waiting.popleft()) if work.waiting[0].canceled else []


def begin_next(work: Work, _: object = None) -> list[Effect]:
    """The next sentence is in force, and becomes the current one."""
    before = work.current
    assert before is not None
    work.motion, work.continuation = work.continuation, None
    work.current = work.waiting.popleft()
    return [*completed(before), begun(work.current)]


def begun(job: Job) -> Begun:
    """Say and count that the robot begins to sign a sentence."""
    job.attempts += 1
    return Begun(ticket=job.ticket)


def _ask(work: Work, current: Job, motion: SentMotion) -> list[Effect]:
    work.join = None
    if not work.waiting or not work.waiting[0].joins:
        return []
    job, last = work.waiting[0], motion.plan.timings[-1]
    end = last.start + last.duration
    earliest = motion.elapsed + job.planning_time
    waits = not current.canceled and earliest <= end
    splice = motion.last_seam(end if waits else earliest)
    if splice > motion.plan.duration - _NEARLY_AT_REST:
        return []
    hold = work.situation.settings.sentence_pause + end - splice if waits else 0.0
    work.join = Join(number=next(work.numbers), job=job, splice=splice)
    start = motion.plan.at(splice)
    return [PlanWanted(number=work.join.number, sentence=job.sentence, start=start, hold=hold)]
