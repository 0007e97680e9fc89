# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""/api against what is sent to it: reviews stay blind, hostile uploads are refused, nothing is kept."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from console_api import Api
from msgspec.structs import replace

from teo_console.api.dictionary import topics_of, uses_of
from teo_console.jobs.commands import Commands
from teo_sign_languages import load_language

BAG = b"\x89MCAP0\r\n" + bytes(1000)


@pytest.fixture
def api(tmp_path: Path) -> Iterator[Api]:
    opened = Api(tmp_path)
    yield opened
    opened.thread.close()


def recordings(api: Api) -> list[Path]:
    """What lies in the folder of recordings."""
    return [path for path in api.folders.cache.glob("recordings-*/*") if path.is_dir()]


def test_a_reviewer_says_what_it_was_before_reading_it_once_and_the_export_has_it(api: Api) -> None:
    series = api.add_series("review", "CASA")

    def next_question() -> Any:
        return api.ask("POST", f"/api/series/{series}/next", {"reviewer": "Ana"})

    status, asked = next_question()
    assert status == 200
    assert "CASA" not in json.dumps(asked)
    item = f"/api/items/{asked['question']['item']}"
    rating = {"reviewer": "Ana", "rating": "wrong", "flags": ["palm"], "comment": "<b>bien</b>"}
    status, refused = api.ask("POST", f"{item}/rating", rating)
    assert (status, refused["code"]) == (409, "not_answered")
    answer = {"reviewer": "Ana", "understood": "casa"}
    assert api.ask("POST", f"{item}/answer", answer) == (200, {"meaning": "CASA"})
    status, refused = api.ask("POST", f"{item}/answer", answer)
    assert (status, refused["code"]) == (409, "answered")
    # Until it is rated it stays, also for who opens the page anew.
    again = next_question()[1]["question"]
    assert again == asked["question"] | {"understood": "casa", "meaning": "CASA"}
    for thought in (rating, rating | {"rating": "right"}):
        assert api.ask("POST", f"{item}/rating", thought)[0] == 200
    assert next_question() == (200, {"question": None})
    _, exported = api.ask("GET", "/api/reviews.json")
    (said,) = exported["answers"]
    assert (said["reviewer"], said["rating"], said["recognised"]) == ("Ana", "right", True)
    _, figures = api.ask("GET", f"/api/series/{series}/report")
    assert figures["recognised"][0] == 1.0
    assert len(figures["anchors"]) == 3


def test_a_comprehension_test_takes_one_of_its_choices_and_tells_nothing(api: Api) -> None:
    series = api.add_series("comprehension", "CASA", choices=("CASA", "CALLE"))
    _, asked = api.ask("POST", f"/api/series/{series}/next", {"reviewer": "Ana"})
    path = f"/api/items/{asked['question']['item']}/answer"
    status, refused = api.ask("POST", path, {"reviewer": "Ana", "understood": "none of these"})
    assert (status, refused["code"]) == (400, "bad_answer")
    assert api.ask("POST", path, {"reviewer": "Ana", "understood": "CALLE"}) == (200, {"meaning": None})


def test_what_was_said_of_another_language_or_robot_is_kept_apart(api: Api) -> None:
    series = api.add_series("review", "CASA")
    for other in (Commands(robot="teo", language="ase"), Commands(robot="gr1t2", language="ssp")):
        api.use(other)
        assert api.ask("GET", "/api/series") == (200, [])
        assert api.ask("GET", f"/api/series/{series}/report")[0] == 404
    api.use(Commands(robot="teo", language="ssp"))
    assert [each["id"] for each in api.ask("GET", "/api/series")[1]] == [series]


@pytest.mark.parametrize(
    ("method", "path", "body", "status", "code"),
    [
        ("POST", "/api/coverage", b"{", 400, "malformed"),
        ("POST", "/api/coverage", {"text": ""}, 400, "malformed"),
        ("POST", "/api/coverage", {"text": "x" * 5001}, 400, "malformed"),
        ("POST", "/api/coverage", {"text": "a", "more": 1}, 400, "malformed"),
        ("POST", "/api/coverage", b"[" * 20_000, 400, "malformed"),
        ("POST", "/api/series", {"kind": "party"}, 400, "malformed"),
        ("POST", "/api/series", {"kind": "review", "count": 1000}, 400, "malformed"),
        ("POST", "/api/series/nowhere/next", {"reviewer": "Ana"}, 404, "unknown_series"),
        ("GET", "/api/series/nowhere/report", None, 404, "unknown_series"),
        ("POST", "/api/items/x/answer", {"reviewer": "\x00", "understood": ""}, 400, "bad_name"),
        ("POST", "/api/items/x/answer", {"reviewer": "Ana", "understood": ""}, 404, "unknown_item"),
        ("GET", "/api/jobs/nobody", None, 404, "unknown_job"),
        ("DELETE", "/api/jobs/nobody", None, 404, "unknown_job"),
        ("GET", "/api/films/..%2F..%2Freviews.sqlite", None, 404, "unknown_sign"),
        ("POST", "/api/recordings/nobody/try", {"gloss": "A"}, 404, "unknown_recording"),
        ("GET", "/api/recordings/..%2Fkept/trial", None, 404, "unknown_recording"),
        ("POST", "/api/recordings", b"<script>alert(1)</script>" * 9, 400, "bad_film"),
        ("POST", "/api/recordings", b"", 400, "bad_film"),
    ],
)
def test_what_makes_no_sense_is_refused_with_a_reason(
    api: Api, method: str, path: str, body: Any, status: int, code: str
) -> None:
    got, answer = api.ask(method, path, body)
    assert (got, answer["code"]) == (status, code)
    assert recordings(api) == []


