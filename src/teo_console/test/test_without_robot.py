# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The tabs in a browser without a robot: signs reviewed, found, taught, shown in writing; reasons read."""

from __future__ import annotations

import ast
import functools
import json
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from aiohttp import web
from console_api import WEB, Api
from made_bags import signing, write_bag
from playwright.sync_api import Browser, Page, Route, expect
from watched_page import accessible, photograph

from teo_console.api.dictionary import sign_writing_routes
from teo_console.protocol import Answer, FromPage
from teo_console.server.access import Access
from teo_console.server.app import make_app
from teo_console.server.hub import Hub
from teo_console.server.thread import ServerThread
from teo_lut_executor.execution.situation import BLOCKED
from teo_sign_authoring.signwriting.dictionary_file import read_dictionary
from teo_sign_authoring.signwriting.drawing import Pen, find_written, write_drawings
from teo_signs.look_up_table import Lut

SOURCES = Path(__file__).parents[2]
LONG = 120_000  # [ms] for a command of the project's on a loaded machine
# Two flat hands that touch; a hand that moves up.
SPML = """<spml puddle="55">
 <entry><term>M520x520S15a00480x480S15a08500x480S20500495x510</term><term>bandeja</term></entry>
 <entry><term>M520x520S20310500x500S22a00500x470</term><term>subir 2</term></entry>
</spml>"""
TERMS = {"BANDEJA": "bandeja", "SUBIR": "subir 2"}


@pytest.fixture
def api(tmp_path: Path) -> Iterator[Api]:
    opened = Api(tmp_path)
    yield opened
    opened.thread.close()


@pytest.fixture
def page(browser: Browser) -> Iterator[Page]:
    context = browser.new_context(viewport={"width": 1100, "height": 760}, locale="es-ES")
    yield context.new_page()
    context.close()


@pytest.mark.slow
def test_a_series_is_made_reviewed_blind_and_what_three_found_right_is_entered_into_the_table(
    api: Api, page: Page, data_home: Path, pictures: Path
) -> None:
    def submit() -> None:
        page.click("form button[type=submit]")

    page.goto(f"{api.url}/#review")
    page.fill("#new-title", "Dos")
    page.fill("#new-glosses", "calle\ntornillo")
    page.fill("#new-sentences", "¿Dónde vives?")
    submit()
    expect(page.locator("#notice")).to_contain_text("tornillo", timeout=LONG)
    page.fill("#new-glosses", "calle")
    page.select_option("#new-choices", "")
    submit()
    row = page.locator("[data-series]").filter(has_text="Dos")
    expect(row).to_be_visible(timeout=LONG)
    accessible(page)
    photograph(page, pictures, "review")
    address = f"{api.url}/#review/{row.get_attribute('data-series')}"
    for reviewer in ("Ana", "Luis", "Eva"):
        page.goto("about:blank")  # each reviewer opens the link
        page.goto(address)
        page.fill("#reviewer", reviewer)
        page.keyboard.press("Enter")
        for number in (1, 2):
            expect(page.locator("h2")).to_have_text(re.compile(f"^(Signo|Frase) {number} de 2$"))
            is_sign = page.inner_text("h2").startswith("Signo")
            assert not re.search("CALLE|vives", page.inner_text("main"))
            page.fill("#understood", "calle")
            page.keyboard.press("Enter")
            expect(page.locator(".meaning")).to_have_text(f"Es: {'CALLE' if is_sign else '¿Dónde vives?'}")
            assert page.get_by_text("Grabarlo de nuevo").count() == is_sign
            if (reviewer, number) == ("Ana", 1):
                accessible(page)
                photograph(page, pictures, "reviewing")
                submit()
                first = "Di antes cómo lo hace: correcto, se entiende o mal."
                expect(page.locator("#notice")).to_have_text(first)
            page.check("#rating-right" if is_sign else "#rating-wrong")
            page.check("#flag-movement")
            page.fill("#comment", "<img src=x onerror=alert(1)>")
            submit()
        expect(page.locator("#all-done")).to_be_visible()
    answers = page.request.get(f"{api.url}/api/reviews.json").json()["answers"]
    said = {(each["gloss"], each["rating"], *each["flags"]) for each in answers}
    assert said == {("CALLE", "right", "movement"), ("¿Dónde vives?", "wrong", "movement")}
    page.goto(f"{address}/report")
    expect(page.locator("table")).to_contain_text("onerror")
    assert page.locator("main img").count() == 0  # what was typed stays text
    expect(page.locator("dl")).to_contain_text("50\u00a0%")
    accessible(page)
    photograph(page, pictures, "report")
    page.goto(f"{api.url}/#review")
    page.get_by_role("button", name="Pasar a la tabla de signos").click()
    expect(page.locator("#entered")).to_contain_text("CALLE: revisado por signantes", timeout=LONG)
    expect(page.locator("#entered")).to_contain_text("Signos valorados: 1. Cambios en la tabla: 1.")
    assert Lut.open(data_home / "teo" / "lut")["CALLE"].provenance.standing == "reviewed"


