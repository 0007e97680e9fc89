# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The server in a thread with an event loop of its own, beside the node's, and requests to that."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Callable
from concurrent.futures import Future
from queue import Empty, SimpleQueue

from aiohttp import web

from teo_console.errors import ConsoleError
from teo_console.protocol import Answer, FromPage, SetLanguage

# Longest that starting and ending may take [s]: both take a fraction of a second.
_START_TIMEOUT = 10.0


class ServerThread:
    """Runs a web application until it is closed."""

    def __init__(self, make_app: Callable[[], web.Application], address: str, port: int) -> None:
        """Start.

        Args:
            make_app: Makes the application, in the server's thread.
            address: IP address to listen at.
            port: TCP port; 0 for any that is free.

        Raises:
            ConsoleError: "port_taken": nothing can listen there.
        """
        self.loop = asyncio.new_event_loop()
        self._runner: web.AppRunner | None = None
        self._thread = threading.Thread(target=self._run, name="console server", daemon=True)
        self._thread.start()
        starting = asyncio.run_coroutine_threadsafe(self._start(make_app, address, port), self.loop)
        try:
            self.port = starting.result(_START_TIMEOUT)
        except OSError as error:
            self.close()
            raise ConsoleError(
                "port_taken",
                f"expected to listen at {address} port {port}, got: {error}; "
                "end what listens there or set the parameter port",
            ) from error

    def call(self, function: Callable[..., object], *arguments: object) -> None:
        """Have a function called in the server's thread; nothing happens once it has ended."""
        if not self.loop.is_closed():
            self.loop.call_soon_threadsafe(function, *arguments)

    def close(self) -> None:
        """End, and wait for it."""
        if self.loop.is_closed():
            return
        asyncio.run_coroutine_threadsafe(self._end(), self.loop).result(_START_TIMEOUT)
        self.loop.call_soon_threadsafe(self.loop.stop)
        self._thread.join(_START_TIMEOUT)
        self.loop.close()

    async def _start(self, make_app: Callable[[], web.Application], address: str, port: int) -> int:
        # A page that hangs must not keep the node from ending.
        self._runner = web.AppRunner(make_app(), access_log=None, shutdown_timeout=1.0)
        await self._runner.setup()
        site = web.TCPSite(self._runner, address, port)
        await site.start()
        return int(self._runner.addresses[0][1])

    async def _end(self) -> None:
        if self._runner is not None:
            await self._runner.cleanup()
        # Connections that a browser keeps open have a task each, which would be lost with the loop.
        left = asyncio.all_tasks() - {asyncio.current_task()}
        for task in left:
            task.cancel()
        await asyncio.gather(*left, return_exceptions=True)

    def _run(self) -> None:
        asyncio.set_event_loop(self.loop)
        self.loop.run_forever()


# A service that has not answered by then is not waited for any longer [s]: they answer within milliseconds.
_ANSWER_TIMEOUT = 3.0
# A language's model is loaded within two seconds, on a busy machine in five times as long [s].
_LANGUAGE_TIMEOUT = 20.0


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
        longest = _LANGUAGE_TIMEOUT if isinstance(request, SetLanguage) else _ANSWER_TIMEOUT
        try:
            return await asyncio.wait_for(asyncio.wrap_future(answered), longest)
        except TimeoutError:
            sentence = (
                f"expected an answer within {longest:g} s, none came: the node that serves it may be dead"
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
