# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which glosses have signs, as the executor's `list_signs` answers."""

from __future__ import annotations

from rclpy.node import Node
from rclpy.task import Future
from teo_sign_msgs.msg import SignToken
from teo_sign_msgs.srv import ListSigns

#: How often the executor is asked for its signs [s]: a new sign is used before anyone has typed a sentence.
_SIGNS_PERIOD = 2.0


class SignInventory:
    """Asks `list_signs` periodically, so that signs may be added and removed while the node runs."""

    def __init__(self, node: Node, listed: frozenset[str] | None) -> None:
        """Begin to ask.

        Args:
            node: Asks.
            listed: Glosses that have signs until a table of the language has answered; None if that is not
                known.
        """
        self._node = node
        self._listed = listed
        self._answered: dict[str, frozenset[str]] = {}
        self._answer: Future | None = None
        self._client = node.create_client(ListSigns, "list_signs")
        self._timer = node.create_timer(_SIGNS_PERIOD, self._ask)

    def signs(self, language: str) -> frozenset[str] | None:
        """Glosses of a language, by its code, that have signs; None if that is not known."""
        return self._answered.get(language, self._listed)

    def list(self, listed: frozenset[str] | None) -> None:
        """Replace the glosses that count until the executor answers."""
        self._listed = listed

    def close(self) -> None:
        """Ask no more."""
        self._node.destroy_timer(self._timer)
        self._node.destroy_client(self._client)

    def _ask(self) -> None:
        """Ask anew, if the executor is there; an answer that has not come by now never will."""
        if self._answer is not None:
            self._client.remove_pending_request(self._answer)
        self._answer = None
        if self._client.service_is_ready():
            self._answer = self._client.call_async(ListSigns.Request())
            self._answer.add_done_callback(self._take)

    def _take(self, answer: Future) -> None:
        self._answer = None
        response = answer.result()
        signs = _lexical_glosses(response)
        if signs != self._answered.get(response.language):
            self._answered[response.language] = signs
            self._node.get_logger().info(f"{len(signs)} glosses of {response.language} have signs")


def _lexical_glosses(response: ListSigns.Response) -> frozenset[str]:
    """Glosses that have a sign of their own, without letters and numbers."""
    return frozenset(
        gloss
        for gloss, kind in zip(response.glosses, response.kinds, strict=True)
        if kind == SignToken.KIND_LEXICAL
    )
