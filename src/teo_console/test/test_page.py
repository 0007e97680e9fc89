# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The page in a browser, before the real nodes: what a visitor sees and does."""

from __future__ import annotations

import json
import re
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
import rclpy
from numpy.typing import NDArray
from page_film import Film
from playwright.sync_api import Page, Route, expect
from rcl_interfaces.srv import SetParameters
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String
from teo_sign_msgs.msg import DriverState
from watched_page import (
    NOTE_LIT,
    PATIENCE,
    Poses,
    accessible,
    seen,
    seen_anew,
    sign,
    tab_to,
    wait_until_ready,
)

from teo_bringup.graph import Graph
from teo_sim_driver.motion.path_time import DEFAULT_STOP_DECELERATION, DEFAULT_STOP_JERK

WEB = Path(__file__).parents[1] / "web"
# [s] without a picture or a pose, in which an E, lit for 1.0 s, may be passed; a quiet machine has 0.3.
STARVED = 0.9
TABS = ("watch", "dictionary", "teach", "review", "practise")
NewPage = Callable[..., Page]
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)

STILLNESS = 1.5  # [s] for which a stopped robot is watched: nothing but time shows that it does not move

# The robot brakes for about a second, instead of a fifth of one.
SOFT_BRAKES = {"stop_deceleration": 2.0, "stop_jerk": 20.0}
USUAL_BRAKES = {"stop_deceleration": DEFAULT_STOP_DECELERATION, "stop_jerk": DEFAULT_STOP_JERK}

# Notes everything that the button *Re-arm* says.
NOTE_REARM = """
() => {
  window.rearm = [];
  const button = document.getElementById("rearm");
  new MutationObserver(() => window.rearm.push(button.textContent)).observe(button, { childList: true });
}
"""


@contextmanager
def node_in(domain: int) -> Iterator[Node]:
    """A node of the test's own, beside the console's."""
    context = Context()
    rclpy.init(context=context, domain_id=domain)
    node = Node("beside_the_console", context=context)
    try:
        yield node
    finally:
        node.destroy_node()
        rclpy.shutdown(context=context)


def set_driver(node: Node, **values: float) -> None:
    """Set parameters of the driver's."""
    client = node.create_client(SetParameters, "teo_sim_driver/set_parameters")
    assert client.wait_for_service(PATIENCE)
    parameters = [Parameter(name, value=value).to_parameter_msg() for name, value in values.items()]
    answered = client.call_async(SetParameters.Request(parameters=parameters))
    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    executor.spin_until_future_complete(answered, timeout_sec=PATIENCE)
    executor.shutdown()
    assert all(result.successful for result in answered.result().results), answered.result()


def when_stopped(node: Node) -> float:
    """When the driver, told to stop, says that the robot is at rest, by its clock [s]."""
    stamps: list[float] = []

    def hear(state: DriverState) -> None:
        if state.mode == DriverState.MODE_STOPPED and state.at_rest:
            stamps.append(state.header.stamp.sec + state.header.stamp.nanosec * 1e-9)

    node.create_subscription(DriverState, "driver_state", hear, LATCHED)
    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    deadline = time.monotonic() + PATIENCE
    while not stamps and time.monotonic() < deadline:
        executor.spin_once(timeout_sec=0.1)
    executor.shutdown()
    assert stamps, "the driver does not say that the stopped robot is at rest"
    return stamps[0]


