# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How a sentence begins from a standstill and comes to its end, and how the robot goes to rest."""

from __future__ import annotations

from teo_lut_executor.execution.announcements import completed, refused
from teo_lut_executor.execution.events import Effect, Outcome, PlanWanted, ReturnWanted
from teo_lut_executor.execution.joining import begun, send_continuation
from teo_lut_executor.execution.seam import LEAST_AHEAD
from teo_lut_executor.execution.work import PlanAnswer, Work
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
    return send_continuation(work, opening, answer.after, answer.plan)


def plan_from_end(work: Work, _: object = None) -> list[Effect]:
    """The sentence cannot go on in motion: it begins where the opening comes to a standstill."""
    current, opening = work.current, work.motion
    assert current is not None and opening is not None
    work.continuation, work.asked = None, next(work.numbers)
    current.plan, current.joins = None, False
    end = opening.state_at(opening.motion.duration)
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
