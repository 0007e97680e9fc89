# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Items are blind, and nothing that was said of them is lost."""

from __future__ import annotations

import csv
import io
import json
import sqlite3
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from teo_console.errors import ConsoleError
from teo_console.protocol import Motion
from teo_console.review.report import as_csv, as_json, report
from teo_console.review.series import CHOICES, NewItem, offered
from teo_console.review.store import ReviewStore

MOTION = Motion(joints=("FrontalRightElbow",), times=(0.0, 1.0), positions=((0.0,), (-1.0,)))


def item(meaning: str) -> NewItem:
    return NewItem(kind="sign", meaning=meaning, language="ssp", motion_hash="0" * 64, motion=MOTION)


def answer(store: ReviewStore, meaning: str, understood: str) -> None:
    """Enter a series of one item, and what somebody understood."""
    series = store.add_series("review", "one", [item(meaning)], seed=1)
    ana = store.reviewer("Ana")
    question = store.next_question(series, ana)
    assert question is not None
    store.answer(question.item, ana, understood)


@pytest.fixture
def store(tmp_path: Path) -> Iterator[ReviewStore]:
    opened = ReviewStore(tmp_path / "deep" / "reviews.sqlite")
    yield opened
    opened.close()


def code(call: Any, *arguments: Any) -> str:
    with pytest.raises(ConsoleError) as caught:
        call(*arguments)
    return caught.value.code


def test_names_of_items_and_their_order_tell_nothing_of_what_they_mean(store: ReviewStore) -> None:
    words = [f"W{number:02d}" for number in range(12)]
    series = store.add_series("review", "", [item(word) for word in words], seed=3)
    orders = []
    for name in ("Ana", "Luis"):
        reviewer, order = store.reviewer(name), []
        while (question := store.next_question(series, reviewer)) is not None:
            assert question.place == len(order) + 1
            order.append(store.answer(question.item, reviewer, ""))
            store.rate(question.item, reviewer, "right", [], "")
        orders.append(order)
    assert sorted(orders[0]) == sorted(orders[1]) == words
    assert orders[0] != orders[1]
    assert words not in orders


def test_choices_are_fifteen_the_right_one_and_those_most_like_it() -> None:
    near = ["CASA", "CALLE", "TECHO"]
    choices = offered("CASA", near, [f"W{number}" for number in range(40)], seed=5)
    assert len(choices) == len(set(choices)) == CHOICES
    assert set(near) <= set(choices)
    # The right one stands anywhere.
    places = {offered(f"W{n}", near, tuple("ABCDEFGHIJKLMNO"), seed=5).index(f"W{n}") for n in range(60)}
    assert len(places) > 8


@pytest.mark.parametrize(
    ("said", "recognised"),
    [("Por favor", True), ("POR_FAVOR", True), ("gracias", False), ("", False), ("favor", False)],
)
def test_recognised_is_who_says_the_gloss_whatever_the_accents(
    store: ReviewStore, said: str, recognised: bool
) -> None:
    answer(store, "POR_FAVOR", said)
    assert store.answers()[0].recognised == recognised


def test_a_name_is_one_person_however_it_is_typed(store: ReviewStore) -> None:
    assert store.reviewer("  José  Ruiz ") == store.reviewer("José Ruiz")
    assert store.reviewer("Ana") != store.reviewer("Eva")
    for bad in ("", "   ", "x" * 61, "a\x07b"):
        assert code(store.reviewer, bad) == "bad_name"


def test_what_was_said_outlives_the_program(tmp_path: Path) -> None:
    path = tmp_path / "reviews.sqlite"
    store = ReviewStore(path)
    answer(store, "CASA", "casa")
    store.close()
    store = ReviewStore(path)
    assert [said.understood for said in store.answers()] == ["casa"]
    assert [(one.title, one.items, one.reviewers) for one in store.series()] == [("one", 1, 1)]
    store.close()