def test_a_typed_sentence_is_signed_its_captions_in_order_while_the_joints_move(
    new_page: NewPage, pictures: Path, film: Film
) -> None:
    poses = Poses()
    page = new_page(poses=poses)
    wait_until_ready(page)
    page.wait_for_selector(".captions", state="attached")
    page.evaluate(NOTE_LIT)
    page.wait_for_selector(".stage .empty", state="hidden")
    with film.scene(page):
        sign(page, "¿Eres Eva?")
        expect(page.locator(".token.lit")).to_be_visible()
        page.evaluate("window.stood = 0")
        begin = time.time()
        expect(page.locator("#status")).to_have_text(re.compile(r"^Signando: ¿Eres Eva\?"))
        glosses = page.locator(".token").evaluate_all("items => items.map((item) => item.dataset.gloss)")
        assert glosses == ["TÚ", "E", "V", "A"]
        assert page.locator(".pill").all_inner_texts() == ["Pregunta: la cabeza se adelanta"]
        page.click('.token[data-gloss="V"] button')
        expect(page.locator(".explanation")).to_contain_text("«Eva» se deletrea")
        wait_until_ready(page)
    done = page.locator(".history li").filter(has_text="¿Eres Eva?")
    expect(done).to_have_count(1)
    expect(done).to_contain_text(" ".join(glosses))  # signed, not refused
    lit = page.evaluate("window.lit")
    assert lit == [gloss for gloss in glosses if gloss in lit]
    # On a starved machine the page may draw or hear nothing for longer than a letter takes.
    stood = max(page.evaluate("window.stood / 1000"), poses.longest_gap(begin, page.evaluate("window.until")))
    assert len(lit) > 1 if stood > STARVED else lit == glosses, (lit, stood)
    page.screenshot(path=pictures / "watch_desktop.png")  # a page without a graphics card stands for a second
    assert poses.farthest() > 0.5
    assert page.locator(".stage canvas").count() == 1


def test_stop_holds_the_robot_until_it_is_rearmed(
    new_page: NewPage, film: Film, module_domain_id: int
) -> None:
    poses = Poses()
    page = new_page(poses=poses)
    wait_until_ready(page)
    text = "Me llamo Ana."
    with film.scene(page):
        sign(page, text)
        expect(page.locator(".token.lit")).to_be_visible()
        page.click("#stop")
        expect(page.locator("#status")).to_have_text("Parado: no se mueve hasta rearmarlo.")
        expect(page.locator(".history li").filter(has_text=text)).to_contain_text("Se paró el robot")
        sign(page, "Adiós.")  # waits
        expect(page.locator("#queue-title ~ ol li")).to_have_text("Adiós.")
        # By the driver: a page's last pose may be from before the stop, and a starved driver brakes late.
        with node_in(module_domain_id) as operator:
            stopped = when_stopped(operator)
        poses.wait_until(page, stopped + STILLNESS)
        assert poses.farthest(since=stopped) == 0.0
        asked: list[str] = []
        page.once("dialog", lambda dialog: (asked.append(dialog.message), dialog.dismiss()))
        page.click("#rearm")  # would start what waits
        assert ["(1)" in question for question in asked] == [True]
        expect(page.locator("#status")).to_have_text("Parado: no se mueve hasta rearmarlo.")
        page.click("#clear")
        expect(page.locator("#queue-title ~ ol li")).to_have_count(0)
        page.click("#rearm")
        wait_until_ready(page)
        expect(page.locator("#stop")).to_be_focused()  # the button is disabled, and lost it


def test_a_robot_that_is_rearmed_while_it_brakes_is_armed_when_it_is_at_rest(
    new_page: NewPage, module_domain_id: int
) -> None:
    page = new_page()
    wait_until_ready(page)
    page.evaluate(NOTE_REARM)
    with node_in(module_domain_id) as operator:
        set_driver(operator, **SOFT_BRAKES)
        try:
            sign(page, "Gracias, Ana.")
            expect(page.locator(".token.lit")).to_be_visible()
            page.click("#stop")
            page.click("#rearm")
            expect(page.locator("#rearm")).to_have_attribute("aria-busy", "false")
            wait_until_ready(page)
        finally:
            set_driver(operator, **USUAL_BRAKES)
    assert "Rearmando…" in page.evaluate("window.rearm")
    expect(page.locator("#rearm")).to_have_text("Rearmar")
    expect(page.locator("#notice")).to_be_hidden()


