# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Teach and Practise in a browser, before the real nodes and commands."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from fractions import Fraction
from pathlib import Path

import av
import pytest
from browsers import GREETING, launched, seeing, write_camera_film
from page_film import Film
from playwright.sync_api import Browser, Page, expect
from watched_page import accessible, photograph, wait_until_ready

NewPage = Callable[..., Page]

# As long as the console lets a command that looks at films run [ms]; twenty seconds on an idle machine.
LONG = 240_000


@pytest.fixture(scope="module")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browser]:
    """Its camera sees over and over: a person at rest, who greets, and is at rest again."""
    path = tmp_path_factory.mktemp("camera") / "greeting.y4m"
    write_camera_film(path)
    with launched(seeing(path)) as browser:
        yield browser


@pytest.mark.slow
def test_a_sign_is_filmed_looked_at_accepted_and_signed_and_then_practised(
    new_page: NewPage, pictures: Path, tmp_path: Path, film: Film
) -> None:
    page = new_page(tab="teach")
    page.click("#camera-start")  # the word comes first, or the film would be for nothing
    expect(page.locator("#teach-gloss")).to_be_focused()
    expect(page.locator("#camera-record")).to_be_hidden()
    page.fill("#teach-gloss", "saludar")
    accessible(page)
    page.select_option(".camera select", "6")
    wait_until_ready(page)
    with film.scene(page) as scene:
        page.click("#camera-start")
        expect(page.locator("#camera-record")).to_be_focused()
        page.keyboard.press("Enter")  # at once: a click waits until nothing moves
        expect(page.locator(".viewfinder")).to_be_hidden()  # the camera is off once the film is there
        scene.running = False
        expect(page.locator("#outcome-title")).to_be_visible(timeout=LONG)
        scene.running = True
        expect(page.locator(".gate.passed, .gate.failed")).to_have_count(7)  # no contact, no gate of contacts
        place = page.locator("[data-gate=place_off]")
        expect(place).to_contain_text(re.compile(r"hasta a \d+(,\d)? cm de su sitio"))
        place.get_by_role("button", name="Lo peor").click()
        expect(page.locator(".side-by-side video")).to_have_js_property("paused", True)
        expect(page.locator(".similar li")).to_have_count(5)
        page.click("form button[type=submit]")  # nothing is kept without consent
        expect(page.locator("#notice")).to_be_visible()
        for box in page.locator("form .tick:not([for=accept-keep]) input").all():
            box.check()
    accessible(page)
    photograph(page, pictures, "teach")
    page.click("form button[type=submit]")
    expect(page.locator("#accepted")).to_contain_text("SALUDAR", timeout=LONG)
    page.click("form button.primary")
    page.click("nav a[href='#watch']")
    with film.scene(page):
        expect(page.locator(".history li").first).to_contain_text("SALUDAR")

    # The same movement again is among the first (ADIÓS is waved too); another sign is not, and differs.
    again = thinned(tmp_path)
    assert practised(page, "saludar", again) in ("practise.right", "practise.near")
    accessible(page)
    photograph(page, pictures, "practise")
    assert practised(page, "dormir", again) == "practise.other"
    different, same = page.locator(".difference.large").first, page.locator(".difference.small").first
    full = [each.locator("meter").evaluate("bar => bar.value") for each in (different, same)]
    assert full[0] < full[1]  # a long bar is a good one
    expect(page.locator(".side-by-side video")).to_be_visible()


def thinned(folder: Path) -> Path:
    """The film of the greeting with every other image, which takes half the time to look at."""
    path = folder / "greeting.mp4"
    with av.open(str(GREETING)) as source, av.open(str(path), "w") as out:
        stream = out.add_stream("libx264", rate=15)
        stream.width, stream.height, stream.pix_fmt = 640, 480, "yuv420p"
        for number, image in enumerate(list(source.decode(video=0))[::2]):
            image.pts, image.time_base = number, Fraction(1, 15)
            out.mux(stream.encode(image))
        out.mux(stream.encode())
    return path


def practised(page: Page, word: str, film: Path) -> str | None:
    """What the page says of a film in which a word was to be signed."""
    page.goto(f"{page.url.split('#')[0]}#practise/{word.upper()}")
    expect(page.locator("input[list]")).to_have_value(word.upper(), timeout=LONG)
    page.set_input_files("#film-file", film)
    expect(page.locator("[data-verdict]")).to_be_visible(timeout=LONG)
    return page.locator("[data-verdict]").get_attribute("data-verdict")
