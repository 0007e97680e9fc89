# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import made_languages
import pytest
import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import HistoryPolicy, QoSProfile
from std_msgs.msg import String
from teo_sign_msgs.msg import SignSentence, SignToken, TranslationStatus
from teo_sign_msgs.srv import ListSigns, Translate

from teo_sign_translator.node.translator_node import TranslatorNode

PATIENCE = 60.0  # [s] that anything may take on a busy machine: 2,000 texts take 3 s on an idle one


class Bench:
    """A translator and somebody who types and listens."""

    def __init__(self, domain_id: int, *overrides: Parameter) -> None:
        self.context = Context()
        rclpy.init(context=self.context, domain_id=domain_id)
        self.node = TranslatorNode(
            context=self.context, parameter_overrides=[Parameter("model", value="lstm256"), *overrides]
        )
        assert self.node.start()
        self.person = Node("person", context=self.context)
        self.received: list[SignSentence] = []
        self.outcomes: list[TranslationStatus] = []
        self.texts = self.person.create_publisher(
            String, "text", QoSProfile(history=HistoryPolicy.KEEP_ALL, depth=0)
        )
        self.person.create_subscription(
            TranslationStatus, "translation_status", self.outcomes.append, QoSProfile(depth=5000)
        )
        self.person.create_subscription(
            SignSentence, "sign_tokens", self.received.append, QoSProfile(depth=200)
        )
        self.client = self.person.create_client(Translate, "translate")
        self.manager = self.person.create_client(ChangeState, "translator/change_state")
        self.executor = SingleThreadedExecutor(context=self.context)
        for node in (self.node, self.person):
            self.executor.add_node(node)
        self.wait(lambda: self.texts.get_subscription_count() == 1, "the text topic")
        self.wait(lambda: self.person.count_publishers("sign_tokens") == 1, "the sign_tokens topic")
        self.wait(lambda: self.person.count_publishers("translation_status") == 1, "the outcomes")

    def wait(self, done: Callable[[], bool], what: str) -> None:
        end = time.monotonic() + PATIENCE
        while not done():
            assert time.monotonic() < end, f"waited in vain for {what}"
            self.executor.spin_once(timeout_sec=0.1)

    def type(self, *texts: str) -> None:
        for text in texts:
            self.texts.publish(String(data=text))

    def wait_for(self, count: int) -> list[SignSentence]:
        self.wait(lambda: len(self.received) >= count, f"{count} sentences, got {len(self.received)}")
        return self.received

    def ask(self, text: str) -> Translate.Response:
        self.wait(self.client.service_is_ready, "the translate service")
        future = self.client.call_async(Translate.Request(text=text))
        self.wait(future.done, "an answer")
        return future.result()

    def change(self, transition: int) -> None:
        request = ChangeState.Request()
        request.transition.id = transition
        self.wait(self.manager.service_is_ready, "the change_state service")
        future = self.manager.call_async(request)
        self.wait(future.done, "the transition")
        assert future.result().success

    def close(self) -> None:
        self.executor.shutdown()
        self.person.destroy_node()
        self.node.destroy_node()
        rclpy.shutdown(context=self.context)


@pytest.fixture
def bench(domain_id: int) -> Iterator[Bench]:
    bench = Bench(domain_id)
    yield bench
    bench.close()


def test_a_text_becomes_sentences_of_tokens(bench: Bench) -> None:
    before = bench.node.get_clock().now().nanoseconds
    bench.type("Hola, me llamo Ana. ¿Qué tal?")
    first, second = bench.wait_for(2)
    assert [token.gloss for token in first.tokens] == ["HOLA", "", "MI", "NOMBRE", "A", "N", "A"]
    word, pause, letter = SignToken.KIND_LEXICAL, SignToken.KIND_PAUSE, SignToken.KIND_LETTER
    assert [token.kind for token in first.tokens] == [word, pause, word, word, letter, letter, letter]
    assert list(first.tokens[4].source_words) == ["Ana"]
    assert [token.gloss for token in second.tokens] == ["TÚ", "BIEN"]
    assert (first.type, second.type) == (SignSentence.TYPE_STATEMENT, SignSentence.TYPE_WH_QUESTION)
    assert (first.text, second.text) == ("Hola, me llamo Ana.", "¿Qué tal?")
    assert first.utterance_id == second.utterance_id != ""
    assert [(s.sentence_index, s.sentence_count) for s in (first, second)] == [(0, 2), (1, 2)]
    stamp = first.header.stamp.sec * 10**9 + first.header.stamp.nanosec
    assert before <= stamp <= bench.node.get_clock().now().nanoseconds
    assert first.header.frame_id == ""