@pytest.mark.slow
def test_two_pages_see_one_robot_and_closing_one_changes_nothing(new_page: NewPage) -> None:
    one, other = new_page(), new_page(width=390, height=844)
    wait_until_ready(one)
    # Over a minute: longer than two pages need for what follows on a loaded machine. The stop ends it.
    text = "Me llamo Bartolomé Maximiliano Wenceslao Nabucodonosor Hermenegildo."
    sign(one, text)
    expect(other.locator(".token.lit")).to_be_visible()
    assert other.evaluate("document.documentElement.scrollWidth") <= 390  # whatever is signed
    other.click("#pause")
    expect(one.locator("#status")).to_have_text("En pausa.")
    slide_speed(other, 50)
    expect(one.locator("output[for=speed]")).to_have_text("50 %")
    one.click("#pause")
    expect(other.locator("#status")).to_have_text(re.compile(f"^Signando: {text}"))
    other.close()
    expect(one.locator("#status")).to_have_text(re.compile(f"^Signando: {text}"))
    slide_speed(one, 100)
    expect(one.locator("output[for=speed]")).to_have_text("100 %")
    one.click("#stop")
    expect(one.locator(".history li").filter(has_text=text)).to_have_count(1)
    one.click("#rearm")
    wait_until_ready(one)


def slide_speed(page: Page, percent: int) -> None:
    page.locator("#speed").evaluate(
        """(slider, percent) => {
            slider.value = percent;
            for (const event of ["input", "change"]) slider.dispatchEvent(new Event(event));
        }""",
        percent,
    )


@pytest.mark.slow
def test_what_is_heard_on_speech_is_signed_only_when_it_is_confirmed(
    new_page: NewPage, module_domain_id: int
) -> None:
    page = new_page()
    wait_until_ready(page)
    with node_in(module_domain_id) as recogniser:
        speech = recogniser.create_publisher(String, "speech", 10)
        deadline = time.monotonic() + PATIENCE
        while not speech.get_subscription_count():
            assert time.monotonic() < deadline, "the console does not listen to `speech`"
            page.wait_for_timeout(20)
        speech.publish(String(data="<b>ola</b>"))
        speech.publish(String(data="no"))
        expect(page.locator(".spoken li")).to_have_count(2)
    page.locator(".spoken li").nth(1).get_by_role("button", name="Descartar").click()
    expect(page.locator(".spoken li")).to_have_count(1)
    assert page.input_value(".spoken input") == "<b>ola</b>"
    assert not [said for said in page.locator(".history li").all_inner_texts() if "<b>ola</b>" in said]
    page.fill(".spoken input", "Hola.")
    page.locator(".spoken").get_by_role("button", name="Signar").click()
    expect(page.locator(".token.lit")).to_be_visible()
    expect(page.locator(".spoken li")).to_have_count(0)
    wait_until_ready(page)


def test_what_the_browser_recognises_is_shown_before_it_is_signed(new_page: NewPage) -> None:
    page = new_page(
        script="""
        window.SpeechRecognition = class extends EventTarget {
          start() {
            const results = [[{ transcript: "buenos días" }]];
            this.dispatchEvent(Object.assign(new Event("result"), { results }));
            this.dispatchEvent(new Event("end"));
          }
        };"""
    )
    wait_until_ready(page)
    page.get_by_role("button", name="Hablar").click()
    expect(page.locator("#text")).to_have_value("buenos días")
    expect(page.locator("#status")).to_have_text(re.compile("^Listo"))


def test_typed_markup_stays_text(new_page: NewPage) -> None:
    page = new_page()
    wait_until_ready(page)
    sign(page, "<img src=x onerror=alert(1)>你好")  # no letters of the alphabet: refused
    expect(page.locator(".history li").first).to_contain_text("<img src=x onerror=alert(1)>")
    assert page.locator("main img").count() == 0


