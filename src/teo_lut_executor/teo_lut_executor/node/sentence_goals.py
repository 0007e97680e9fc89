# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Goals of the action `execute_sentence`, by the ticket of their sentence."""

from __future__ import annotations

from rclpy.action.server import ServerGoalHandle
from teo_sign_msgs.action import ExecuteSentence

from teo_lut_executor.execution.events import Finished, Outcome, Progress
from teo_lut_executor.node.messages import to_timings


class SentenceGoals:
    """Tells clients how their sentences are doing."""

    def __init__(self) -> None:
        """Begin without goals."""
        self._goals: dict[int, ServerGoalHandle] = {}

    def add(self, ticket: int, goal: ServerGoalHandle) -> None:
        """Remember a goal until its sentence has ended."""
        self._goals[ticket] = goal

    def ticket(self, goal: ServerGoalHandle) -> int | None:
        """The ticket of a goal; None if it has ended."""
        return next((ticket for ticket, other in self._goals.items() if other is goal), None)

    def give_feedback(self, progress: Progress) -> None:
        """Tell the client, if the sentence came from one."""
        goal = self._goals.get(progress.ticket)
        if goal is not None:
            goal.publish_feedback(
                ExecuteSentence.Feedback(
                    token=progress.token,
                    gloss=progress.gloss,
                    progress=progress.fraction,
                    stretch=progress.stretch,
                )
            )

    def finish(self, finished: Finished) -> None:
        """Tell the client, if the sentence came from one."""
        goal = self._goals.pop(finished.ticket, None)
        if goal is None:
            return
        result = ExecuteSentence.Result(
            code=int(finished.outcome),
            message=finished.message,
            sentence=goal.request.sentence,
            timings=to_timings(finished.timings),
        )

        def end(goal: ServerGoalHandle) -> ExecuteSentence.Result:
            if finished.outcome == Outcome.SUCCESS:
                goal.succeed()
            elif finished.outcome == Outcome.CANCELED and goal.is_cancel_requested:
                goal.canceled()
            else:
                goal.abort()
            return result

        # The goal is executed when its result is known: a callback that waits for it would keep rclpy's
        # executor busy all the while, and one thread for each goal that waits is no better.
        goal.execute(end)


def never_called(goal: ServerGoalHandle) -> ExecuteSentence.Result:
    """The callback that rclpy asks for; see `SentenceGoals.finish` for the one that it gets."""
    goal.abort()
    return ExecuteSentence.Result(code=ExecuteSentence.Result.REFUSED)
