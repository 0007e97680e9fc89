# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the executor answers about its table and its queue."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from rclpy.node import Node
from std_srvs.srv import Trigger
from teo_sign_msgs.msg import SignToken
from teo_sign_msgs.srv import GetSign, ListQueue, ListSigns

from teo_lut_executor.execution.interface import Effect, Status
from teo_lut_executor.execution.queue import ExecutionQueue
from teo_lut_executor.node.messages import sign_trajectory
from teo_signs.errors import LutError
from teo_signs.look_up_table import Lut
from teo_signs.sign import Sign, gloss_key

_KINDS = {"lexical": SignToken.KIND_LEXICAL, "letter": SignToken.KIND_LETTER, "number": SignToken.KIND_NUMBER}


class Services:
    """Serves `list_signs`, `get_sign`, `list_queue` and `clear_queue`; the table may change meanwhile.

    Attributes:
        lut: The table.
    """

    def __init__(
        self,
        node: Node,
        lut: Lut,
        queue: ExecutionQueue,
        *,
        makes: Callable[[Sign], bool],
        now: Callable[[], float],
        carry_out: Callable[[Sequence[Effect]], None],
    ) -> None:
        """Serve.

        Args:
            node: Serves.
            lut: The table.
            queue: What is listed and cleared.
            makes: Whether a sign of the table is made and not spelled.
            now: Time of the node's clock [s].
            carry_out: Does what the queue answers.
        """
        self._node, self.lut, self._queue = node, lut, queue
        self._makes, self._now, self._carry_out = makes, now, carry_out
        self._services = (
            node.create_service(ListSigns, "list_signs", self._on_list_signs),
            node.create_service(GetSign, "get_sign", self._on_get_sign),
            node.create_service(ListQueue, "list_queue", self._on_list_queue),
            node.create_service(Trigger, "clear_queue", self._on_clear_queue),
        )

    def refresh(self) -> None:
        """Read the table again where it has changed."""
        problem = self.lut.refresh()
        if problem:
            self._node.get_logger().error(
                f"look-up table not read again: {problem}", throttle_duration_sec=5.0
            )

    def close(self) -> None:
        """Serve no more."""
        for service in self._services:
            self._node.destroy_service(service)

    def _on_list_signs(self, request: ListSigns.Request, response: ListSigns.Response) -> ListSigns.Response:
        """Fill in the language, the glosses that begin with the prefix and are signed, and their kinds."""
        self.refresh()
        response.language = self.lut.language.code
        prefix = gloss_key(request.prefix)
        for gloss in self.lut.glosses():
            if not gloss.startswith(prefix):
                continue
            try:
                sign = self.lut[gloss]
            except LutError as error:
                self._node.get_logger().warning(f"not listed: {error}")
                continue
            if self._makes(sign):
                response.glosses.append(gloss)
                response.kinds.append(_KINDS[sign.kind])
        return response

    def _on_get_sign(self, request: GetSign.Request, response: GetSign.Response) -> GetSign.Response:
        """Fill in one sign, or why there is none ("unknown_sign", "invalid_sign")."""
        self.refresh()
        try:
            sign = self.lut[request.gloss]
            response.entry = self.lut.path(request.gloss).read_text(encoding="utf-8")
        except (LutError, OSError) as error:
            unknown = isinstance(error, LutError) and error.code == "unknown_sign"
            response.code = "unknown_sign" if unknown else "invalid_sign"
            response.message = str(error)
            return response
        response.trajectory = sign_trajectory(sign)
        response.handedness = sign.handedness
        response.success = True
        return response

    def _on_list_queue(self, _: ListQueue.Request, response: ListQueue.Response) -> ListQueue.Response:
        sentences, response.current = self._queue.sentences()
        response.utterance_ids = [sentence.utterance_id for sentence in sentences]
        response.sentence_indices = [sentence.index for sentence in sentences]
        response.texts = [sentence.text for sentence in sentences]
        return response

    def _on_clear_queue(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        effects = self._queue.clear(self._now())
        forgotten = sum(isinstance(effect, Status) and effect.code == "cleared" for effect in effects)
        self._carry_out(effects)
        response.success, response.message = True, f"{forgotten} sentences forgotten"
        return response
