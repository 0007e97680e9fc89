# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The page of a console for another robot and language: it names these, and works on their signs."""

from __future__ import annotations

import re
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, expect

from teo_bringup.graph import NODES, Graph, executable_of
from teo_signs.look_up_table import Lut

CONSOLE = str(executable_of(*NODES["console"]))
START_TIMEOUT = 120.0  # [s] on a loaded machine
LONG = 120_000  # [ms] for a command of the project's on a loaded machine


@pytest.fixture
def address(
    domain_id: int,  # noqa: ARG001
    data_home: Path,  # noqa: ARG001
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> Iterator[str]:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))  # no film was made before
    with Graph(tmp_path / "log") as graph:
        other = ("-p", "robot:=gr1t2", "-p", "language:=ase")
        graph.start("console", CONSOLE, "--ros-args", "-p", "port:=0", *other)
        deadline = time.monotonic() + START_TIMEOUT
        while not graph.is_ready():
            graph.check()
            assert time.monotonic() < deadline, graph.tail("console")
            time.sleep(0.05)
        found = re.search(r"http://\S+", graph.tail("console"))
        assert found is not None, graph.tail("console")
        yield found.group()


@pytest.mark.slow
def test_all_of_the_page_is_of_the_robot_and_the_language_that_run(
    address: str, browser: Browser, pictures: Path
) -> None:
    signs = Lut.open(language="ase", robot="gr1t2")
    page = browser.new_page(locale="es-ES")
    page.goto(address)
    expect(page.locator(".brand")).to_have_text("GR1T2 signa en ASL")
    expect(page.locator("label[for=text]")).to_have_text("Texto en inglés")
    page.click("#language")
    expect(page.locator(".brand")).to_have_text("GR1T2 signs in ASL")
    expect(page).to_have_title("GR1T2 signs")
    expect(page.locator("label[for=text]")).to_have_text("Text in English")
    expect(page.locator("#text")).to_have_attribute("placeholder", signs.language.sentences[0])
    page.goto(f"{address}#dictionary")
    expect(page.locator("main")).to_contain_text(f"Signs found: {len(signs)}.", timeout=LONG)
    page.fill("#coverage-text", "My mother has a screw.")
    page.click("form button[type=submit]")
    expect(page.locator("form ol a")).to_have_text(["SCREW"], timeout=LONG)
    page.fill("#search-word", "mother")
    page.click("[data-gloss=MOTHER]")
    page.get_by_role("button", name="Show as a film").click()
    expect(page.locator("video")).to_be_visible(timeout=LONG)
    page.screenshot(path=pictures / "other_robot.png", full_page=True)
    for tab in ("watch", "teach", "review", "practise", "dictionary"):
        page.goto(f"{address}#{tab}")
        expect(page.locator("#content")).to_have_attribute("data-tab", tab)
        expect(page.locator("#content h1")).to_be_attached(timeout=LONG)
        # The languages to choose from are all named.
        page.locator("#sign-language").evaluate_all("choices => choices.forEach((each) => each.remove())")
        assert not re.search(r"TEO|LSE|Spanish|\{", page.inner_text("body"))
    page.close()


@pytest.mark.parametrize(("name", "code"), [("robot", "unknown_robot"), ("language", "unknown_language")])
def test_a_robot_or_language_that_is_not_there_is_refused_at_the_start(
    name: str,
    code: str,
    domain_id: int,  # noqa: ARG001
) -> None:
    started = [CONSOLE, "--ros-args", "-p", "port:=0", "-p", f"{name}:=nobody"]
    ended = subprocess.run(started, capture_output=True, text=True, timeout=START_TIMEOUT, check=False)
    assert ended.returncode == 1
    assert f"console: [{code}] expected" in ended.stderr
