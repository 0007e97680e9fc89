# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The web application: the page's files, /api, and the websocket; how a request is read and answered."""

from __future__ import annotations

import functools
import xml.etree.ElementTree as ET
from collections.abc import Awaitable, Callable, Sequence
from pathlib import Path
from typing import Any, TypeVar

import msgspec
from aiohttp import web

from teo_console.errors import ConsoleError
from teo_console.server.access import Access, guard, refusal
from teo_console.server.hub import Hub

# Ends of addresses whose answer is text.
_TEXT = ("/", ".css", ".html", ".js", ".json", ".svg", ".urdf")

# Headers of requests that may be answered by less than the whole.
_PARTIAL = ("If-None-Match", "If-Modified-Since", "Range")

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

    app = web.Application(middlewares=[guard(access), _compressed], client_max_size=_BODY_BYTES)
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


_Handler = Callable[[web.Request], Awaitable[web.StreamResponse]]


@web.middleware
async def _compressed(request: web.Request, handler: _Handler) -> web.StreamResponse:
    """Send text in the coding that the browser takes: of 870 kB a telephone fetches 240."""
    response = await handler(request)
    empty = isinstance(response, web.Response) and not response.body
    # With a file that the browser has already, aiohttp would send a body where none may be, and so spoil the
    # next answer on that connection.
    whole = request.method == "GET" and not any(name in request.headers for name in _PARTIAL)
    if request.path.endswith(_TEXT) and whole and not response.prepared and not empty:
        response.enable_compression()
    return response


_T = TypeVar("_T")

# What is not here is 400: the request was not right.
_STATUS = {
    "busy": 503,
    "too_large": 413,
    "unknown_job": 404,
    "unknown_recording": 404,
    "unknown_series": 404,
    "unknown_item": 404,
    "unknown_sign": 404,
    "not_ready": 409,
    "answered": 409,
    "not_answered": 409,
}


def answering(handler: Callable[[web.Request], Awaitable[Any]]) -> _Handler:
    """Make a handler's value a JSON answer, and what it refuses an error with code and sentence."""

    @functools.wraps(handler)
    async def answered(request: web.Request) -> web.StreamResponse:
        try:
            value = await handler(request)
        except ConsoleError as error:
            return refusal(error, _STATUS.get(error.code, 400))
        if isinstance(value, web.StreamResponse):
            return value
        return web.Response(body=msgspec.json.encode(value), content_type="application/json")

    return answered


async def body(request: web.Request, kind: type[_T]) -> _T:
    """A request's JSON as a value of a type.

    Raises:
        ConsoleError: "malformed": it is none; the sentence says where it is wrong.
    """
    try:
        return msgspec.json.decode(await request.read(), type=kind)
    except (msgspec.DecodeError, UnicodeError, RecursionError) as error:
        raise ConsoleError("malformed", f"expected JSON of another form: {error}") from error


def drawable_urdf(text: str) -> str:
    """A URDF in which the plain shapes that count in a collision stand for meshes.

    Args:
        text: As the driver published it. What is no XML comes back as it is: the page says that it has no
            robot.
    """
    try:
        robot = ET.fromstring(text)
    except ET.ParseError:
        return text
    changed = False
    for link in robot.iter("link"):
        meshes = [visual for visual in link.findall("visual") if visual.find("geometry/mesh") is not None]
        if not meshes:
            continue
        changed = True
        for visual in meshes:
            link.remove(visual)
        for collision in link.findall("collision"):
            if collision.find("geometry/mesh") is None:
                shape = ET.SubElement(link, "visual")
                shape.extend(collision)
                material = ET.SubElement(shape, "material", name="plain_shape")
                ET.SubElement(material, "color", rgba="0.75 0.77 0.8 1")
    return ET.tostring(robot, encoding="unicode") if changed else text
