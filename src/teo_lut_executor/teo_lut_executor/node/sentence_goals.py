# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Goals of the action `execute_sentence`, by the ticket of their sentence."""

from __future__ import annotations

from collections.abc import Callable

from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.action.server import ServerGoalHandle
from rclpy.node import Node
from teo_sign_msgs.action import ExecuteSentence

from teo_lut_executor.execution.events import Finished, Outcome, Progress, Sentence
from teo_lut_executor.node.messages import to_sentence, to_timings


class SentenceGoals:
    """Takes goals, and tells clients how their sentences are doing."""

    def __init__(
        self,
        node: Node,
        *,
        accepts: Callable[[Sentence], bool],
        take: Callable[[Sentence, ServerGoalHandle], None],
        cancel: Callable[[int], None],
    ) -> None:
        """Serve the action.

        Args:
            node: Serves it.
            accepts: Whether a sentence may be signed, as far as that is known when it comes.
            take: Queues the sentence of a goal, and adds the goal.
            cancel: Ends the sentence of a ticket early.
        """
        self._accepts, self._take, self._cancel = accepts, take, cancel
        self._goals: dict[int, ServerGoalHandle] = {}
        self._server = ActionServer(
            node,
            ExecuteSentence,
            "execute_sentence",
            execute_callback=_never_called,
            goal_callback=self._on_request,
            handle_accepted_callback=lambda goal: self._take(to_sentence(goal.request.sentence), goal),
            cancel_callback=self._on_cancel,
        )

    def forget(self) -> None:
        """Tell clients nothing any more."""
        self._goals.clear()

    def close(self) -> None:
        """Serve no more."""
        self._server.destroy()

    def add(self, ticket: int, goal: ServerGoalHandle) -> None:
        """Remember a goal until its sentence has ended."""
        self._goals[ticket] = goal

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

    def _on_request(self, goal: ExecuteSentence.Goal) -> GoalResponse:
        return GoalResponse.ACCEPT if self._accepts(to_sentence(goal.sentence)) else GoalResponse.REJECT

    def _on_cancel(self, goal: ServerGoalHandle) -> CancelResponse:
        ticket = next((ticket for ticket, other in self._goals.items() if other is goal), None)
        if ticket is None:
            return CancelResponse.REJECT  # it has just ended
        self._cancel(ticket)
        return CancelResponse.ACCEPT


def _never_called(goal: ServerGoalHandle) -> ExecuteSentence.Result:
    """The callback that rclpy asks for; see `SentenceGoals.finish` for the one that it gets."""
    goal.abort()
    return ExecuteSentence.Result(code=ExecuteSentence.Result.REFUSED)
