# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Where sentences come from: the journal of a killed executor, the topic `sign_tokens`, goals."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TypedDict

from rclpy.action.server import ServerGoalHandle
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from teo_sign_msgs.msg import SignSentence

from teo_lut_executor.execution.events import Effect, Finished, Progress, Sentence
from teo_lut_executor.execution.journal import MessageKey
from teo_lut_executor.execution.queue import ExecutionQueue
from teo_lut_executor.node.messages import to_sentence
from teo_lut_executor.node.sentence_goals import SentenceGoals
from teo_lut_executor.node.sentence_journal import SentenceJournal, expired
from teo_signs.errors import PlanError

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
        journal: SentenceJournal,
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
        self._goals = SentenceGoals(
            node,
            accepts=self._accepts,
            take=self._take_goal,
            cancel=lambda ticket: self._carry_out(self._queue.cancel(ticket, self._now())),
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
        attempts = self._queue.settings.attempts
        for kept, error in self._journal.left(attempts=attempts, age=self._journal_age):
            if error is None:
                self._submit(kept.sentence, attempts=kept.attempts)
            else:
                self._refuse(kept.sentence, error)
        self._journal.begin()

    def give_feedback(self, progress: Progress) -> None:
        """Tell the client whose sentence is signed, if it came from one."""
        self._goals.give_feedback(progress)

    def finish(self, finished: Finished) -> None:
        """A sentence has ended."""
        self._journal.ended(finished.ticket)
        self._goals.finish(finished)

    def forget_goals(self) -> None:
        """Tell clients nothing any more."""
        self._goals.forget()

    def close(self) -> None:
        """Take nothing more."""
        self._goals.close()
        self._journal.close()
        for subscription in self._subscriptions:
            self._node.destroy_subscription(subscription)

    def _on_tokens(self, message: SignSentence, info: _MessageInfo) -> None:
        key = MessageKey(info["source_timestamp"], message.utterance_id, message.sentence_index)
        if self._journal.knows(key):
            return
        sentence = to_sentence(message)
        waited = time.time() - key.published * 1e-9
        if key.published * 1e-9 < self._began and waited > self._journal_age:
            self._refuse(sentence, expired(waited))
        elif self._accepts(sentence):
            self._submit(sentence, message=key)
            return
        self._journal.refused(key)

    def _take_goal(self, sentence: Sentence, goal: ServerGoalHandle) -> None:
        self._submit(sentence, goal=goal)

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
            self._goals.add(ticket, goal)
        self._journal.accepted(ticket, sentence, attempts=attempts, message=message)
        self._carry_out(events)