def test_a_file_of_something_else_or_of_a_later_version_is_not_touched(tmp_path: Path) -> None:
    other = tmp_path / "letter.txt"
    other.write_text("Dear Ana, " * 100)
    assert code(ReviewStore, other) == "bad_reviews"
    assert other.read_text().startswith("Dear")
    later = tmp_path / "later.sqlite"
    with sqlite3.connect(later) as database:
        database.execute("PRAGMA user_version = 99")
    assert code(ReviewStore, later) == "bad_reviews"


def answer_all(
    store: ReviewStore, series: str, said: dict[str, dict[str, tuple[str, str, list[str]]]]
) -> None:
    """Each reviewer's answer, rating and flags by gloss, which is looked up beside the page."""
    meanings = dict(store._all("SELECT id, meaning FROM item"))
    for name, answers in said.items():
        reviewer = store.reviewer(name)
        while (question := store.next_question(series, reviewer)) is not None:
            understood, rating, flags = answers[meanings[question.item]]
            store.answer(question.item, reviewer, understood)
            store.rate(question.item, reviewer, rating, flags, "=cmd()" if flags else "")  # type: ignore[arg-type]


@pytest.fixture
def answered(store: ReviewStore) -> str:
    series = store.add_series("review", "", [item("CASA"), item("MADRE")], seed=1)
    answer_all(
        store,
        series,
        {
            "Ana": {"CASA": ("casa", "right", []), "MADRE": ("padre", "wrong", ["place"])},
            "Luis": {"CASA": ("Casa", "right", []), "MADRE": ("padre", "wrong", ["place", "palm"])},
            "Eva": {"CASA": ("techo", "understandable", []), "MADRE": ("", "wrong", [])},
        },
    )
    return series


def test_the_report_counts_what_was_understood_and_what_it_was_taken_for(
    store: ReviewStore, answered: str
) -> None:
    figures = report(store.meanings(answered), store.answers(answered))
    assert (figures.reviewers, figures.answers, figures.recognised_by_majority) == (3, 6, 1)
    assert figures.recognised is not None and figures.recognised.share == pytest.approx(2 / 6)
    casa, madre = figures.items
    assert (casa.meaning, casa.taken_for) == ("CASA", {"techo": 1})
    assert (madre.taken_for, madre.flags) == ({"padre": 2, "": 1}, {"place": 2, "palm": 1})
    assert casa.ratings == {"right": 2, "understandable": 1}
    # By hand, of 6 ratings 2 right, 1 understandable, 3 wrong: 2 coincidences differ, of 22 by chance.
    assert figures.agreement == pytest.approx(1 - 5 * 2 / 22)


@pytest.mark.usefixtures("answered")
def test_an_export_holds_all_that_was_said(store: ReviewStore) -> None:
    exported = json.loads(as_json(store.answers()))
    assert exported["format"] == "teo-review-1"
    of_luis = {row["gloss"]: row for row in exported["answers"] if row["reviewer"] == "Luis"}
    assert of_luis["CASA"]["recognised"] is True
    assert of_luis["CASA"]["motion_hash"] == "0" * 64
    assert of_luis["MADRE"]["flags"] == ["palm", "place"]
    assert of_luis["MADRE"]["comment"] == "=cmd()"
    rows = list(csv.DictReader(io.StringIO(as_csv(store.answers()).decode())))
    assert len(rows) == 6
    commented = next(row for row in rows if row["reviewer"] == "Luis" and row["gloss"] == "MADRE")
    assert (commented["comment"], commented["flags"]) == ("'=cmd()", "palm place")  # no formula


def test_a_series_is_entered_whole_or_not_at_all(store: ReviewStore) -> None:
    assert code(store.add_series, "review", "", [], 1) == "bad_series"
    assert code(store.add_series, "review", "", [item("CASA")] * 300, 1) == "bad_series"
    assert store.series() == []
