# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What tests of the page share: the nodes with the console, a browser, pages that fail on their errors."""

from __future__ import annotations

import re
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from browsers import BROWSERS, OPTIONS, browser_path, seeing, write_camera_film
from page_film import Film
from playwright.sync_api import Browser, ConsoleMessage, Page, expect, sync_playwright

from teo_bringup.graph import NODES, Graph, executable_of

START_TIMEOUT = 60.0  # [s] for four processes on a loaded machine
PATIENCE = 45_000  # [ms] for what a page waits for, likewise
expect.set_options(timeout=PATIENCE)

NewPage = Callable[..., Page]


@pytest.fixture(scope="module")
def graph(module_domain_id: int, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Graph]:  # noqa: ARG001
    """Translator, executor, driver and console, on a port that is free."""
    with Graph(tmp_path_factory.mktemp("log")) as graph:
        graph.start_nodes()
        graph.start("console", str(executable_of(*NODES["console"])), "--ros-args", "-p", "port:=0")
        deadline = time.monotonic() + START_TIMEOUT
        while not graph.is_ready():
            graph.check()
            assert time.monotonic() < deadline, graph.tail("console") + graph.tail("translator")
            time.sleep(0.05)
        yield graph


@pytest.fixture(scope="module")
def address(graph: Graph) -> str:
    """Where the page is."""
    found = re.search(r"http://\S+", graph.tail("console"))
    assert found is not None
    return found.group()


@pytest.fixture(scope="session")
def camera_film(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What the browser's camera sees, over and over: a person at rest, who greets, and is at rest again."""
    path = tmp_path_factory.mktemp("camera") / "greeting.y4m"
    write_camera_film(path)
    return path


@contextmanager
def launched(*options: str) -> Iterator[Browser]:
    """A browser without a window; without one there is nothing to test with."""
    path = browser_path()
    if path is None:
        pytest.skip(f"no browser: install one of {', '.join(BROWSERS)}")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=[*OPTIONS, *options])
        yield browser
        browser.close()


@pytest.fixture(scope="session")
def browser(camera_film: Path) -> Iterator[Browser]:
    """One for all tests of the page, before a person who greets."""
    with launched(seeing(camera_film)) as browser:
        yield browser


@pytest.fixture
def brief_browser() -> Iterator[Browser]:
    """One for a single test: while it is there, no other event loop can run in this thread."""
    with launched() as browser:
        yield browser


@pytest.fixture
def new_page(browser: Browser, address: str) -> Iterator[NewPage]:
    """Opens the page, as often as asked, each in a profile of its own; an error in any fails the test."""
    wrong: list[str] = []
    contexts = []

    def note(said: ConsoleMessage) -> None:
        # A page whose node has ended tries again: the browser says so, and it is right.
        if said.type == "error" and "ERR_CONNECTION_REFUSED" not in said.text:
            wrong.append(said.text)

    def open_page(*, tab: str = "", width: int = 1100, height: int = 760, script: str = "") -> Page:
        context = browser.new_context(viewport={"width": width, "height": height}, locale="es-ES")
        contexts.append(context)
        context.set_default_timeout(PATIENCE)
        page = context.new_page()
        page.on("pageerror", lambda error: wrong.append(str(error)))
        page.on("console", note)
        page.on("dialog", lambda dialog: wrong.append(dialog.message))
        if script:
            page.add_init_script(script)
        page.goto(f"{address}#{tab}")
        page.wait_for_selector("#status[data-tone]:not(:empty)")
        return page

    yield open_page
    for context in contexts:
        context.close()
    assert not wrong, wrong


@pytest.fixture(scope="session")
def pictures() -> Path:
    """Where screenshots go, for people to look at."""
    folder = Path(__file__).parents[3] / "out" / "console"
    folder.mkdir(parents=True, exist_ok=True)
    return folder


@pytest.fixture(scope="module")
def film(pictures: Path, request: pytest.FixtureRequest) -> Iterator[Film]:
    """What the tests of a module film, one after the other, goes into one film: page.webp, tabs.webp."""
    film = Film()
    yield film
    film.save(pictures / f"{request.path.stem.removeprefix('test_')}.webp")
