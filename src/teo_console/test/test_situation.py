# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The situation that pages share, from what the nodes say."""

from __future__ import annotations

from typing import Any

import pytest
from msgspec.structs import replace

from teo_common.diagnostics import Level
from teo_console.errors import ConsoleError
from teo_console.protocol import Caption, ExecutorState, Sentence, Situation
from teo_console.sentences import HISTORY, PathReport, SigningReport
from teo_console.situation import SharedSituation

HELLO = Caption(
    gloss="HOLA", kind="sign", origin="model", words=("Hola",), word_index=0, inflection="", confidence=0.9
)
SENTENCE = Sentence(
    utterance="u", index=0, count=2, text="Hola.", form="statement", negated=False, uncertain=False,
    dropped=("el",), captions=(HELLO,), state="waiting",
)  # fmt: skip
TIMED = replace(HELLO, start=1.0, duration=2.0)


def report(state: ExecutorState, index: int | None = 0, **fields: Any) -> SigningReport:
    known: dict[str, Any] = {
        "stamp": 100.0,
        "duration": 10.0,
        "captions": (TIMED,),
        "code": "",
        "message": "",
    }
    return SigningReport(state=state, key=None if index is None else ("u", index), **(known | fields))


def shown(situation: SharedSituation, now: float = 100.0) -> Situation:
    return situation.snapshot(now, pages=1)


def states(situation: SharedSituation, now: float) -> dict[str, str]:
    return {node.role: node.state for node in shown(situation, now).nodes}


@pytest.fixture
def situation() -> SharedSituation:
    """All three nodes there and heard at 100 s."""
    situation = SharedSituation()
    for role in ("translator", "executor", "driver"):
        situation.publishers(role, present=True)
    situation.diagnosis("translator: texts", Level.OK, "well", 100.0)
    situation.diagnosis("my_executor: sentences", Level.OK, "well", 100.0)
    situation.joints(100.0)
    return situation


def test_nodes_that_are_heard_live_whatever_they_are_called(situation: SharedSituation) -> None:
    assert set(states(SharedSituation(), 5.0).values()) == {"missing"}
    situation.diagnosis("camera: lens", Level.ERROR, "broken", 100.1)  # a stranger's
    assert set(states(situation, 100.3).values()) == {"alive"}
    situation.publishers("executor", present=False)  # it ended
    assert states(situation, 100.3)["executor"] == "missing"


def test_a_killed_driver_is_silent_within_a_second_and_the_others_within_three(
    situation: SharedSituation,
) -> None:
    assert states(situation, 101.0) == {"translator": "alive", "executor": "alive", "driver": "silent"}
    assert set(states(situation, 103.0).values()) == {"silent"}
    assert [node.quiet for node in shown(situation, 103.2).nodes] == [3.0, 3.0, 3.0]


def test_a_node_that_warns_is_unwell_and_says_why(situation: SharedSituation) -> None:
    situation.diagnosis("translator: texts", Level.WARN, "texts were refused", 100.1)
    node = shown(situation, 100.2).nodes[0]
    assert (node.state, node.message) == ("unwell", "texts were refused")


def test_a_sentence_is_announced_signed_and_history(situation: SharedSituation) -> None:
    situation.tokens(SENTENCE)
    assert shown(situation).current is None
    situation.executor(report("signing"))
    current = shown(situation).current
    assert current is not None
    assert (current.text, current.dropped, current.state, current.captions) == (
        "Hola.",
        ("el",),
        "signing",
        (TIMED,),
    )
    situation.executor(report("idle", None, captions=()))
    after = shown(situation)
    assert after.current is None
    assert after.progress is None
    assert [(past.text, past.state) for past in after.history] == [("Hola.", "signed")]


def test_a_refused_sentence_is_history_with_its_reason(situation: SharedSituation) -> None:
    situation.tokens(SENTENCE)
    situation.executor(report("signing"))
    situation.executor(report("refused", code="stopped", message="it was stopped"))
    now = shown(situation)
    assert now.current is None
    assert [(past.state, past.code, past.message) for past in now.history] == [
        ("refused", "stopped", "it was stopped")
    ]


def test_a_pause_keeps_the_sentence(situation: SharedSituation) -> None:
    situation.executor(report("signing"))
    situation.executor(report("paused", captions=()))
    current = shown(situation).current
    assert current is not None
    assert current.captions == (TIMED,)


def test_the_next_sentence_ends_the_one_before_in_a_history_that_is_bounded_the_newest_first(
    situation: SharedSituation,
) -> None:
    for index in range(HISTORY + 5):
        situation.tokens(replace(SENTENCE, index=index, text=f"{index}."))
        situation.executor(report("signing", index))
    now = shown(situation)
    assert now.current is not None
    assert now.current.text == f"{HISTORY + 4}."
    assert [past.text for past in now.history] == [f"{index}." for index in range(HISTORY + 3, 3, -1)]


def elapsed(situation: SharedSituation, now: float) -> float:
    progress = shown(situation, now).progress
    assert progress is not None
    return progress.elapsed + progress.speed * (now - progress.stamp)


def test_progress_follows_the_drivers_path_its_pace_and_its_pause(situation: SharedSituation) -> None:
    situation.executor(report("signing", stamp=100.0))  # a motion of 10 s
    situation.driver("moving", "", PathReport(stamp=102.0, speed=0.5, remaining=9.0))
    assert elapsed(situation, 102.0) == pytest.approx(1.0)
    assert elapsed(situation, 104.0) == pytest.approx(2.0)
    situation.driver("paused", "", PathReport(stamp=104.0, speed=0.0, remaining=8.0))
    assert elapsed(situation, 150.0) == pytest.approx(2.0)


# The next sentence's, and the arms' first rise while the sentence is planned.
@pytest.mark.parametrize("remaining", [30.0, 0.5])
def test_the_path_of_another_motion_is_not_the_sentences(
    situation: SharedSituation, remaining: float
) -> None:
    situation.executor(report("signing", stamp=100.0))
    situation.driver("moving", "", PathReport(stamp=101.0, speed=1.0, remaining=remaining))
    assert elapsed(situation, 101.5) == pytest.approx(1.5)


def test_what_is_heard_waits_until_one_page_takes_it(situation: SharedSituation) -> None:
    situation.spoken.hear("  buenos \n días ")
    (waiting,) = shown(situation).spoken
    assert waiting.text == "buenos días"
    assert situation.spoken.take(waiting.id) == waiting
    assert shown(situation).spoken == ()
    with pytest.raises(ConsoleError) as late:
        situation.spoken.take(waiting.id)
    assert late.value.code == "not_waiting"


@pytest.mark.parametrize(("text", "code"), [(" \n", "empty_speech"), ("a" * 2001, "speech_too_long")])
def test_speech_that_is_none_is_refused(situation: SharedSituation, text: str, code: str) -> None:
    with pytest.raises(ConsoleError) as refused:
        situation.spoken.hear(text)
    assert refused.value.code == code


def test_of_much_speech_the_latest_waits(situation: SharedSituation) -> None:
    for number in range(20):
        situation.spoken.hear(f"frase {number}")
    assert [spoken.text for spoken in shown(situation).spoken] == [f"frase {n}" for n in range(15, 20)]
