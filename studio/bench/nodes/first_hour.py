# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a newcomer does on the page in a first hour: clicks, keys, and the seconds that it takes."""

from __future__ import annotations

import time
from pathlib import Path
from tempfile import TemporaryDirectory

from browsers import launched, seeing, write_camera_film
from console_nodes import ConsoleNodes
from playwright.sync_api import Locator, Page, expect
from watched_page import PATIENCE, wait_until_ready

from report import Figure

# [s] for a command that looks at a film, as long as the console lets it run.
LONGEST = 240.0
REVIEWED = ("CASA", "PERRO", "AGUA", "MADRE", "LIBRO")


class Visitor:
    """Who clicks and types, and counts both."""

    def __init__(self, page: Page) -> None:
        """Sit down before a page."""
        self.page = page
        self._clicks = self._keys = 0
        self._began = time.monotonic()

    def click(self, what: Locator | str) -> None:
        """Click on something, or tick it."""
        (self.page.locator(what) if isinstance(what, str) else what).click()
        self._clicks += 1

    def type(self, where: str, text: str) -> None:
        """Click into a field and write a text; its line's end is the Enter key."""
        self.click(where)
        self.page.keyboard.type(text)
        self._keys += len(text)

    def task(self, name: str) -> Figure:
        """What was done since the task before."""
        took = time.monotonic() - self._began
        figure = Figure(name, f"{self._clicks} clicks, {self._keys} keys, {took:.0f} s")
        self._clicks = self._keys = 0
        self._began = time.monotonic()
        return figure


def measure() -> list[Figure]:
    """Do each task once, as fast as the page lets a visitor; reading and thinking come on top."""
    expect.set_options(timeout=PATIENCE * 1e3)
    with TemporaryDirectory() as folder:
        film = Path(folder) / "greeting.y4m"
        write_camera_film(film)
        nodes = ConsoleNodes(Path(folder))
        nodes.start()
        try:
            with launched(seeing(film)) as browser:
                page = browser.new_page(viewport={"width": 1280, "height": 800}, locale="es-ES")
                page.goto(nodes.address)
                wait_until_ready(page)
                visitor = Visitor(page)
                return [*_watch(visitor), _teach(visitor), *_review(visitor)]
        finally:
            nodes.stop()


def _watch(visitor: Visitor) -> list[Figure]:
    """Have a sentence signed, and find out why a word of it was spelled."""
    page = visitor.page
    visitor.type("#text", "Hola, me llamo Ana.\n")
    expect(page.locator(".token.lit")).to_be_visible()
    first = visitor.task("a sentence is signed: its first sign")
    wait_until_ready(page)
    whole = visitor.task("the same, to its end")
    visitor.click(page.locator('.token[data-gloss="N"] button'))
    expect(page.locator(".explanation")).to_contain_text("se deletrea")
    return [first, whole, visitor.task("why a word was spelled is found out")]


def _teach(visitor: Visitor) -> Figure:
    """Film a sign of three seconds and enter it into the table."""
    page = visitor.page
    visitor.click("nav a[href='#teach']")
    visitor.type("#teach-gloss", "saludar")
    page.select_option(".camera select", "6")
    visitor.click("#camera-start")
    visitor.click("#camera-record")
    expect(page.locator("#outcome-title")).to_be_visible(timeout=LONGEST * 1e3)
    for box in page.locator("form .tick:not([for=accept-keep]) input").all():
        visitor.click(box)
    visitor.click("form button[type=submit]")
    expect(page.locator("#accepted")).to_contain_text("SALUDAR", timeout=LONGEST * 1e3)
    return visitor.task("a sign is taught, six seconds of film included")


def _review(visitor: Visitor) -> list[Figure]:
    """Make a series of five signs and review them."""
    page = visitor.page
    visitor.click("nav a[href='#review']")
    visitor.type("#new-title", "Cinco")
    visitor.type("#new-glosses", ", ".join(REVIEWED).lower())
    visitor.click("form button[type=submit]")
    row = page.locator("[data-series]").filter(has_text="Cinco")
    expect(row).to_be_visible(timeout=LONGEST * 1e3)
    made = visitor.task("a series of five signs is made")
    visitor.click(row.locator("a").first)
    visitor.type("#reviewer", "Ana\n")
    for _ in REVIEWED:
        visitor.click(page.locator("[data-choice]").first)
        visitor.click("#rating-right")
        visitor.click("form button[type=submit]")
    expect(page.locator("#all-done")).to_be_visible()
    return [made, visitor.task("its five signs are reviewed")]
