# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Signs in SignWriting on the page, where the user has drawn them and where not. Without ROS's nodes."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from aiohttp import web
from playwright.sync_api import APIRequestContext, Browser, Page, expect, sync_playwright

from teo_console.api.dictionary import sign_writing_routes
from teo_console.protocol import Answer, FromPage
from teo_console.server.access import Access
from teo_console.server.app import make_app
from teo_console.server.hub import Hub
from teo_console.server.thread import ServerThread
from teo_sign_authoring.signwriting.dictionary_file import read_dictionary
from teo_sign_authoring.signwriting.drawing import Pen, find_written, write_drawings

WEB = Path(__file__).parents[1] / "web"
PATIENCE = 45_000  # [ms] on a loaded machine
# Two flat hands that touch; a hand that moves up.
SPML = """<spml puddle="55">
 <entry><term>M520x520S15a00480x480S15a08500x480S20500495x510</term><term>bandeja</term></entry>
 <entry><term>M520x520S20310500x500S22a00500x470</term><term>subir 2</term></entry>
</spml>"""
TERMS = {"BANDEJA": "bandeja", "SUBIR": "subir 2"}


def listed(gloss: str, source: str) -> dict[str, object]:
    """A sign as /api/signs has it."""
    return {
        "gloss": gloss, "language": "ssp", "source": source, "licence": "Apache-2.0", "handedness": "both",
        "handshapes": [], "duration": 1.0, "standing": "described", "kind": "lexical",
    }  # fmt: skip


@contextmanager
def server(folder: Path) -> Iterator[str]:
    """The page with three signs, of which the dictionary's are two; no robot. Gives its address."""

    async def signs(_: web.Request) -> web.Response:
        sources = {gloss: f'SignPuddle LSE dictionary, entry "{term}"' for gloss, term in TERMS.items()}
        return web.json_response([listed(*each) for each in {**sources, "CASA": "recorded"}.items()])

    def app() -> web.Application:
        async def refuse(asked: FromPage) -> Answer:
            return Answer(id=asked.id, success=False, code="no_executor")

        return make_app(
            web_folder=WEB,
            access=Access.for_address("127.0.0.1", frozenset()),
            hub=Hub(refuse, lambda _: None),
            urdf=lambda: "<robot/>",
            routes=[web.get("/api/signs", signs), *sign_writing_routes(folder)],
        )

    thread = ServerThread(app, "127.0.0.1", 0)
    try:
        yield f"http://127.0.0.1:{thread.port}"
    finally:
        thread.close()


@pytest.fixture
def drawings(tmp_path: Path) -> Path:
    """A folder of drawings, made from a dictionary."""
    (tmp_path / "dictionary.spml").write_text(SPML, "utf-8")
    found, missing = find_written(TERMS, read_dictionary(tmp_path / "dictionary.spml"))
    assert not missing
    pen = Pen()
    write_drawings(tmp_path / "signwriting", {entry: pen.draw(entry) for entry in found})
    return tmp_path / "signwriting"


@contextmanager
def page_of(browser: Browser, address: str) -> Iterator[Page]:
    """The tab Dictionary; what the browser says is wrong fails the test."""
    page = browser.new_page(viewport={"width": 390, "height": 844}, locale="en-GB")
    wrong: list[str] = []
    page.on("pageerror", lambda error: wrong.append(str(error)))
    page.on("console", lambda said: wrong.append(said.text) if said.type == "error" else None)
    page.goto(f"{address}/#dictionary")
    yield page
    page.close()
    assert not wrong, wrong


def choose(page: Page, gloss: str) -> None:
    page.click(f"[data-gloss={gloss}]", timeout=PATIENCE)
    expect(page.locator(".dictionary h2[tabindex]")).to_have_text(gloss, timeout=PATIENCE)


def test_a_sign_is_shown_as_the_dictionary_writes_it(
    drawings: Path, brief_browser: Browser, pictures: Path
) -> None:
    with server(drawings) as address, page_of(brief_browser, address) as page:
        choose(page, "BANDEJA")
        drawing = page.locator(".signwriting svg")
        expect(drawing).to_have_attribute("aria-label", "BANDEJA in SignWriting: hand ×2, contact ×1")
        expect(page.locator(".signwriting")).to_contain_text("from the entry “bandeja”")
        page.locator(".signwriting").scroll_into_view_if_needed()
        page.screenshot(path=pictures / "signwriting_phone.png")
        box = page.locator(".signwriting use").evaluate("use => use.getBoundingClientRect().toJSON()")
        assert box["width"] > 40
        assert box["height"] > 40
        choose(page, "SUBIR")
        expect(drawing).to_have_attribute("aria-label", "SUBIR in SignWriting: hand ×1, movement ×1")
        choose(page, "CASA")
        expect(drawing).to_have_count(0)


def test_where_nothing_is_drawn_the_page_shows_nothing_and_nothing_is_wrong(
    tmp_path: Path, brief_browser: Browser
) -> None:
    with server(tmp_path / "nowhere") as address, page_of(brief_browser, address) as page:
        choose(page, "BANDEJA")
        expect(page.locator(".signwriting")).to_have_count(0)


@pytest.fixture
def requests() -> Iterator[APIRequestContext]:
    with sync_playwright() as playwright:
        context = playwright.request.new_context()
        yield context
        context.dispose()


def test_the_two_files_and_no_other_are_given_out_under_the_page_s_rules(
    drawings: Path, requests: APIRequestContext
) -> None:
    (drawings / "private.txt").write_text("secret", "utf-8")
    with server(drawings) as address:
        for name, kind in (("signs.json", "application/json"), ("drawings.svg", "image/svg+xml")):
            answer = requests.get(f"{address}/signwriting/{name}")
            assert (answer.status, answer.headers["content-type"]) == (200, kind)
            assert "default-src 'self'" in answer.headers["content-security-policy"]
            assert answer.headers["x-content-type-options"] == "nosniff"
        for name in ("private.txt", "", "..%2Fdictionary.spml", "drawings.svg%2F..%2Fprivate.txt"):
            assert requests.get(f"{address}/signwriting/{name}").status in (403, 404), name
        stranger = requests.get(f"{address}/signwriting/signs.json", headers={"Host": "evil.example"})
        assert stranger.status == 403
