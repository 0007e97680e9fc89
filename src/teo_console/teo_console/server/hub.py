# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The pages that are open: each gets the same situation and poses, and answers to its own requests."""

from __future__ import annotations

import asyncio
import time
from collections import deque
from collections.abc import Awaitable, Callable

from aiohttp import WSCloseCode, WSMsgType, web

from teo_console.errors import ConsoleError
from teo_console.protocol import MESSAGE_BYTES, Answer, FromPage, decode, encode
from teo_console.server.access import refusal

# A class of thirty, each with a telephone and a computer, and some to spare.
_MOST_PAGES = 64
# Requests of one page: a person's clicks and keys, not a flood.
_RATE = 10.0
_BURST = 30
# Messages that make no sense, after which a page is told to go.
_MOST_MALFORMED = 10
# Ping of an idle connection [s], by which a page that went without a word is noticed.
_HEARTBEAT = 15.0


class Hub:
    """Keeps the open pages. All methods belong to the server's event loop."""

    def __init__(self, serve: Callable[[FromPage], Awaitable[Answer]]) -> None:
        """Begin without a page; `serve` answers a request."""
        self._serve = serve
        self._pages: set[_Page] = set()
        self._tasks: set[asyncio.Task[None]] = set()  # a task that nobody holds may be collected
        self._welcome = ""
        self._situation = ""

    @property
    def pages(self) -> int:
        """Number of open pages; any thread may ask."""
        return len(self._pages)

    def welcome(self, message: str) -> None:
        """Send the welcome to every page, and to those to come."""
        self._welcome = message
        for page in self._pages:
            page.welcome(message)

    def situation(self, message: str) -> None:
        """Send the situation likewise."""
        self._situation = message
        for page in self._pages:
            page.situation(message)

    def pose(self, frame: bytes) -> None:
        """Send a pose to every page."""
        for page in self._pages:
            page.pose(frame)

    async def handle(self, request: web.Request) -> web.StreamResponse:
        """Serve one page, until it goes."""
        if len(self._pages) >= _MOST_PAGES:
            return refusal(
                ConsoleError("too_many_pages", f"expected at most {_MOST_PAGES} open pages: close one"), 503
            )
        socket = web.WebSocketResponse(heartbeat=_HEARTBEAT, max_msg_size=MESSAGE_BYTES)
        await socket.prepare(request)
        page = _Page(socket)
        self._pages.add(page)
        if self._welcome:
            page.welcome(self._welcome)
        if self._situation:
            page.situation(self._situation)
        sender = asyncio.create_task(page.send_all())
        try:
            await self._listen(page)
        finally:
            self._pages.discard(page)
            sender.cancel()
            await socket.close()
        return socket

    async def close(self) -> None:
        """Send every page away: the node ends."""
        for page in list(self._pages):
            await page.socket.close(code=WSCloseCode.GOING_AWAY)

    async def _listen(self, page: _Page) -> None:
        limit = _RateLimit(rate=_RATE, burst=_BURST)
        malformed = 0
        async for message in page.socket:
            try:
                if not limit.take(time.monotonic()):
                    raise ConsoleError(
                        "too_fast", f"expected at most {_RATE:g} requests a second: wait a little"
                    )
                if message.type is not WSMsgType.TEXT:
                    raise ConsoleError("malformed", "expected text, got a binary message")
                asked = decode(message.data)
            except ConsoleError as error:
                page.answer(Answer(id=None, success=False, code=error.code, message=str(error)))
                malformed += error.code == "malformed"
                if malformed >= _MOST_MALFORMED:
                    await page.socket.close(code=WSCloseCode.POLICY_VIOLATION, message=b"malformed")
                continue
            # Each on its own: a stop must not wait for what was asked before it.
            task = asyncio.create_task(self._answer(page, asked))
            self._tasks.add(task)
            task.add_done_callback(self._tasks.discard)

    async def _answer(self, page: _Page, asked: FromPage) -> None:
        page.answer(await self._serve(asked))


class _Page:
    """One connection. What it has not taken yet is replaced by what is newer, but for answers."""

    def __init__(self, socket: web.WebSocketResponse) -> None:
        self.socket = socket
        self._welcome: str | None = None
        self._situation: str | None = None
        self._pose: bytes | None = None
        self._answers: deque[str] = deque()
        self._news = asyncio.Event()

    def welcome(self, message: str) -> None:
        self._welcome = message
        self._news.set()

    def situation(self, message: str) -> None:
        self._situation = message
        self._news.set()

    def pose(self, frame: bytes) -> None:
        self._pose = frame
        self._news.set()

    def answer(self, answer: Answer) -> None:
        self._answers.append(encode(answer))
        self._news.set()

    async def send_all(self) -> None:
        """Send what is new, at the pace at which the page takes it."""
        try:
            while True:
                await self._news.wait()
                self._news.clear()
                welcome, self._welcome = self._welcome, None
                situation, self._situation = self._situation, None
                pose, self._pose = self._pose, None
                if welcome is not None:
                    await self.socket.send_str(welcome)
                while self._answers:
                    await self.socket.send_str(self._answers.popleft())
                if situation is not None:
                    await self.socket.send_str(situation)
                if pose is not None:
                    await self.socket.send_bytes(pose)
        except ConnectionError:
            pass  # it went while it was sent to; `handle` notices


class _RateLimit:
    """A token bucket: a burst, then a steady rate. Times are from a clock that nobody sets [s]."""

    def __init__(self, *, rate: float, burst: int) -> None:
        """Begin with a whole burst to spend.

        Args:
            rate: Requests a second in the long run [Hz].
            burst: Requests at once.
        """
        self._rate = rate
        self._burst = burst
        self._left = float(burst)
        self._at: float | None = None

    def take(self, now: float) -> bool:
        """Whether one more request may pass at this time."""
        if self._at is not None:
            self._left = min(self._left + (now - self._at) * self._rate, self._burst)
        self._at = now
        if self._left < 1.0:
            return False
        self._left -= 1.0
        return True
