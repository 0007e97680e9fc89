# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The web application: the page's files, /api, and the websocket."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from aiohttp import web

from teo_console.errors import ConsoleError
from teo_console.server.access import Access, guard, refusal
from teo_console.server.drawable_urdf import drawable_urdf
from teo_console.server.hub import Hub

# Bytes of a request's body: JSON of a form. A route that takes films reads a stream, with a limit of its own.
_BODY_BYTES = 64 * 1024


def make_app(
    *,
    web_folder: Path,
    access: Access,
    hub: Hub,
    urdf: Callable[[], str],
    routes: Sequence[web.RouteDef] = (),
) -> web.Application:
    """Put the application together.

    Args:
        web_folder: With index.html and what it asks for.
        access: Who may speak to it.
        hub: The open pages.
        urdf: Gives the robot's description, empty while none is known.
        routes: More of /api.
    """

    async def index(_: web.Request) -> web.StreamResponse:
        return web.FileResponse(web_folder / "index.html")

    async def robot(_: web.Request) -> web.StreamResponse:
        if text := urdf():
            return web.Response(text=drawable_urdf(text), content_type="application/xml")
        return refusal(
            ConsoleError("no_robot", "expected robot_description from a driver, none has come yet"), 404
        )

    app = web.Application(middlewares=[guard(access)], client_max_size=_BODY_BYTES)
    app.add_routes(
        [
            web.get("/", index),
            web.get("/ws", hub.handle),
            web.get("/api/robot.urdf", robot),
            *routes,
            # Last: names of files that do not exist end here.
            web.static("/", web_folder, show_index=False),
        ]
    )

    async def send_pages_away(_: web.Application) -> None:
        await hub.close()

    app.on_shutdown.append(send_pages_away)
    return app
