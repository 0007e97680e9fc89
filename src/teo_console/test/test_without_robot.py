# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The tabs in a browser without a robot: sentences reviewed, ratings entered, a bag taught, reasons read."""

from __future__ import annotations

import ast
import json
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from console_api import Api
from made_bags import signing, write_bag
from playwright.sync_api import Browser, Page, expect
from watched_page import accessible, photograph

from teo_lut_executor.execution.situation import BLOCKED
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


def test_a_sign_is_found_by_its_word_and_handshape_and_a_text_says_what_to_record(
    api: Api, page: Page, pictures: Path
) -> None:
    page.goto(f"{api.url}/#dictionary")
    page.fill("#search-word", "bíci")  # whatever the accents
    page.select_option("#search-hand", "A")
    expect(page.locator(".words button")).to_have_text(["BICICLETA"])
    page.select_option("#search-hand", "B")
    expect(page.locator(".words button")).to_have_count(0)
    page.select_option("#search-hand", "A")
    page.click(".words button")
    expect(page.locator("dl")).to_contain_text("DILSE")
    page.fill("#coverage-text", "La matrona tiene una bicicleta.")
    page.click("form button[type=submit]")
    expect(page.locator("form ol a")).to_have_text(["MATRONA"], timeout=LONG)
    accessible(page)
    photograph(page, pictures, "dictionary")
    page.click("form ol a")
    expect(page.locator("#teach-gloss")).to_have_value("MATRONA")


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


def reasons(*patterns: str) -> set[str]:
    """Every stable reason that these sources give to an error of theirs, or to what they say of one."""
    trees = [ast.parse(path.read_text("utf-8")) for each in patterns for path in SOURCES.glob(each)]
    calls = [node for tree in trees for node in ast.walk(tree) if isinstance(node, ast.Call)]
    given = [call.args[0] for call in calls if call.args and name_of(call.func).endswith("Error")]
    given += [keyword.value for call in calls for keyword in call.keywords if keyword.arg == "code"]
    codes = {each.value for each in given if isinstance(each, ast.Constant) and isinstance(each.value, str)}
    return {code for code in codes if re.fullmatch("[a-z][a-z0-9_]+", code)}


def name_of(called: ast.expr) -> str:
    return called.id if isinstance(called, ast.Name) else getattr(called, "attr", "")


# Where reasons arise that come to the page: what is called while a text is translated, a sentence planned and
# signed, a command carried out.
TELLING = (
    "teo_sign_translator/teo_sign_translator/text/**/*.py",
    "teo_sign_translator/teo_sign_translator/pipeline/**/*.py",
    "teo_sign_translator/teo_sign_translator/node/**/*.py",
    "teo_signs/teo_signs/tokens.py",
    "teo_signs/teo_signs/lexicon.py",
    "teo_motion/teo_motion/**/*.py",
    "teo_lut_executor/teo_lut_executor/execution/**/*.py",
    "teo_lut_executor/teo_lut_executor/node/**/*.py",
    "teo_lut_executor/teo_lut_executor/*.py",
    "teo_sim_driver/teo_sim_driver/**/*.py",
    "teo_console/teo_console/**/*.py",
)
# With these a node does not start or does not take a parameter, or only its log tells them.
NOT_TOLD = {
    "bad_address", "bad_factor", "bad_hand", "bad_limits", "bad_period", "bad_policy", "bad_rest",
    "bad_robot", "bad_standing", "bad_style", "empty_speech", "invalid_model", "model_not_installed",
    "mujoco_missing", "no_boards", "port_taken", "unknown_model", "unknown_plant",
}  # fmt: skip


@pytest.mark.parametrize("language", ["es", "en"])
def test_every_refusal_that_comes_to_the_page_says_why_and_what_to_do(language: str) -> None:
    codes = reasons(*TELLING) | {code for code, _ in BLOCKED.values()}
    assert {"moving", "limit_switch", "not_paused", "planner_lost", "driver_fault"} <= codes
    assert codes >= NOT_TOLD, NOT_TOLD - codes
    folder = SOURCES / "teo_console" / "web" / "i18n"
    words = {
        key: text
        for name in (f"{language}.json", f"{language}.tabs.json")
        for key, text in json.loads((folder / name).read_text("utf-8")).items()
    }
    told = {code: words.get(f"code.{code}", "") for code in codes - NOT_TOLD}
    assert not {code: text for code, text in told.items() if not re.fullmatch(r"[^:]+: [^:]+\.", text)}


# Common words of one language that are none of the other's.
FOREIGN = {
    "es": r"\b(the|expected|could|not|is|of|it|too|there)\b",
    "en": r"\b(el|la|los|que|de|hay|es|un|una)\b",
}


@pytest.mark.slow
def test_every_reason_is_read_in_the_language_of_the_page(api: Api, page: Page) -> None:
    codes = sorted(reasons("teo_*/teo_*/**/*.py"))
    assert len(codes) > 200
    # What the tabs themselves refuse is said in words of its own, not by the reason's name.
    own = reasons(*(f"teo_console/teo_console/{room}/**/*.py" for room in ("api", "jobs", "review")))
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