def test_a_fault_with_one_text_does_not_stop_the_next(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    translate = bench.node._translator.translate

    def faulty(text: str, signs: object) -> object:
        if text == "fault":
            raise ZeroDivisionError
        return translate(text, signs)

    monkeypatch.setattr(bench.node._translator, "translate", faulty)
    assert bench.ask("fault").code == "internal_error"
    bench.type("fault", "Hola")
    (sentence,) = bench.wait_for(1)
    assert [token.gloss for token in sentence.tokens] == ["HOLA"]


def test_the_service_translates_without_publishing_or_says_why_it_refuses(bench: Bench) -> None:
    response = bench.ask("Me llamo Ana")
    assert response.success
    assert response.code == response.message == ""
    assert [token.gloss for token in response.sentences[0].tokens] == ["MI", "NOMBRE", "A", "N", "A"]
    refused = bench.ask("Hola. " * 101)
    assert (refused.success, refused.code, list(refused.sentences)) == (False, "too_many_sentences", [])
    assert refused.message
    bench.type("Hola")
    assert [sentence.text for sentence in bench.wait_for(1)] == ["Hola"]


def test_values_out_of_range_are_refused_with_what_there_is(bench: Bench) -> None:
    for name, value, said in (
        ("model", "gpt", "lstm256"),
        ("max_sentences", 101, ""),
        ("substitutes", "all", "paraphrase"),
        ("signs_file", "/nowhere", "/nowhere"),
        ("autostart", False, ""),
    ):
        (refused,) = bench.node.set_parameters([Parameter(name, value=value)])
        assert not refused.successful, name
        assert refused.reason and said in refused.reason


def test_parameters_take_effect(bench: Bench, tmp_path: Path) -> None:
    def accept(name: str, value: object) -> None:
        (result,) = bench.node.set_parameters([Parameter(name, value=value)])
        assert result.successful

    assert bench.ask("¿Qué tal?").sentences[0].tokens[1].gloss == "BIEN"
    accept("max_sentences", 1)
    assert bench.ask("Hola. Adiós.").code == "too_many_sentences"
    assert not bench.ask("¿Qué tal?").sentences[0].uncertain
    (guess,) = bench.ask("zzz qqq").sentences
    assert guess.uncertain
    assert guess.confidence < 0.7  # nobody knows what it says
    accept("min_confidence", 0.0)
    assert not bench.ask("zzz qqq").sentences[0].uncertain
    path = tmp_path / "signs.txt"
    path.write_text("# known\nhola\nchao\n", encoding="utf-8")
    accept("signs_file", str(path))
    assert [token.gloss for token in bench.ask("Hola").sentences[0].tokens] == ["HOLA"]
    assert [token.gloss for token in bench.ask("Adiós").sentences[0].tokens] == ["CHAO"]
    accept("substitutes", "none")
    assert [token.gloss for token in bench.ask("Adiós").sentences[0].tokens] == list("ADIOS")
    accept("signs_file", "")
    assert len(bench.ask("Adiós").sentences[0].tokens) == 1
    accept("model", "lstm256")
    assert bench.ask("¿Qué tal?").success


def held_translations(bench: Bench) -> tuple[threading.Event, threading.Event]:
    """Let every translation wait: events that tell when the first has begun, and that let all go on."""
    begun, held, translate = threading.Event(), threading.Event(), bench.node._translator.translate

    def slow(text: str, signs: object) -> object:
        begun.set()
        assert held.wait(PATIENCE)
        return translate(text, signs)

    bench.node._translator.translate = slow
    return begun, held


def test_what_became_of_every_text_is_told(bench: Bench) -> None:
    told = {
        "Hola": ("", 1),
        "": ("empty_text", 0),
        "😀": ("nothing_to_sign", 0),
        "\x00": ("empty_text", 0),
        "a" * 30_000: ("text_too_long", 0),
        "Hola. " * 200: ("too_many_sentences", 0),
        "мир": ("unsignable_text", 0),
        "Hola. ¿Qué tal?": ("", 2),
    }
    bench.type(*told)
    bench.wait(lambda: len(bench.outcomes) == len(told), "an outcome of each text")
    assert [(each.code, each.sentence_count) for each in bench.outcomes] == list(told.values())
    assert all(
        text.startswith(each.text.removesuffix("…")) for text, each in zip(told, bench.outcomes, strict=True)
    )
    assert all(bool(outcome.message) == bool(outcome.code) for outcome in bench.outcomes)
    ids = [outcome.utterance_id for outcome in bench.outcomes]
    assert len(set(ids)) == len(told)
    assert [sentence.utterance_id for sentence in bench.wait_for(3)] == [ids[0], ids[-1], ids[-1]]


def test_of_a_flood_of_texts_none_is_lost_without_a_word(bench: Bench) -> None:
    begun, held = held_translations(bench)
    texts = [f"Yo tengo {age} años" for age in range(2000)]
    bench.type(texts[0])
    bench.wait(begun.is_set, "the first text to be worked on")
    bench.type(*texts[1:])
    waiting = 100  # the default of queue_size
    bench.wait(
        lambda: len(bench.outcomes) == len(texts) - waiting - 1, "all but those that wait to be refused"
    )
    assert {outcome.code for outcome in bench.outcomes} == {"queue_full"}
    held.set()
    bench.wait(lambda: len(bench.outcomes) == len(texts), "the others")
    assert {outcome.text for outcome in bench.outcomes} == set(texts)
    assert (bench.node._statistics.done, bench.node._statistics.refused) == (
        waiting + 1,
        len(texts) - waiting - 1,
    )
    ages = [sentence.tokens[2].gloss for sentence in bench.wait_for(waiting + 1)]
    assert ages == [str(age) for age in range(waiting + 1)]


def test_a_manager_can_stop_start_and_shut_down_the_node(bench: Bench) -> None:
    bench.change(Transition.TRANSITION_DEACTIVATE)
    bench.wait(lambda: bench.texts.get_subscription_count() == 0, "the text topic to go")
    assert bench.ask("Hola").success
    bench.change(Transition.TRANSITION_CLEANUP)
    bench.wait(lambda: not bench.client.service_is_ready(), "the service to go")
    bench.change(Transition.TRANSITION_CONFIGURE)
    bench.change(Transition.TRANSITION_ACTIVATE)
    bench.wait(lambda: bench.texts.get_subscription_count() == 1, "the text topic")
    bench.wait(lambda: bench.person.count_publishers("sign_tokens") == 1, "the sign_tokens topic")
    bench.type("Hola")
    assert [token.gloss for token in bench.wait_for(1)[0].tokens] == ["HOLA"]
    bench.change(Transition.TRANSITION_ACTIVE_SHUTDOWN)
    bench.wait(lambda: bench.texts.get_subscription_count() == 0, "the text topic to go")
    bench.wait(lambda: not bench.client.service_is_ready(), "the service to go")


def test_texts_that_wait_when_the_node_is_deactivated_are_refused(bench: Bench) -> None:
    begun, held = held_translations(bench)
    bench.type("Hola", "Adiós")
    bench.wait(lambda: begun.is_set() and bench.node._worker.waiting == 1, "the second text to wait")
    threading.Timer(0.2, held.set).start()
    bench.change(Transition.TRANSITION_DEACTIVATE)
    assert bench.wait_for(1)[0].text == "Hola"
    assert (bench.node._statistics.done, bench.node._statistics.refused) == (1, 1)
    assert "not_active" in bench.node._statistics.last_refusal


def test_diagnostics_say_what_was_done_and_refused(bench: Bench) -> None:
    seen: list[DiagnosticArray] = []
    bench.person.create_subscription(DiagnosticArray, "diagnostics", seen.append, 10)
    bench.type("Hola", "Привет", "¿Qué tal?")
    bench.wait_for(2)

    def values() -> dict[str, str]:
        return {pair.key: pair.value for pair in seen[-1].status[0].values} if seen else {}

    bench.wait(lambda: values().get("texts done") == "2", "diagnostics of two texts")
    assert seen[-1].status[0].name == "translator: texts"
    assert values()["model"] == "lstm256"
    assert values()["state"] == "active"
    assert values()["texts refused"] == "1"
    assert values()["texts waiting"] == "0"
    assert values()["last refusal"].startswith("[unsignable_text]")
    assert 0 < float(values()["latency median [ms]"]) <= float(values()["latency p99 [ms]"])


def test_the_executors_signs_are_used_as_they_change(bench: Bench) -> None:
    glosses = ["A", "HOLA"]

    def list_signs(_: ListSigns.Request, response: ListSigns.Response) -> ListSigns.Response:
        response.language = "ssp"
        response.glosses = glosses
        response.kinds = [SignToken.KIND_LETTER] + [SignToken.KIND_LEXICAL] * (len(glosses) - 1)
        return response

    bench.person.create_service(ListSigns, "list_signs", list_signs)
    bench.wait(lambda: bench.node._inventory.signs("ssp") == {"HOLA"}, "the signs")
    bench.type("Hola", "Adiós")
    first, second = bench.wait_for(2)
    assert [token.kind for token in first.tokens] == [SignToken.KIND_LEXICAL]
    assert [token.gloss for token in second.tokens] == list("ADIOS")
    assert {token.origin for token in second.tokens} == {SignToken.ORIGIN_SPELLED}
    glosses.append("CHAO")
    bench.wait(lambda: "CHAO" in (bench.node._inventory.signs("ssp") or ()), "the new sign")
    (token,) = bench.ask("Adiós").sentences[0].tokens
    assert (token.gloss, token.origin) == ("CHAO", SignToken.ORIGIN_SYNONYM)


def test_a_node_with_an_unknown_model_cannot_be_configured(domain_id: int) -> None:
    context = Context()
    rclpy.init(context=context, domain_id=domain_id)
    node = TranslatorNode(context=context, parameter_overrides=[Parameter("model", value="gpt")])
    assert not node.start()
    node.destroy_node()
    rclpy.shutdown(context=context)


def test_a_language_is_changed_while_texts_wait_and_each_stays_in_its_own(
    bench: Bench, data_home: Path
) -> None:
    folder = made_languages.make_language(data_home)
    worker = bench.node._worker
    assert worker is not None
    with bench.node._translating:
        bench.type("Hola", "¿Qué tal?")
        bench.wait(lambda: worker.waiting > 0, "a text that came")
        (result,) = bench.node.set_parameters([Parameter("language", value=folder.name)])
        assert result.successful
    bench.type("Hola")
    first, _, last = bench.wait_for(3)
    assert (first.language, last.language) == ("ssp", folder.name)
    bench.wait(lambda: len(bench.outcomes) == 3, "the outcomes")
    assert bench.outcomes[-1].language == folder.name


def test_an_unknown_or_broken_language_is_refused_and_the_one_before_serves_on(
    bench: Bench, data_home: Path
) -> None:
    file = made_languages.make_language(data_home) / "language.yaml"
    file.write_text(file.read_text("utf-8").replace("spoken:", "talked:"), "utf-8")
    for code, reason in (("qqq", "unknown_language"), (made_languages.CODE, "invalid_language")):
        (result,) = bench.node.set_parameters([Parameter("language", value=code)])
        assert not result.successful
        assert result.reason.startswith(f"[{reason}]")
    assert bench.ask("Hola").sentences[0].language == "ssp"
