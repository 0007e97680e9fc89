# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Jobs: how far they are, and an end to them."""

from __future__ import annotations

from typing import Any

from aiohttp import web

from teo_console.api.requests import answering
from teo_console.api.workbench import Workbench


def routes(workbench: Workbench) -> list[web.RouteDef]:
    """GET and DELETE /api/jobs/ID."""

    async def look(request: web.Request) -> Any:
        return workbench.jobs.get(request.match_info["id"]).told()

    async def cancel(request: web.Request) -> Any:
        workbench.jobs.cancel(request.match_info["id"])
        return {}

    return [
        web.get("/api/jobs/{id}", answering(look)),
        web.delete("/api/jobs/{id}", answering(cancel)),
    ]
