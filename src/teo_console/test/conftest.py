# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What tests of the page share: the nodes with the console, a browser, pages that fail on their errors."""

from __future__ import annotations

import asyncio
import inspect
import os
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from browsers import launched
from console_nodes import ConsoleNodes
from page_film import Film
from playwright.sync_api import Browser, ConsoleMessage, Page, expect
from watched_page import Poses

from teo_bringup.graph import Graph

PATIENCE = 90_000  # [ms] for what a page waits for, likewise
expect.set_options(timeout=PATIENCE)

NewPage = Callable[..., Page]

# Time for a test that is a coroutine [s]: a few seconds on an idle machine.
LONGEST = 60.0


@pytest.fixture
def runner() -> Iterator[asyncio.Runner]:
    """The event loop of a test that is a coroutine, for its fixtures."""
    with asyncio.Runner() as runner:
        yield runner


@pytest.hookimpl(tryfirst=True)
def pytest_pyfunc_call(pyfuncitem: pytest.Function) -> bool | None:
    """Run a test that is a coroutine in the loop of the fixture `runner`, which it or a fixture asks for."""
    if not inspect.iscoroutinefunction(pyfuncitem.function):
        return None
    names = inspect.signature(pyfuncitem.function).parameters
    test = pyfuncitem.function(**{name: pyfuncitem.funcargs[name] for name in names})
    pyfuncitem.funcargs["runner"].run(asyncio.wait_for(test, LONGEST))
    return True


@pytest.fixture(scope="module")
def nodes(module_domain_id: int, tmp_path_factory: pytest.TempPathFactory) -> Iterator[ConsoleNodes]:  # noqa: ARG001
    """Translator, executor, driver and console: starting them takes as long as several tests."""
    nodes = ConsoleNodes(tmp_path_factory.mktemp("nodes"))
    nodes.start()
    yield nodes
    nodes.stop()


@pytest.fixture
def graph(nodes: ConsoleNodes) -> Graph:
    """The nodes in a known state, whatever the test before did."""
    nodes.settle()
    return nodes.graph


@pytest.fixture
def address(nodes: ConsoleNodes, graph: Graph) -> str:  # noqa: ARG001
    """Where the page is."""
    return nodes.address


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    """One for a module's tests of the page: while it is there, no other event loop can run in this thread."""
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

    def open_page(
        *,
        tab: str = "",
        width: int = 1100,
        height: int = 760,
        script: str = "",
        poses: Poses | None = None,
    ) -> Page:
        context = browser.new_context(viewport={"width": width, "height": height}, locale="es-ES")
        contexts.append(context)
        context.set_default_timeout(PATIENCE)
        page = context.new_page()
        page.on("pageerror", lambda error: wrong.append(str(error)))
        page.on("console", note)
        # Nothing of the page alerts: what does was smuggled in.
        page.on("dialog", lambda dialog: wrong.append(dialog.message) if dialog.type == "alert" else None)
        if poses is not None:
            page.on("websocket", poses.listen)
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
    """What the tests of a module film goes into one film, page.webp or tabs.webp, where TEO_FILM is set."""
    film = Film(wanted="TEO_FILM" in os.environ)
    yield film
    film.save(pictures / f"{request.path.stem.removeprefix('test_')}.webp")
