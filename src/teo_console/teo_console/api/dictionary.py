# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The dictionary: the list of signs, films and SignWriting of them, and what of a text has signs."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path
from typing import Annotated, Any

import msgspec
from aiohttp import web
from msgspec import Meta, Struct

from teo_console.api.workbench import WithGloss, Workbench, gloss_key
from teo_console.errors import ConsoleError
from teo_console.server.app import answering, body
from teo_sign_languages import Language, load_language

# A page of a book [characters]: it is translated sentence by sentence, some 50 ms each.
_TEXT_LENGTH = 5000
_SIGN_WRITING = ("signs.json", "drawings.svg")
# Lists of words whose third column says what they are about.
_CLASSIFIED = ("nouns.tsv", "adjectives.tsv")
# Sentences with the signs of each, `GLOSS(words)` with a slash between.
_SENTENCES = "written_pairs.tsv"
_FILM_NAME = re.compile(r"[0-9a-f]{64}\.mp4")


class _WantCoverage(Struct, frozen=True, forbid_unknown_fields=True):
    text: Annotated[str, Meta(min_length=1, max_length=_TEXT_LENGTH)]


def routes(workbench: Workbench) -> list[web.RouteDef]:
    """GET /api/signs; POST /api/films, GET /api/films/HASH.mp4; POST /api/coverage; signs in SignWriting."""
    films = workbench.folders.cache / "films"

    async def signs(_: web.Request) -> Any:
        table = workbench.table
        language = load_language(table.commands.language)
        topics, uses = topics_of(language), uses_of(language)
        return [
            {**msgspec.structs.asdict(sign), "topics": topics.get(sign.gloss, ()), "uses": uses[sign.gloss]}
            for sign in (await table.signs.signs()).values()
        ]

    async def want_film(request: web.Request) -> Any:
        sign = await workbench.table.signs.get((await body(request, WithGloss)).gloss)
        path = films / f"{sign.motion_hash}.mp4"
        told: dict[str, Any] = {"film": f"/api/films/{path.name}", "job": None}
        if not path.exists():
            films.mkdir(parents=True, exist_ok=True)
            told["job"] = workbench.jobs.told(
                workbench.jobs.submit(workbench.table.commands.film(sign.gloss, path))
            )
        return told

    async def film(request: web.Request) -> Any:
        name = request.match_info["name"]
        path = films / name
        if not _FILM_NAME.fullmatch(name) or not path.is_file():
            raise ConsoleError(
                "unknown_sign", "expected a film that was made before, there is none of that name"
            )
        return web.FileResponse(path)

    async def coverage(request: web.Request) -> Any:
        wanted = await body(request, _WantCoverage)
        return workbench.jobs.told(workbench.jobs.submit(workbench.table.commands.coverage(wanted.text)))

    return [
        web.get("/api/signs", answering(signs)),
        web.post("/api/films", answering(want_film)),
        web.get("/api/films/{name}", answering(film)),
        web.post("/api/coverage", answering(coverage)),
        *sign_writing_routes(workbench.folders.signwriting),
    ]


def topics_of(language: Language) -> dict[str, tuple[str, ...]]:
    """What words are about ("family", "colour"), by gloss, as the language's lists of words have it."""
    topics: dict[str, tuple[str, ...]] = {}
    for name in _CLASSIFIED:
        path = language.text / "lexicon" / name
        lines = path.read_text("utf-8").splitlines() if path.is_file() else []
        for lemma, _, classes, *_ in (line.split("\t") for line in lines if line and line[0] != "#"):
            topics[gloss_key(lemma)] = (*topics.get(gloss_key(lemma), ()), *classes.split(","))
    return topics


def uses_of(language: Language) -> Counter[str]:
    """How often each sign is made in the language's sentences that people would say, by gloss."""
    path = language.text / _SENTENCES
    lines = path.read_text("utf-8").splitlines() if path.is_file() else []
    pairs = (line.split("\t") for line in lines if line and line[0] != "#")
    return Counter(gloss_key(said.partition("(")[0]) for _, signs in pairs for said in signs.split("/"))


def sign_writing_routes(folder: Path) -> list[web.RouteDef]:
    """GET /signwriting/signs.json and /signwriting/drawings.svg; without a body where nothing was drawn.

    A user draws them from the community's dictionary with `draw_signwriting`. Having none is no error, which
    a browser would report: most users have not drawn any.
    """

    def route(path: Path) -> web.RouteDef:
        async def give(_: web.Request) -> web.StreamResponse:
            return web.FileResponse(path) if path.is_file() else web.Response(status=204)

        return web.get(f"/signwriting/{path.name}", give)

    return [route(folder / name) for name in _SIGN_WRITING]
