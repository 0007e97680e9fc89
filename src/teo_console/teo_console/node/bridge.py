# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Requests on their way from the server's thread to the node's, and answers on their way back."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from concurrent.futures import Future
from queue import Empty, SimpleQueue

from teo_console.protocol.from_page import FromPage
from teo_console.protocol.to_page import Answer

# A service that has not answered by then is not waited for any longer [s]: they answer within milliseconds.
_PATIENCE = 3.0


class Bridge:
    """Hands each request to the node, and waits for its answer."""

    def __init__(self) -> None:
        """Begin without a request."""
        self._asked: SimpleQueue[tuple[FromPage, Future[Answer]]] = SimpleQueue()
        self.wake: Callable[[], None] = lambda: None  # the node's, once it can be woken

    async def ask(self, request: FromPage) -> Answer:
        """Have a request served; in the server's thread."""
        answered: Future[Answer] = Future()
        self._asked.put((request, answered))
        self.wake()
        try:
            return await asyncio.wait_for(asyncio.wrap_future(answered), _PATIENCE)
        except TimeoutError:
            sentence = (
                f"expected an answer within {_PATIENCE:g} s, none came: the node that serves it may be dead"
            )
            return Answer(id=request.id, success=False, code="no_answer", message=sentence)

    def serve_all(self, serve: Callable[[FromPage, Callable[[Answer], None]], None]) -> None:
        """Serve what was asked; in the node's thread."""
        while True:
            try:
                request, answered = self._asked.get_nowait()
            except Empty:
                return

            def reply(answer: Answer, answered: Future[Answer] = answered) -> None:
                if answered.set_running_or_notify_cancel():  # else it was waited for too long
                    answered.set_result(answer)

            serve(request, reply)