def test_words_are_found_by_what_they_are_about() -> None:
    topics = topics_of(load_language("ssp"))
    assert "family" in topics["MADRE"]
    assert topics["ROJO"][0] == "colour"


def test_signs_are_counted_in_the_sentences_that_people_would_say(tmp_path: Path) -> None:
    uses = uses_of(load_language("ssp"))
    assert uses["CASA"] > uses["TORNILLO"]
    text = (load_language("ssp").text / "written_pairs.tsv").read_text("utf-8")
    assert uses["ABUELA"] == len(re.findall(r"[\t/]ABUELA\(", text)) > 10
    (tmp_path / "text").mkdir()
    assert not uses_of(replace(load_language("ase"), directory=tmp_path)), "a language without such sentences"


def test_a_body_that_is_no_film_may_not_be_large(api: Api) -> None:
    assert api.ask("POST", "/api/coverage", b" " * 200_000)[0] == 413


def test_a_page_of_another_site_uploads_nothing(api: Api) -> None:
    status, answer = api.ask("POST", "/api/recordings", BAG, origin="http://evil.example")
    assert (status, answer["code"]) == (403, "bad_origin")
    assert recordings(api) == []


def test_nothing_is_kept_without_the_agreement_of_the_person(api: Api) -> None:
    _, taken = api.ask("POST", "/api/recordings", BAG)
    one = f"/api/recordings/{taken['recording']}"
    terms = {"gloss": "CASA", "licence": "CC-BY-4.0", "consent": False}
    status, answer = api.ask("POST", f"{one}/accept", terms)
    assert (status, answer["code"]) == (400, "no_consent")
    status, answer = api.ask("POST", f"{one}/accept", {**terms, "consent": True, "licence": "none"})
    assert (status, answer["code"]) == (400, "malformed")
    assert api.ask("GET", f"{one}/trial")[1]["code"] == "not_ready"
    assert api.ask("DELETE", one) == (200, {})
    assert recordings(api) == []


def test_a_film_is_kept_under_a_name_that_leaves_no_folder(api: Api) -> None:
    _, taken = api.ask("POST", "/api/recordings", BAG)
    status, answer = api.ask("POST", f"/api/recordings/{taken['recording']}/keep", {"gloss": "../../x"})
    assert status == 200
    assert Path(answer["kept"]).parent == api.folders.kept
    assert Path(answer["kept"]).read_bytes() == BAG


# Above the kernel's last number; and our own, which a console before may have had.
@pytest.mark.parametrize("process", [4194305, os.getpid()], ids=["nobody", "our own"])
def test_recordings_of_a_console_that_was_killed_are_deleted(process: int, tmp_path: Path) -> None:
    left = tmp_path / "cache" / f"recordings-{process}" / "abc" / "film.webm"
    left.parent.mkdir(parents=True)
    left.touch()
    api = Api(tmp_path)
    remains = left.exists()
    api.thread.close()
    assert not remains


def test_drawings_and_no_other_file_are_given_out_under_the_page_s_rules(api: Api) -> None:
    folder = api.folders.signwriting
    for name in ("signs.json", "drawings.svg"):
        assert api.ask("GET", f"/signwriting/{name}") == (204, "")  # nothing was drawn
    folder.mkdir()
    (folder / "signs.json").write_text("{}", "utf-8")
    (folder / "private.txt").write_text("secret", "utf-8")
    assert api.ask("GET", "/signwriting/signs.json") == (200, {})
    for name in ("private.txt", "", "..%2Freviews.sqlite", "drawings.svg%2F..%2Fprivate.txt"):
        assert api.ask("GET", f"/signwriting/{name}")[0] in (403, 404), name
    assert api.ask("GET", "/signwriting/signs.json", origin="http://evil.example")[0] == 403
