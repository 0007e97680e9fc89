# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How a sentence ends before its end: canceled, replaced, refused, not followed, stopped."""

from __future__ import annotations

from teo_lut_executor.execution.braking import brake
from teo_lut_executor.execution.interface import (
    Activity,
    DriverMode,
    Effect,
    HaltReady,
    Outcome,
    TrajectoryReady,
)
from teo_lut_executor.execution.signing import begin_next, unsend_next
from teo_lut_executor.execution.work import State, Work, completed, finished, named, refused
from teo_signs.errors import PlanError


def cancel(work: Work, why: str) -> list[Effect]:
    """End the current sentence: the robot stops, and goes to rest before anything else."""
    assert work.current is not None
    work.current.canceled = why
    return _stop(work)


def cancel_before_it_began(work: Work, _: str) -> list[Effect]:
    """End the current sentence; the robot has not moved for it."""
    current, work.current, work.asked = work.current, None, 0
    assert current is not None
    return finished(current, Outcome.CANCELED, message="canceled before it began")


def end_at_rest(work: Work, why: str) -> list[Effect]:
    """The current sentence goes on to rest, and ends there as canceled."""
    assert work.current is not None
    work.current.canceled = why
    work.join = None
    return []


def end_when_replaced(work: Work, why: str) -> list[Effect]:
    """The current sentence goes on until the next can take over."""
    assert work.current is not None
    work.current.canceled = why
    return []


def begin_next_and_stop(work: Work, _: object = None) -> list[Effect]:
    """The next sentence, which was canceled after it had been sent, is stopped as it begins."""
    return begin_next(work) + _stop(work)


def deactivate(work: Work, error: PlanError) -> list[Effect]:
    """Stop the robot, and end the sentence that it has begun; one that it has not begun waits again."""
    return _end(work, Outcome.CANCELED, error) + _stop(work)


def end_blocked(work: Work, error: PlanError) -> list[Effect]:
    """The same where the driver stops the robot by itself."""
    stopped = work.situation.mode is DriverMode.STOPPED
    ended = _end(work, Outcome.CANCELED if stopped else Outcome.NOT_REACHED, error)
    return ended + _let_go(work)


def put_back(work: Work, _: object = None) -> list[Effect]:
    """Give up a plan that is not there yet; the sentence waits again, first of all."""
    work.asked = 0
    if work.current is not None and not work.current.canceled:
        work.waiting.appendleft(work.current)
        work.current = None
    return []


def refuse_opened(work: Work, error: PlanError) -> list[Effect]:
    """The sentence, whose first motion is in force, cannot be signed: the robot stops and goes to rest."""
    current, work.current = work.current, None
    assert current is not None
    return refused(work, current, Outcome.REFUSED, error) + _stop(work)


def give_up(work: Work, error: PlanError) -> list[Effect]:
    """The robot does not do what was sent: stop it, and sign the sentence again, or end it."""
    current = work.current
    again = (
        current is not None
        and not current.canceled
        and error.code != "not_reached"
        and current.attempts < work.situation.settings.attempts
    )
    if current is None or not again:
        return _end(work, Outcome.NOT_REACHED, error) + _stop(work, follows=False)
    work.current, current.plan, current.again = None, None, True
    stopping = _stop(work, follows=False)
    work.waiting.appendleft(current)
    error = PlanError(error.code, f"{error}; the sentence will be signed again")
    return [*named(work, current.sentence, error, Activity.FAULT), *stopping]


def try_rest_again(work: Work, error: PlanError) -> list[Effect]:
    """The robot does not go to rest as it was sent: stop it, and try again."""
    work.returns += 1
    sentence = None if work.current is None else work.current.sentence
    again = PlanError(error.code, f"{error}; the way to rest will be tried again")
    return named(work, sentence, again, Activity.FAULT) + _stop(work, follows=False)


def stop_again(work: Work, _: object = None) -> list[Effect]:
    """Tell a robot to stop that should stand and moves."""
    told: list[Effect] = [*work.halt.stop(work.situation.robot.state(), next(work.numbers))]
    if not any(isinstance(each, HaltReady) for each in told):
        return told
    refused = "the driver takes no motion to a standstill: it is told to `stop`; re-arm it to go on"
    return [*told, *named(work, None, PlanError("stop_refused", refused), Activity.FAULT)]


def owe_stop(work: Work, number: int) -> list[Effect]:
    """A stop that the driver did not take is owed to the robot."""
    work.halt.owe(number)
    return []


def arrive(work: Work, _: object = None) -> list[Effect]:
    """The robot is at rest, or is left where it is; a sentence that was canceled has ended."""
    current, work.current = work.current, None
    work.asked = work.returns = 0
    work.astray = False
    work.motion = None
    return [] if current is None else completed(current)


def stay(work: Work, error: PlanError) -> list[Effect]:
    """There is no way to rest: say so, and leave the robot where it is."""
    events = arrive(work)
    return events + named(work, None, PlanError(error.code, f"the robot does not go to rest: {error}"))


def _end(work: Work, outcome: Outcome, error: PlanError) -> list[Effect]:
    """End the sentence that was begun, and say why; one that was not waits again."""
    current, work.current = work.current, None
    if current is None and work.interrupted is not None:
        current = work.waiting.popleft()
    if current is None:
        return []
    if work.state is State.PLANNING and not current.again:
        work.waiting.appendleft(current)
        return []
    return refused(work, current, outcome, error)


def _stop(work: Work, *, follows: bool = True) -> list[Effect]:
    """Drop every plan, and have the robot stop.

    Args:
        work: What is under way.
        follows: Whether the robot does what it was sent last: then it stops from there, within every limit.
            Else from where joint states show it.
    """
    return _stop_robot(work, follows) + _let_go(work)


def _let_go(work: Work) -> list[Effect]:
    """Forget what was planned and sent: the robot is awaited to stand, and to be brought to rest."""
    ended = [] if work.continuation is None else unsend_next(work)
    work.motion = work.continuation = work.join = work.early = None
    work.asked = 0
    work.astray = True
    return ended


def _stop_robot(work: Work, follows: bool) -> list[Effect]:
    situation, motion = work.situation, work.motion
    work.halt.begin()
    departs = motion is not None and motion.awaited
    if motion is not None and follows and situation.may_continue and not departs:
        way = brake(motion, work.continuation, situation.limits)
        if way is not None:
            number = next(work.numbers)
            work.halt.expect(number, situation.clock_time(way.ahead + way.plan.duration))
            start = situation.now + situation.clock_time(way.ahead)
            return [TrajectoryReady(number=number, plan=way.plan, samples=way.samples, start=start)]
    if departs or (motion is not None and not situation.may_be_told):
        work.halt.owe()
    moving = situation.robot.state()
    if motion is not None and not departs:  # joint states tell no acceleration
        moving = moving._replace(acceleration=motion.plan.at(motion.elapsed).acceleration)
    return [*work.halt.stop(moving, next(work.numbers))]
