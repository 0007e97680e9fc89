# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Requests as types, and refusals as answers."""

from __future__ import annotations

import functools
from collections.abc import Awaitable, Callable
from typing import Any, TypeVar

import msgspec
from aiohttp import web

from teo_console.errors import ConsoleError
from teo_console.server.access import refusal

Handler = Callable[[web.Request], Awaitable[web.StreamResponse]]
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


def answering(handler: Callable[[web.Request], Awaitable[Any]]) -> Handler:
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
