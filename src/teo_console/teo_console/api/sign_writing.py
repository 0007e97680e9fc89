# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Signs in SignWriting, which a user draws from the community's dictionary with `draw_signwriting`."""

from __future__ import annotations

from pathlib import Path

from aiohttp import web

_NAMES = ("signs.json", "drawings.svg")


def routes(folder: Path) -> list[web.RouteDef]:
    """GET /signwriting/signs.json and /signwriting/drawings.svg; without a body where nothing was drawn.

    Having none is no error, which a browser would report: most users have not drawn any.
    """

    def route(path: Path) -> web.RouteDef:
        async def give(_: web.Request) -> web.StreamResponse:
            return web.FileResponse(path) if path.is_file() else web.Response(status=204)

        return web.get(f"/signwriting/{path.name}", give)

    return [route(folder / name) for name in _NAMES]
