# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What tests of the page share: the nodes with the console, a browser, pages that fail on their errors."""

from __future__ import annotations

import io
import re
import shutil
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import av
import pytest
from page_film import Film
from playwright.sync_api import Browser, ConsoleMessage, Page, sync_playwright

from teo_bringup.graph import CONSOLE, Graph, executable_of

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
# WebGL 2 by the processor, and nothing that a browser does for itself in the background.
OPTIONS = (
    "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
    "--use-fake-device-for-media-stream", "--use-fake-ui-for-media-stream",
    "--disable-background-networking", "--disable-component-update", "--disable-sync", "--no-first-run",
)  # fmt: skip
# A greeting of the synthetic signer: synthesize --script greeting --body man_average --rate 30.
GREETING = Path(__file__).parent / "data" / "greeting.mp4"
CAMERA_RATE = 30.0  # [Hz] at which Chromium plays such a film, from when the camera is switched on
# The sign comes after the countdown of 3 s, in the midst of the 6 s that are recorded then, and once [s].
REST_BEFORE, REST_AFTER = 4.5, 20.0
START_TIMEOUT = 60.0  # [s] for four processes on a loaded machine
PATIENCE = 45_000  # [ms] for what a page waits for, likewise

NewPage = Callable[..., Page]


@pytest.fixture(scope="module")
def graph(module_domain_id: int, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Graph]:  # noqa: ARG001
    """Translator, executor, driver and console, on a port that is free."""
    with Graph(log_folder=tmp_path_factory.mktemp("log")) as graph:
        graph.start_nodes()
        graph.start("console", str(executable_of(*CONSOLE["console"])), "--ros-args", "-p", "port:=0")
        deadline = time.monotonic() + START_TIMEOUT
        while "http://" not in graph.tail("console") or "ready" not in graph.tail("translator"):
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
    with av.open(str(GREETING)) as film:
        images = [image.to_image() for image in film.decode(video=0)]
    pictures = []
    for image in images:
        encoded = io.BytesIO()
        image.save(encoded, "JPEG", quality=85)
        pictures.append(encoded.getvalue())
    path = tmp_path_factory.mktemp("camera") / "greeting.mjpeg"
    rest_before, rest_after = (round(seconds * CAMERA_RATE) for seconds in (REST_BEFORE, REST_AFTER))
    path.write_bytes(pictures[0] * rest_before + b"".join(pictures) + pictures[-1] * rest_after)
    return path


@contextmanager
def launched(*options: str) -> Iterator[Browser]:
    """A browser without a window; without one there is nothing to test with."""
    path = next(filter(None, map(shutil.which, BROWSERS)), None)
    if path is None:
        pytest.skip(f"no browser: install one of {', '.join(BROWSERS)}")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=[*OPTIONS, *options])
        yield browser
        browser.close()


@pytest.fixture(scope="session")
def browser(camera_film: Path) -> Iterator[Browser]:
    """One for all tests of the page, before a person who greets."""
    with launched(f"--use-file-for-fake-video-capture={camera_film}") as browser:
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


@pytest.fixture(scope="session")
def film(pictures: Path) -> Iterator[Film]:
    """What the tests film, one after the other, goes into one film."""
    film = Film()
    yield film
    film.save(pictures / "console.webp")
