# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The tabs in a browser without a robot: sentences reviewed, ratings entered, a bag taught, reasons read."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from console_api import Api
from made_bags import signing, write_bag
from playwright.sync_api import Browser, Page, expect

from teo_signs.look_up_table import Lut
from teo_signs.motion_hash import motion_hash

SOURCES = Path(__file__).parents[2]
LONG = 120_000  # [ms] for a command of the project's on a loaded machine


@pytest.fixture
def api(tmp_path: Path) -> Iterator[Api]:
    opened = Api(tmp_path)
    yield opened
    opened.thread.close()


@pytest.fixture
def page(brief_browser: Browser) -> Iterator[Page]:
    context = brief_browser.new_context(viewport={"width": 1100, "height": 760}, locale="es-ES")
    yield context.new_page()
    context.close()


def test_a_sentence_is_reviewed_and_what_three_found_right_is_entered_into_the_table(
    api: Api, page: Page, data_home: Path
) -> None:
    hashes = {"CALLE": motion_hash(Lut.open(None)["CALLE"])}
    series = api.add_series("review", "CALLE", "¿Dónde vives?", hashes=hashes)
    for reviewer in ("Ana", "Luis", "Eva"):
        page.goto("about:blank")  # each reviewer opens the link
        page.goto(f"{api.url}/#review/{series}")
        page.fill("#reviewer", reviewer)
        page.keyboard.press("Enter")
        for number in (1, 2):
            expect(page.locator("h2")).to_have_text(re.compile(f"^(Signo|Frase) {number} de 2$"))
            is_sentence = page.inner_text("h2").startswith("Frase")
            assert not re.search("CALLE|vives", page.inner_text("main"))
            page.fill("#understood", "dónde vives" if is_sentence else "calle")
            page.keyboard.press("Enter")
            expect(page.locator(".meaning")).to_have_text(
                f"Es: {'¿Dónde vives?' if is_sentence else 'CALLE'}"
            )
            assert page.get_by_text("Grabarlo de nuevo").count() == (0 if is_sentence else 1)
            page.check("#rating-right")
            page.get_by_role("button", name="Siguiente").click()
        expect(page.locator("#all-done")).to_be_visible()
    page.goto(f"{api.url}/#review")
    page.get_by_role("button", name="Pasar a la tabla de signos").click()
    expect(page.locator("#entered")).to_contain_text("CALLE: revisado por signantes", timeout=LONG)
    expect(page.locator("#entered")).to_contain_text("Signos valorados: 1. Cambios en la tabla: 1.")
    assert Lut.open(data_home / "teo" / "lut")["CALLE"].provenance.standing == "reviewed"


def test_a_bag_is_taught_and_nothing_of_it_is_left_when_it_is_discarded(
    api: Api, page: Page, tmp_path: Path
) -> None:
    bag = write_bag(tmp_path / "señalar.mcap", signing())
    page.goto(f"{api.url}/#teach/SEÑALAR")
    page.set_input_files("#film-file", bag)
    expect(page.locator("#outcome-title")).to_contain_text("SEÑALAR", timeout=LONG)
    expect(page.locator("main")).to_contain_text("Una grabación sin vídeo.")
    assert page.locator(".gate.passed, .gate.failed").count() >= 5
    page.get_by_role("button", name="Descartar y repetir").click()
    expect(page.locator("#outcome-title")).to_have_count(0)
    assert not [path for path in api.folders.cache.glob("recordings-*/*") if path.is_dir()]


def reasons(*folders: str) -> set[str]:
    """Every stable reason that sources in these folders give to an error of theirs."""
    trees = [
        ast.parse(path.read_text("utf-8")) for each in folders for path in SOURCES.glob(f"{each}/**/*.py")
    ]
    found = set()
    for node in (node for tree in trees for node in ast.walk(tree)):
        if isinstance(node, ast.Call) and node.args and isinstance(node.args[0], ast.Constant):
            name = node.func.id if isinstance(node.func, ast.Name) else getattr(node.func, "attr", "")
            code = node.args[0].value
            if name.endswith("Error") and isinstance(code, str) and re.fullmatch("[a-z][a-z0-9_]+", code):
                found.add(code)
    return found


# Common words of one language that are none of the other's.
FOREIGN = {
    "es": r"\b(the|expected|could|not|is|of|it|too|there)\b",
    "en": r"\b(el|la|los|que|de|hay|es|un|una)\b",
}


def test_every_reason_is_read_in_the_language_of_the_page(api: Api, page: Page) -> None:
    codes = sorted(reasons("teo_*/teo_*"))
    assert len(codes) > 250
    # What the tabs themselves refuse is said in words of its own, not by the reason's name.
    own = reasons(*(f"teo_console/teo_console/{room}" for room in ("api", "jobs", "review")))
    page.goto(api.url)
    for language, foreign in FOREIGN.items():
        told = page.evaluate(
            """async ([language, codes]) => {
              const { speak } = await import("/js/i18n.js");
              const { refusalText } = await import("/js/status.js");
              await speak(language);
              return codes.map((code) => refusalText(code, "expected a sentence of the node's own"));
            }""",
            [language, codes],
        )
        for code, sentence in zip(codes, told, strict=True):
            assert re.fullmatch(r".+[.!?)]", sentence), (code, sentence)
            assert not re.search(foreign, sentence.replace(code, "")), (code, sentence)
            assert code not in own or f": {code})" not in sentence, code
