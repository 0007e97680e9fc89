# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What waits to be signed, as others list and clear it: `list_queue` and `clear_queue`."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from rclpy.node import Node
from std_srvs.srv import Trigger
from teo_sign_msgs.srv import ListQueue

from teo_lut_executor.execution.events import Effect
from teo_lut_executor.execution.queue import ExecutionQueue


class QueueServices:
    """Serves `list_queue` and `clear_queue`."""

    def __init__(
        self,
        node: Node,
        queue: ExecutionQueue,
        *,
        now: Callable[[], float],
        carry_out: Callable[[Sequence[Effect]], None],
    ) -> None:
        """Serve.

        Args:
            node: Serves.
            queue: What is listed and cleared.
            now: Time of the node's clock [s].
            carry_out: Does what the queue answers.
        """
        self._node, self._queue = node, queue
        self._now, self._carry_out = now, carry_out
        self._services = (
            node.create_service(ListQueue, "list_queue", self._on_list),
            node.create_service(Trigger, "clear_queue", self._on_clear),
        )

    def close(self) -> None:
        """Serve no more."""
        for service in self._services:
            self._node.destroy_service(service)

    def _on_list(self, _: ListQueue.Request, response: ListQueue.Response) -> ListQueue.Response:
        sentences, response.current = self._queue.sentences()
        response.utterance_ids = [sentence.utterance_id for sentence in sentences]
        response.sentence_indices = [sentence.index for sentence in sentences]
        response.texts = [sentence.text for sentence in sentences]
        return response

    def _on_clear(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        before = self._queue.queued
        self._carry_out(self._queue.clear(self._now()))
        response.success, response.message = True, f"{before} sentences forgotten"
        return response