@pytest.mark.slow
def test_a_sign_is_found_by_its_word_and_handshape_and_a_text_says_what_to_record(
    api: Api, page: Page, pictures: Path
) -> None:
    page.goto(f"{api.url}/#dictionary")
    page.select_option("#search-kind", "number")
    numbers = [int(number) for number in page.locator(".words button").all_inner_texts()]
    assert numbers == sorted(numbers)
    page.select_option("#search-kind", "")
    expect(page.locator(".words button").first).to_have_text("0")
    page.select_option("#search-order", "use")
    expect(page.locator(".words button").first).to_have_text("YO")  # whoever speaks speaks of himself
    page.select_option("#search-order", "alphabet")
    page.select_option("#search-topic", "vehicle")
    page.fill("#search-word", "cóche")  # whatever the accents
    page.select_option("#search-hand", "A")
    expect(page.locator(".words button")).to_have_text(["COCHE"])
    page.select_option("#search-hand", "B")
    expect(page.locator(".words button")).to_have_count(0)
    page.select_option("#search-hand", "A")
    page.click(".words button")
    expect(page.locator("dl")).to_contain_text("DILSE")  # the page names the source
    page.fill("#coverage-text", "Tengo un coche y un tornillo.")
    page.click("form button[type=submit]")
    expect(page.locator("form ol a")).to_have_text(["TORNILLO"], timeout=LONG)
    accessible(page)
    photograph(page, pictures, "dictionary")
    page.click("form ol a")
    expect(page.locator("#teach-gloss")).to_have_value("TORNILLO")


@pytest.mark.slow
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


def test_at_200_percent_the_header_leaves_three_quarters_of_the_screen(api: Api, browser: Browser) -> None:
    page = browser.new_page(viewport={"width": 640, "height": 400}, locale="es-ES")
    page.goto(api.url)
    expect(page.locator("nav a")).to_have_count(5)
    assert page.locator("header").evaluate("header => header.offsetHeight") <= 100
    assert page.evaluate("document.documentElement.scrollWidth") <= 640
    page.close()


def test_at_1100_pixels_the_header_is_one_line_in_both_languages(api: Api, page: Page) -> None:
    page.goto(api.url)
    for watch in ("Ver", "Watch"):
        expect(page.locator("nav a").first).to_have_text(watch)
        boxes = page.locator("header > *").evaluate_all("parts => parts.map((part) => part.offsetTop)")
        tallest = page.locator("#stop").evaluate("button => button.offsetHeight")
        assert page.locator("header").evaluate("header => header.offsetHeight") < 2 * tallest, boxes
        page.click("#language")


def test_a_language_chosen_before_the_page_has_words_is_the_one_it_speaks(api: Api, page: Page) -> None:
    held: list[Route] = []
    page.route("**/i18n/es*.json", lambda route: held.append(route))
    page.goto(api.url)
    page.click("#language")
    expect(page.locator("nav a").first).to_have_text("Watch")
    assert len(held) == 2
    with page.expect_request_finished(lambda request: request.url.endswith("es.tabs.json")):
        for route in held:
            route.continue_()
    page.evaluate("new Promise(requestAnimationFrame)")
    expect(page.locator("html")).to_have_attribute("lang", "en")
    expect(page.locator("#language")).to_have_text("Español")
    page.reload()
    expect(page.locator("nav a").first).to_have_text("Watch")


