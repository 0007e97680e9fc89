# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Where sentences come from: the journal of a killed executor, the topic `sign_tokens`, goals."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TypedDict

from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.action.server import ServerGoalHandle
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from teo_sign_msgs.action import ExecuteSentence
from teo_sign_msgs.msg import SignSentence

from teo_lut_executor.execution.interface import Effect, Finished, Outcome, Progress, Sentence
from teo_lut_executor.execution.journal import Journal, MessageKey
from teo_lut_executor.execution.queue import ExecutionQueue
from teo_lut_executor.node.messages import to_sentence, to_timings
from teo_signs.errors import PlanError


def _never_called(goal: ServerGoalHandle) -> ExecuteSentence.Result:
    """The callback that rclpy asks for; see `SentenceIntake.finish` for the one that it gets."""
    goal.abort()
    return ExecuteSentence.Result(code=ExecuteSentence.Result.REFUSED)


def open_journal(node: Node, folder: str) -> Journal:
    """The journal of an executor; one that keeps nothing where another executor uses it.

    Args:
        node: Whose it is; its full name and DDS domain name the file.
        folder: Where it is kept; empty for none.
    """
    if not folder:
        return Journal(None)
    name = node.get_fully_qualified_name().strip("/").replace("/", ".")
    file = f"domain{os.environ.get('ROS_DOMAIN_ID', '0')}.{name}.jsonl"
    try:
        return Journal(Path(folder).expanduser() / file)
    except BlockingIOError:
        journal = Journal(None)
        journal.problem = f"another executor uses {file}"
        return journal


def _expired(waited: float) -> PlanError:
    """Why a sentence is not signed that has waited for so long [s]."""
    return PlanError("expired", f"it waited for {waited:.0f} s: send it again")


# Sentences that DDS keeps while a callback runs: far more than arrive in that time, so that it is our own
# queue that is full first, and that says so.
_TOKENS_DEPTH = 1000


class _MessageInfo(TypedDict):
    """What rclpy says of a message, as far as it is used here."""

    source_timestamp: int  # when it was published, by the publisher's system clock [ns]