@pytest.mark.slow
def test_every_tab_says_everything_in_both_languages_and_bars_nobody(
    new_page: NewPage, pictures: Path
) -> None:
    page = new_page(width=390, height=844)
    wait_until_ready(page)
    page.wait_for_selector(".stage .empty", state="hidden")
    page.screenshot(path=pictures / "watch_phone.png", full_page=True)
    keys = set(json.loads((WEB / "i18n" / "en.json").read_text(encoding="utf-8")))
    for language, word in (("en", "Watch"), ("es", "Ver")):
        page.click("#language")
        expect(page.locator("html")).to_have_attribute("lang", language)
        for tab in TABS:
            page.goto(f"{page.url.partition('#')[0]}#{tab}")
            expect(page.locator("#content")).to_have_attribute("data-tab", tab)
            shown = set(re.findall(r"[a-z_0-9]+(?:\.[a-z_0-9]+)+", page.inner_text("body")))
            assert not shown & {key for key in keys if "." in key}
            if language == "en":
                for scheme in ("light", "dark"):
                    page.emulate_media(color_scheme=scheme)  # type: ignore[arg-type]
                    accessible(page)
        page.reload()
        expect(page.locator("nav a").first).to_have_text(word)
    # No part of the page is wider than a telephone.
    assert page.evaluate("document.documentElement.scrollWidth") <= 390


def words_of(language: str) -> dict[str, str]:
    """Words by their keys, of which none is there twice."""
    pairs: list[tuple[str, str]] = []
    for name in (f"{language}.json", f"{language}.tabs.json"):
        pairs += json.loads((WEB / "i18n" / name).read_text("utf-8"), object_pairs_hook=list)
    assert len(dict(pairs)) == len(pairs)
    return dict(pairs)


def test_the_languages_have_the_same_words_and_all_that_the_page_asks_for() -> None:
    spanish, english = words_of("es"), words_of("en")
    assert spanish.keys() == english.keys()
    for key, words in spanish.items():
        assert sorted(re.findall(r"\{\w+\}", words)) == sorted(re.findall(r"\{\w+\}", english[key])), key
    scripts = [path.read_text("utf-8") for path in WEB.glob("js/**/*.js")]
    asked = {key for script in scripts for key in re.findall(r'\bt\("([\w.]+)"', script)}
    assert len(asked) > 150
    assert asked <= spanish.keys(), asked - spanish.keys()


@pytest.mark.slow
def test_a_sentence_is_signed_stopped_and_the_tabs_are_seen_by_keyboard_alone(new_page: NewPage) -> None:
    page = new_page()
    wait_until_ready(page)
    tab_to(page, "language")
    expect(page.locator("html")).to_have_attribute("lang", "en")
    page.wait_for_selector("#mirror")
    for tab, name in zip(
        (*TABS[1:], TABS[0]), ("Dictionary", "Teach", "Review", "Practise", "Watch"), strict=True
    ):
        tab_to(page, name)
        expect(page.locator("nav a[aria-current]")).to_have_text(name)
        expect(page.locator("#content")).to_have_attribute("data-tab", tab)
    page.wait_for_selector("#mirror")  # beside the robot, which comes last
    tab_to(page, "text")
    page.keyboard.type("Adiós, Bartolomé.")
    page.keyboard.press("Enter")
    expect(page.locator(".token.lit")).to_be_visible()
    for control in ("pause", "mirror", "stop"):
        tab_to(page, control)
    expect(page.locator("#status")).to_have_text("Stopped: it stays still until re-armed.")
    expect(page.locator("#rearm")).to_be_enabled()
    tab_to(page, "rearm")
    wait_until_ready(page)


# How many pixels of the robot are there when the picture has got another size, before anything else is drawn.
DRAWN_IN_ANOTHER_SIZE = """async () => {
  const stage = document.querySelector(".stage");
  stage.style.height = "300px";
  await new Promise((resized) => new ResizeObserver(resized).observe(stage));
  const { width, height } = stage.getBoundingClientRect();
  const copy = new OffscreenCanvas(width, height).getContext("2d");
  copy.drawImage(stage.querySelector("canvas"), 0, 0, width, height);
  stage.style.height = "";
  const { data } = copy.getImageData(0, 0, width, height);
  return data.filter((value, place) => place % 4 === 3 && value > 200).length;
}"""


