# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""All of /api beside the robot's description: the routes of every tab, and of jobs."""

from __future__ import annotations

from typing import Any

from aiohttp import web

from teo_console.api import dictionary, reviewing, teaching
from teo_console.api.workbench import Workbench
from teo_console.server.app import answering


def all_routes(workbench: Workbench) -> list[web.RouteDef]:
    """All routes; of jobs GET and DELETE /api/jobs/ID: how far one is, and an end to it."""

    async def look(request: web.Request) -> Any:
        return workbench.jobs.told(workbench.jobs.get(request.match_info["id"]))

    async def cancel(request: web.Request) -> Any:
        workbench.jobs.cancel(request.match_info["id"])
        return {}

    return [
        web.get("/api/jobs/{id}", answering(look)),
        web.delete("/api/jobs/{id}", answering(cancel)),
        *(route for tab in (dictionary, teaching, reviewing) for route in tab.routes(workbench)),
    ]
