# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The console's pages and /api without a robot: what needs no node is tested in seconds."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import aiohttp
from aiohttp import web

from teo_console.api.routes import all_routes
from teo_console.api.workbench import Folders, Workbench
from teo_console.jobs.commands import Commands
from teo_console.protocol import Answer, Motion, Names, Welcome, encode
from teo_console.review.series import NewItem
from teo_console.server.access import Access
from teo_console.server.app import make_app
from teo_console.server.hub import Hub
from teo_console.server.thread import ServerThread

WEB = Path(__file__).parents[3] / "src" / "teo_console" / "web"
NAMES = Names(
    robot="TEO", signs="LSE", spoken="es", example="Hola.", language="ssp", languages={"ssp": "LSE"}
)
PATIENCE = 60.0  # [s] for an answer on a loaded machine


class Api:
    """The routes on a free port, with files of the test's own."""

    def __init__(self, folder: Path) -> None:
        self.folders = Folders(
            kept=folder / "kept",
            reviews=folder / "reviews.sqlite",
            signwriting=folder / "signwriting",
            cache=folder / "cache",
        )
        self.thread = ServerThread(self._app, "127.0.0.1", 0)
        self.url = f"http://127.0.0.1:{self.thread.port}"

    def _app(self) -> web.Application:
        self.workbench = Workbench(self.folders, Commands(robot="teo", language="ssp"))
        hub = Hub(lambda asked: asyncio.sleep(0, Answer(id=asked.id, success=True)))
        hub.welcome(encode(Welcome(names=NAMES, joints=(), robot=False)))
        access = Access.for_address("127.0.0.1", frozenset())
        routes = all_routes(self.workbench)
        app = make_app(web_folder=WEB, access=access, hub=hub, urdf=lambda: "", routes=routes)

        async def clear_up(_: web.Application) -> None:
            await self.workbench.close()

        app.on_cleanup.append(clear_up)
        return app

    def use(self, commands: Commands) -> None:
        """Work on another language or robot."""

        async def go() -> None:
            self.workbench.use(commands)

        asyncio.run_coroutine_threadsafe(go(), self.thread.loop).result(PATIENCE)

    def add_series(
        self, kind: str, *meanings: str, choices: tuple[str, ...] = (), hashes: Mapping[str, str] = {}
    ) -> str:
        """A series whose motions need no planning; what is among the choices is chosen from them.

        Args:
            kind: "review" or "comprehension".
            meanings: Glosses, or sentences: those have small letters.
            choices: What is offered to choose from.
            hashes: Of the motions that the table has, by gloss; of others a made one.
        """
        motion = Motion(joints=("FrontalRightElbow",), times=(0.0, 1.0), positions=((0.0,), (-1.0,)))
        items = [
            NewItem(
                kind="sign" if meaning.isupper() else "sentence",
                meaning=meaning,
                language="ssp",
                motion_hash=hashes.get(meaning, "0" * 64),
                motion=motion,
                choices=choices if meaning in choices else (),
            )
            for meaning in meanings
        ]

        async def add() -> str:
            return self.workbench.table.reviews.add_series(kind, "", items, 1)  # type: ignore[arg-type]

        return asyncio.run_coroutine_threadsafe(add(), self.thread.loop).result(PATIENCE)

    def ask(self, method: str, path: str, body: Any = None, *, origin: str | None = None) -> tuple[int, Any]:
        """Status and JSON of an answer; bytes are sent as they are."""

        async def go() -> tuple[int, Any]:
            data = body if isinstance(body, bytes) or body is None else json.dumps(body).encode()
            headers = {"Origin": origin or self.url}
            async with (
                aiohttp.ClientSession(timeout=aiohttp.ClientTimeout(PATIENCE)) as session,
                session.request(method, f"{self.url}{path}", data=data, headers=headers) as response,
            ):
                text = await response.text()
                is_json = response.content_type == "application/json"
                return response.status, json.loads(text) if is_json else text

        return asyncio.run(go())