@pytest.mark.slow
def test_the_robot_is_seen_from_three_places_as_in_a_mirror_and_slower(new_page: NewPage) -> None:
    page = new_page()
    wait_until_ready(page)
    page.wait_for_selector(".stage canvas")  # else there is nothing yet that could be hidden
    page.wait_for_selector(".stage .empty", state="hidden")
    assert page.evaluate(DRAWN_IN_ANOTHER_SIZE) > 1000
    drawn: list[NDArray[np.int16]] = []
    for camera in ("front", "signer", "hand"):
        page.click(f"[data-camera={camera}]")
        expect(page.locator("[data-camera][aria-pressed=true]")).to_have_attribute("data-camera", camera)
        drawn.append(seen_anew(page, drawn))
    page.click("[data-camera=front]")
    expect(page.locator(".inset")).to_be_visible()  # the hand, beside the whole
    drawn = [seen_anew(page, drawn[1:])]
    page.focus(".stage canvas")
    for _ in range(4):
        page.keyboard.press("ArrowLeft")
    drawn.append(seen_anew(page, drawn))
    page.click("[data-camera=hand]")
    drawn.append(seen_anew(page, drawn))
    page.click("#mirror")
    mirrored = seen(page)
    page.click("#mirror")
    assert np.abs(mirrored[:, ::-1] - drawn[-1]).mean() < 0.2 * np.abs(mirrored - drawn[-1]).mean()
    page.select_option("#rate", "0.25")
    sign(page, "Hola.")
    behind = page.get_by_role("button", name="Volver al directo")
    expect(behind).to_be_visible()
    behind.click()
    expect(behind).to_be_hidden()
    wait_until_ready(page)
    expect(behind).to_be_hidden()  # what was seen late is over as well


def test_what_did_not_come_while_the_node_was_gone_is_asked_for_again(new_page: NewPage) -> None:
    page = new_page()
    lost: list[Route] = []

    def lose_the_first(route: Route) -> None:
        lost.append(route)
        route.abort("connectionrefused") if len(lost) == 1 else route.continue_()

    page.route("**/robot_view.js*", lose_the_first)
    page.reload()
    expect(page.locator(".stage canvas")).to_be_visible()
    assert len(lost) == 2


@pytest.mark.slow
def test_the_sign_language_is_chosen_while_the_nodes_run_and_every_page_speaks_of_it(
    new_page: NewPage,
) -> None:
    page, other = new_page(), new_page(tab="teach")
    wait_until_ready(page)
    page.focus("#sign-language")
    page.select_option("#sign-language", "ase")
    for each in (page, other):
        expect(each.locator(".brand")).to_have_text("TEO signa en ASL")
    expect(page.locator("#sign-language")).to_be_focused()  # the page was said anew
    sign(page, "My name is Eva.")
    expect(page.locator(".token.lit")).to_be_visible()
    glosses = page.locator(".token").evaluate_all("items => items.map((item) => item.dataset.gloss)")
    assert glosses == ["MY", "NAME", "E", "V", "A"]
    page.select_option("#sign-language", "ssp")
    expect(other.locator(".brand")).to_have_text("TEO signa en LSE")
    wait_until_ready(page)


@pytest.mark.slow
def test_a_node_that_dies_is_named_at_once(new_page: NewPage, graph: Graph) -> None:
    page = new_page()
    wait_until_ready(page)
    graph.stop("translator")
    expect(page.locator("#status")).to_have_text("El traductor no está en marcha.", timeout=5000)
    sign(page, "Hola.")
    expect(page.locator("#notice")).to_have_text("Nadie traduce: pon en marcha el traductor.")
    graph.stop("console")
    expect(page.locator("#status")).to_have_text("La consola no responde. ¿Sigue en marcha?", timeout=10000)