class SentenceIntake:
    """Takes sentences into the queue and the journal, or names why not.

    A translator keeps what it published for whoever begins to listen later, so that what is said while no
    executor is there is signed by the next one. Publishers that keep nothing are heard too, and DDS wants a
    subscription of its own for either kind; a message that comes by both is taken once. Without journal
    nothing tells what was signed already, and only what comes from now on is taken.
    """

    def __init__(
        self,
        node: Node,
        queue: ExecutionQueue,
        journal: Journal,
        *,
        journal_age: float,
        check: Callable[[Sentence], None],
        now: Callable[[], float],
        carry_out: Callable[[Sequence[Effect]], None],
        own_language: Callable[[], str],
    ) -> None:
        """Listen, and serve the action.

        Args:
            node: Listens and serves.
            queue: Takes the sentences.
            journal: Outlives the process.
            journal_age: Age up to which what came before this executor is signed [s].
            check: Raises `PlanError` if a sentence is none that can be signed.
            now: Time of the node's clock [s].
            carry_out: Does what the queue answers.
            own_language: Code of the language of sentences that name none.
        """
        self._node, self._queue, self._journal = node, queue, journal
        self._journal_age = journal_age
        self._check, self._now, self._carry_out = check, now, carry_out
        self._own_language = own_language
        self._began = time.time()
        self._goals: dict[int, ServerGoalHandle] = {}  # of sentences that came as goals, by ticket
        self._server = ActionServer(
            node,
            ExecuteSentence,
            "execute_sentence",
            execute_callback=_never_called,
            goal_callback=self._on_request,
            handle_accepted_callback=lambda goal: self._submit(to_sentence(goal.request.sentence), goal=goal),
            cancel_callback=self._on_cancel,
        )
        kinds = [DurabilityPolicy.VOLATILE]
        if journal.kept:  # first, so that what was published before is taken before what comes now
            kinds.insert(0, DurabilityPolicy.TRANSIENT_LOCAL)
        self._subscriptions = [
            node.create_subscription(
                SignSentence,
                "sign_tokens",
                self._on_tokens,
                QoSProfile(depth=_TOKENS_DEPTH, reliability=ReliabilityPolicy.RELIABLE, durability=kind),
                # Without rclpy's warning of publishers that keep nothing: the other subscription hears them.
                event_callbacks=SubscriptionEventCallbacks(use_default_callbacks=False),
            )
            for kind in kinds
        ]

    def take_over_journal(self) -> None:
        """Sign what an executor before this one was killed with, or name it."""
        if self._journal.unread:
            self._node.get_logger().error(
                f"{self._journal.unread} lines of the journal are spoilt: passed over, and kept as `.spoilt`"
            )
        for kept in self._journal.left:
            waited = time.time() - kept.accepted
            if kept.attempts >= self._queue.settings.attempts:
                error = PlanError("interrupted", "the executor ended while it signed it: send it again")
                self._refuse(kept.sentence, error)
            elif waited > self._journal_age:
                self._refuse(kept.sentence, _expired(waited))
            else:
                self._submit(kept.sentence, attempts=kept.attempts)
        if self._journal.left:
            self._queue.recover()
        self._journal.begin()

    def give_feedback(self, progress: Progress) -> None:
        """Tell the client whose sentence is signed, if it came from one."""
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
        """A sentence has ended: write it down, and tell the client, if it came from one."""
        self._journal.ended(finished.ticket)
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

    def forget_goals(self) -> None:
        """Tell clients nothing any more."""
        self._goals.clear()

    def close(self) -> None:
        """Take nothing more."""
        self._server.destroy()
        self._journal.close()
        for subscription in self._subscriptions:
            self._node.destroy_subscription(subscription)

    def _on_request(self, goal: ExecuteSentence.Goal) -> GoalResponse:
        return GoalResponse.ACCEPT if self._accepts(to_sentence(goal.sentence)) else GoalResponse.REJECT

    def _on_cancel(self, goal: ServerGoalHandle) -> CancelResponse:
        ticket = next((ticket for ticket, other in self._goals.items() if other is goal), None)
        if ticket is None:
            return CancelResponse.REJECT  # it has just ended
        self._carry_out(self._queue.cancel(ticket, self._now()))
        return CancelResponse.ACCEPT

    def _on_tokens(self, message: SignSentence, info: _MessageInfo) -> None:
        key = MessageKey(info["source_timestamp"], message.utterance_id, message.sentence_index)
        if self._journal.knows(key):
            return
        sentence = to_sentence(message)
        waited = time.time() - key.published * 1e-9
        if key.published * 1e-9 < self._began and waited > self._journal_age:
            self._refuse(sentence, _expired(waited))
        elif self._accepts(sentence):
            self._submit(sentence, message=key)
            return
        self._journal.refused(key)

    def _accepts(self, sentence: Sentence) -> bool:
        """Whether a sentence is one, as far as that is known without planning it; if not, that is told."""
        try:
            self._check(sentence)
        except PlanError as error:
            self._refuse(sentence, error)
            return False
        return True

    def _refuse(self, sentence: Sentence, error: PlanError) -> None:
        self._carry_out(self._queue.refuse(sentence, error, self._now()))

    def _submit(
        self,
        sentence: Sentence,
        *,
        attempts: int = 0,
        goal: ServerGoalHandle | None = None,
        message: MessageKey | None = None,
    ) -> None:
        if not sentence.language:
            sentence = replace(sentence, language=self._own_language())
        ticket, events = self._queue.submit(sentence, self._now(), attempts=attempts)
        if goal is not None:
            self._goals[ticket] = goal
        self._journal.accepted(ticket, sentence, time.time(), attempts=attempts, message=message)
        self._carry_out(events)