def test_a_comprehension_test_is_taken_in_a_browser_tells_nothing_and_is_reported(
    api: Api, browser: Browser, pictures: Path
) -> None:
    words = ("CASA", *(f"PALABRA_{number}" for number in range(1, 15)))
    series = api.add_series("comprehension", "CASA", "PERRO", choices=words)
    context = browser.new_context(viewport={"width": 390, "height": 844}, locale="es-ES")
    context.grant_permissions(["clipboard-read", "clipboard-write"])
    page = context.new_page()
    try:
        page.goto(f"{api.url}/#review")
        page.get_by_role("button", name="Copiar el enlace").click()
        expect(page.locator("#notice")).to_have_text("Enlace copiado.")
        link = page.evaluate("navigator.clipboard.readText()")
        assert link == f"{api.url}/#review/{series}"
        # As over plain http from another machine, where a browser gives none.
        page.evaluate("Object.defineProperty(navigator, 'clipboard', { value: undefined })")
        page.get_by_role("button", name="Copiar el enlace").click()
        expect(page.locator("#notice")).to_have_text(link)
        page = context.new_page()  # whoever was sent the link opens it
        page.goto(link)
        page.fill("#reviewer", "Ana")
        page.keyboard.press("Enter")
        for number in (1, 2):
            expect(page.locator("h2")).to_have_text(f"Signo {number} de 2", timeout=LONG)
            if page.locator("[data-choice]").count():
                assert page.locator("[data-choice]").count() == 15
                page.screenshot(path=pictures / "choices_phone.png", full_page=True)
                page.click("[data-choice=CASA]")
            else:
                page.fill("#understood", "gato")
                page.keyboard.press("Enter")
            assert page.locator(".meaning").count() == 0
        expect(page.locator("#all-done")).to_be_visible(timeout=LONG)
        page.goto(f"{api.url}/#review/{series}/report")
        # One of two: Wilson's interval is (1 + z²/2 ± z √(1/2 + z²/4)) / (2 + z²) with z = 1.96.
        expect(page.locator("dl")).to_contain_text("50\u00a0% (9\u00a0%–91\u00a0%)", timeout=LONG)
        expect(page.locator("tr").filter(has_text="PERRO")).to_contain_text("gato ×1")
        assert page.evaluate("document.documentElement.scrollWidth") <= 390
        page.screenshot(path=pictures / "comprehension_report_phone.png", full_page=True)
    finally:
        context.close()


def listed(gloss: str, source: str) -> dict[str, object]:
    """A sign as /api/signs has it."""
    return {
        "gloss": gloss, "language": "ssp", "source": source, "licence": "Apache-2.0", "handedness": "both",
        "handshapes": [], "duration": 1.0, "standing": "described", "kind": "lexical", "topics": [],
    }  # fmt: skip


@contextmanager
def dictionary(folder: Path, browser: Browser) -> Iterator[Page]:
    """The tab Dictionary with three signs, of which the dictionary's are two; no robot.

    What the browser says is wrong fails the test.
    """

    async def signs(_: web.Request) -> web.Response:
        sources = {gloss: f'SignPuddle LSE dictionary, entry "{term}"' for gloss, term in TERMS.items()}
        return web.json_response([listed(*each) for each in {**sources, "CASA": "recorded"}.items()])

    async def refuse(asked: FromPage) -> Answer:
        return Answer(id=asked.id, success=False, code="no_executor")

    def app() -> web.Application:
        routes = [web.get("/api/signs", signs), *sign_writing_routes(folder)]
        access = Access.for_address("127.0.0.1", frozenset())
        return make_app(
            web_folder=WEB, access=access, hub=Hub(refuse), urdf=lambda: "<robot/>", routes=routes
        )

    thread = ServerThread(app, "127.0.0.1", 0)
    page = browser.new_page(viewport={"width": 390, "height": 844}, locale="en-GB")
    wrong: list[str] = []
    page.on("pageerror", lambda error: wrong.append(str(error)))
    page.on("console", lambda said: wrong.append(said.text) if said.type == "error" else None)
    try:
        page.goto(f"http://127.0.0.1:{thread.port}/#dictionary")
        yield page
    finally:
        page.close()
        thread.close()
    assert not wrong, wrong


