# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""All of /api beside the robot's description."""

from __future__ import annotations

from aiohttp import web

from teo_console.api import dictionary, job_routes, reviewing, teaching
from teo_console.api.workbench import Workbench


def all_routes(workbench: Workbench) -> list[web.RouteDef]:
    """The routes of every tab."""
    return [
        route for room in (job_routes, dictionary, teaching, reviewing) for route in room.routes(workbench)
    ]
