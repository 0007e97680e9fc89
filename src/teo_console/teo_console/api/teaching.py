# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Teaching and practising: a recording comes in, is tried as a sign or recognised, accepted or discarded."""

from __future__ import annotations

import datetime
import json
import time
from pathlib import Path
from typing import Annotated, Any, Literal

from aiohttp import web
from msgspec import Meta, Struct

from teo_console.api.workbench import WithGloss, Workbench, gloss_key
from teo_console.errors import ConsoleError
from teo_console.jobs.commands import Hands
from teo_console.jobs.recordings import Recording
from teo_console.protocol import Gloss
from teo_console.server.app import answering, body

# Terms that a person can give a movement; the last keeps it in the house.
_Licence = Literal["CC0-1.0", "CC-BY-4.0", "CC-BY-SA-4.0", "for this laboratory alone"]


class _Try(Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    gloss: Gloss
    hands: Hands | None = None


class _Accept(Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    gloss: Gloss
    licence: _Licence
    consent: bool
    """Whether the person in the film agrees that the movement is kept under these terms."""
    person: Annotated[str, Meta(max_length=60)] = ""
    hands: Hands | None = None
    despite_gates: bool = False
    replace: bool = False


def routes(workbench: Workbench) -> list[web.RouteDef]:
    """POST /api/recordings; DELETE ID; below ID: POST try, accept, keep, recognise; GET trial."""

    async def receive(request: web.Request) -> Any:
        recording = await workbench.recordings.receive(
            request.content.iter_chunked(64 * 1024), time.monotonic()
        )
        return {"recording": recording.id, "figures": recording.figures}

    async def discard(request: web.Request) -> Any:
        workbench.recordings.discard(request.match_info["id"])
        return {}

    async def attempt(request: web.Request) -> Any:
        recording, wanted = _of(request), await body(request, _Try)
        command = workbench.table.commands.capture(
            recording.path,
            _cache(recording),
            gloss=gloss_key(wanted.gloss),
            hands=wanted.hands,
            licence="on trial",
            accept=True,  # a trial shows what a gate speaks against, too
            replace=True,
            trial=_trial(recording),
        )
        return workbench.jobs.told(workbench.jobs.submit(command))

    async def trial(request: web.Request) -> Any:
        entry = _entry(_of(request))
        content = json.loads(entry.read_text("utf-8"))
        return {
            "gloss": content["gloss"],
            "motion": {"joints": content["joints"], "times": content["times"], "positions": content["knots"]},
        }

    async def accept(request: web.Request) -> Any:
        recording, wanted = _of(request), await body(request, _Accept)
        if not wanted.consent:
            raise ConsoleError(
                "no_consent",
                "expected that the person in the film agrees to the terms: without it nothing is kept",
            )
        command = workbench.table.commands.capture(
            recording.path,
            _cache(recording),
            gloss=gloss_key(wanted.gloss),
            hands=wanted.hands,
            licence=wanted.licence,
            notes=_consent(wanted),
            accept=wanted.despite_gates,
            replace=wanted.replace,
        )
        return workbench.jobs.told(workbench.jobs.submit(command, then=workbench.table.signs.changed))

    async def keep(request: web.Request) -> Any:
        name = gloss_key((await body(request, WithGloss)).gloss)
        kept = workbench.recordings.keep(request.match_info["id"], workbench.folders.kept, _file_name(name))
        return {"kept": str(kept)}

    async def recognise(request: web.Request) -> Any:
        recording, wanted = _of(request), await body(request, WithGloss)
        command = workbench.table.commands.recognise(
            recording.path, _cache(recording), gloss_key(wanted.gloss)
        )
        return workbench.jobs.told(workbench.jobs.submit(command))

    def _of(request: web.Request) -> Recording:
        return workbench.recordings.get(request.match_info["id"])

    one = "/api/recordings/{id}"
    return [
        web.post("/api/recordings", answering(receive)),
        web.delete(one, answering(discard)),
        web.post(f"{one}/try", answering(attempt)),
        web.get(f"{one}/trial", answering(trial)),
        web.post(f"{one}/accept", answering(accept)),
        web.post(f"{one}/keep", answering(keep)),
        web.post(f"{one}/recognise", answering(recognise)),
    ]


def _cache(recording: Recording) -> Path:
    return recording.folder / "points"


def _trial(recording: Recording) -> Path:
    return recording.folder / "trial"


def _entry(recording: Recording) -> Path:
    """The entry that the last trial left.

    Raises:
        ConsoleError: "not_ready": none did.
    """
    entries = sorted(_trial(recording).glob("*.json"), key=lambda path: path.stat().st_mtime)
    if not entries:
        raise ConsoleError("not_ready", "expected a trial that came to a sign, there is none yet")
    return entries[-1]


def _file_name(gloss: str) -> str:
    return "".join(char if char.isalnum() or char in "_-" else "_" for char in gloss)


def _consent(wanted: _Accept) -> str:
    who = " ".join(wanted.person.split()) or "The person in the film"
    day = datetime.date.today().isoformat()
    return f"{who} agreed on {day} that the movement is kept under: {wanted.licence}."