@pytest.fixture
def drawings(tmp_path: Path) -> Path:
    """A folder of drawings, made from a dictionary."""
    (tmp_path / "dictionary.spml").write_text(SPML, "utf-8")
    found, missing = find_written(TERMS, read_dictionary(tmp_path / "dictionary.spml"))
    assert not missing
    pen = Pen()
    write_drawings(tmp_path / "signwriting", {entry: pen.draw(entry) for entry in found})
    return tmp_path / "signwriting"


def choose(page: Page, gloss: str) -> None:
    page.click(f"[data-gloss={gloss}]", timeout=LONG)
    expect(page.locator(".dictionary h2[tabindex]")).to_have_text(gloss, timeout=LONG)


def test_a_sign_is_shown_as_the_dictionary_writes_it(
    drawings: Path, browser: Browser, pictures: Path
) -> None:
    with dictionary(drawings, browser) as page:
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
        other = page.evaluate("import('/js/status.js').then((status) => status.refusalText('unheard_of'))")
        assert other == "It could not be done (reason: unheard_of): see what the nodes say."


def test_where_nothing_is_drawn_the_page_shows_nothing_and_nothing_is_wrong(
    tmp_path: Path, browser: Browser
) -> None:
    with dictionary(tmp_path / "nowhere", browser) as page:
        choose(page, "BANDEJA")
        expect(page.locator(".signwriting")).to_have_count(0)


def reasons(*patterns: str) -> set[str]:
    """Every stable reason that these sources give to an error of theirs, or to what they say of one."""
    return {code for each in patterns for path in SOURCES.glob(each) for code in reasons_in(path)}


@functools.cache
def reasons_in(path: Path) -> set[str]:
    text = path.read_text("utf-8")
    if "Error(" not in text and "code=" not in text:  # most: reading them as Python takes seconds
        return set()
    calls = [node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.Call)]
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
    "bad_robot", "bad_standing", "bad_style", "empty_speech", "model_not_installed",
    "mujoco_missing", "no_boards", "port_taken", "unknown_plant",
}  # fmt: skip


# Common words of one language that are none of the other's.
FOREIGN = {
    "es": r"\b(the|expected|could|not|is|of|it|too|there)\b",
    "en": r"\b(el|la|los|que|de|hay|es|un|una)\b",
}


@pytest.mark.parametrize("language", ["es", "en"])
def test_every_refusal_that_comes_to_the_page_says_in_its_language_why_and_what_to_do(language: str) -> None:
    codes = reasons(*TELLING) | {code for code, _ in BLOCKED.values()}
    assert {"moving", "limit_switch", "not_paused", "planner_lost", "driver_fault"} <= codes
    assert codes >= NOT_TOLD, NOT_TOLD - codes
    words: dict[str, str] = {}
    for name in (f"{language}.json", f"{language}.tabs.json"):
        words |= json.loads((WEB / "i18n" / name).read_text("utf-8"))
    told = {code: words.get(f"code.{code}", "") for code in codes - NOT_TOLD}
    assert not {code: text for code, text in told.items() if not re.fullmatch(r"[^:]+: [^:]+\.", text)}
    everywhere = reasons("teo_*/teo_*/**/*.py")
    assert len(everywhere) > 200
    said = {code: words.get(f"code.{code}", words["code.other"]) for code in everywhere}
    assert not {code: text for code, text in said.items() if not re.fullmatch(r".+[.!?)]", text)}
    assert not {code: text for code, text in said.items() if re.search(FOREIGN[language], text)}
    # What the tabs themselves refuse is said in words of its own, not by the reason's name.
    rooms = ("api/*", "jobs/*", "review/*", "server/app")
    own = reasons(*(f"teo_console/teo_console/{room}.py" for room in rooms))
    assert own
    assert not {code for code in own if said[code] == words["code.other"]}
