# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Reviewing: series are prepared, answered item by item, reported, exported and entered into the table."""

from __future__ import annotations

import csv
import random
import secrets
import tempfile
from pathlib import Path
from typing import Annotated, Any

from aiohttp import web
from msgspec import Meta, Struct

from teo_console.api.workbench import Preparation, Table, Workbench, gloss_key
from teo_console.errors import ConsoleError
from teo_console.protocol import Gloss, Motion
from teo_console.review.report import as_csv, as_json, report
from teo_console.review.series import CHOICES, Flag, NewItem, Rating, SeriesKind, offered
from teo_console.review.store import ANSWER_LENGTH, COMMENT_LENGTH, NAME_LENGTH, ReviewStore
from teo_console.server.app import answering, body

# Rows of a planned motion that are kept: every fourth of 100 a second, as films have them.
_EVERY = 4
_Name = Annotated[str, Meta(min_length=1, max_length=NAME_LENGTH)]
_Sentence = Annotated[str, Meta(min_length=1, max_length=ANSWER_LENGTH)]


class _NewSeries(Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    kind: SeriesKind
    title: Annotated[str, Meta(max_length=100)] = ""
    glosses: Annotated[tuple[Gloss, ...], Meta(max_length=60)] = ()
    """Signs to show; none: as many words as `count`, drawn by chance."""
    sentences: Annotated[tuple[_Sentence, ...], Meta(max_length=30)] = ()
    count: Annotated[int, Meta(ge=1, le=60)] = CHOICES
    choices: bool = True
    """Whether one of 15 is chosen, rather than said in own words."""


class _Reviewer(Struct, frozen=True, forbid_unknown_fields=True):
    reviewer: _Name


class _Understood(Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    reviewer: _Name
    understood: Annotated[str, Meta(max_length=ANSWER_LENGTH)]


class _Rated(Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    reviewer: _Name
    rating: Rating
    flags: Annotated[tuple[Flag, ...], Meta(max_length=6)] = ()
    comment: Annotated[str, Meta(max_length=COMMENT_LENGTH)] = ""


def routes(workbench: Workbench) -> list[web.RouteDef]:
    """Series, their questions and reports; exports; entering them into the table."""

    def store() -> ReviewStore:
        return workbench.table.reviews

    async def all_series(_: web.Request) -> Any:
        return store().series()

    async def new_series(request: web.Request) -> Any:
        wanted = await body(request, _NewSeries)
        name = secrets.token_urlsafe(9)
        total = (len(wanted.glosses) or (0 if wanted.sentences else wanted.count)) + len(wanted.sentences)
        workbench.prepare(name, total, lambda told: _enter_series(workbench, wanted, told))
        return {"preparation": name}

    async def preparation(request: web.Request) -> Any:
        found = workbench.preparations.get(request.match_info["name"])
        if found is None:
            raise ConsoleError(
                "unknown_job", "expected a series that is being prepared, there is none of that name"
            )
        return vars(found)

    async def following(request: web.Request) -> Any:
        reviewer = store().reviewer((await body(request, _Reviewer)).reviewer)
        return {"question": store().next_question(request.match_info["id"], reviewer)}

    async def answer(request: web.Request) -> Any:
        said = await body(request, _Understood)
        reviewer = store().reviewer(said.reviewer)
        return {"meaning": store().answer(request.match_info["id"], reviewer, said.understood)}

    async def rate(request: web.Request) -> Any:
        said = await body(request, _Rated)
        reviewer = store().reviewer(said.reviewer)
        store().rate(request.match_info["id"], reviewer, said.rating, said.flags, said.comment)
        return {}

    async def figures(request: web.Request) -> Any:
        series = request.match_info["id"]
        return report(store().meanings(series), store().answers(series))

    async def export(request: web.Request) -> Any:
        is_json = request.match_info["format"] == "json"
        content = (as_json if is_json else as_csv)(store().answers())
        return web.Response(
            body=content,
            content_type="application/json" if is_json else "text/csv",
            charset="utf-8",
            headers={"Content-Disposition": f'attachment; filename="reviews.{request.match_info["format"]}"'},
        )

    async def enter(_: web.Request) -> Any:
        with tempfile.TemporaryDirectory(prefix="teo-reviews-") as folder:
            table = workbench.table
            path = Path(folder) / "reviews.json"
            path.write_bytes(as_json(table.reviews.answers()))
            job = await workbench.jobs.run(table.commands.enter_reviews(path))
        table.signs.changed()
        return job.result

    return [
        web.get("/api/series", answering(all_series)),
        web.post("/api/series", answering(new_series)),
        web.get("/api/preparations/{name}", answering(preparation)),
        web.post("/api/series/{id}/next", answering(following)),
        web.get("/api/series/{id}/report", answering(figures)),
        web.post("/api/items/{id}/answer", answering(answer)),
        web.post("/api/items/{id}/rating", answering(rate)),
        web.get("/api/reviews.{format:json|csv}", answering(export)),
        web.post("/api/reviews/enter", answering(enter)),
    ]


async def _enter_series(workbench: Workbench, wanted: _NewSeries, told: Preparation) -> str:
    """Plan the motion of every item, and enter the series; returns its name."""
    table = workbench.table
    seed = secrets.randbits(32)
    words = sorted(sign.gloss for sign in (await table.signs.signs()).values() if sign.kind == "lexical")
    # All of them before the first is planned: who has mistyped the last is not to wait for the others.
    signs = [await table.signs.get(gloss_key(gloss)) for gloss in wanted.glosses]
    if not signs and not wanted.sentences:
        drawn = random.Random(seed).sample(words, min(wanted.count, len(words)))
        signs = [await table.signs.get(gloss) for gloss in drawn]
    compared = [sign.gloss for sign in signs if sign.kind == "lexical"] if wanted.choices else []
    near: dict[str, list[str]] = {}
    if compared:
        job = await workbench.jobs.run(table.commands.nearest_signs(compared, CHOICES - 1))
        near = {gloss: [other["gloss"] for other in others] for gloss, others in job.result.items()}
    items = []
    for sign in signs:
        items.append(
            NewItem(
                kind="sign",
                meaning=sign.gloss,
                language=sign.language,
                motion_hash=sign.motion_hash,
                motion=await _planned(workbench, table, sign.gloss),
                choices=offered(sign.gloss, near.get(sign.gloss, ()), words, seed) if wanted.choices else (),
            )
        )
        told.done += 1
    for text in wanted.sentences:
        job = await workbench.jobs.run(table.commands.translate(text))
        mark = text.strip()[-1:]
        motion = await _planned(workbench, table, job.output.strip() + (mark if mark in "?!" else ""))
        language = table.commands.language
        items.append(NewItem(kind="sentence", meaning=text, language=language, motion_hash="", motion=motion))
        told.done += 1
    return table.reviews.add_series(wanted.kind, wanted.title, items, seed)


async def _planned(workbench: Workbench, table: Table, glosses: str) -> Motion:
    """The motion of a sentence in the printed form, as the robot would make it."""
    with tempfile.TemporaryDirectory(prefix="teo-plan-") as folder:
        path = Path(folder) / "plan.csv"
        await workbench.jobs.run(table.commands.plan(glosses, path))
        with path.open(encoding="utf-8", newline="") as file:
            header, *rows = csv.reader(file)
    kept = [tuple(map(float, row)) for row in (*rows[::_EVERY], rows[-1])]
    if kept[-1][0] <= kept[-2][0]:
        kept.pop()
    return Motion(
        joints=tuple(header[1:]),
        times=tuple(row[0] for row in kept),
        positions=tuple(tuple(round(value, 4) for value in row[1:]) for row in kept),
    )
