# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""When a sign is reviewed, and when no longer."""

from __future__ import annotations

import datetime
import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from msgspec.structs import replace as changed
from refusals import refused

from teo_signs.lexicon import Lexicon
from teo_signs.reviews import Rule, SignRating, Verdict, judge, read_ratings
from teo_signs.sign import Sign, motion_hash, sign_warnings
from teo_signs.sign_file import format_sign, parse_sign, read_sign, save_sign
from teo_signs.tokens import Token

MakeSign = Callable[..., Sign]
DAY = datetime.date(2026, 3, 1)
NOON = datetime.datetime(2026, 3, 1, 12, tzinfo=datetime.UTC)


@pytest.fixture
def sign(make_sign: MakeSign) -> Sign:
    """A sketch in a file's precision."""
    joints = ("FrontalRightElbow", "RightIndexFinger")
    made = make_sign("PERA", [[-0.5, 0.2], [-1.0, 0.3]], (0.0, 0.5), joints=joints)
    made = replace(made, provenance=changed(made.provenance, standing="sketched"))
    return parse_sign(format_sign(made), file="PERA.json")


def rated(sign: Sign, *ratings: str | None) -> list[SignRating]:
    """Ratings by as many people: of the sign's motion."""
    return [
        SignRating(
            reviewer=f"person {number}",
            gloss=sign.gloss,
            motion_hash=motion_hash(sign),
            rating=rating,
            at=NOON,
        )
        for number, rating in enumerate(ratings)
    ]


def verdict(sign: Sign, *ratings: str | None) -> Verdict:
    return judge(sign, rated(sign, *ratings), day=DAY, rule=Rule(least_reviewers=3, least_right=0.75))


@pytest.mark.parametrize(
    ("ratings", "standing"),
    [
        (["right"] * 3, "reviewed"),
        (["right"] * 2, "sketched"),  # too few people
        (["right", "right", None], "sketched"),  # who has not rated does not count
        (["right", "right", "understandable"], "sketched"),
        (["right", "right", "right", "wrong"], "reviewed"),
        (["wrong"] * 3, "sketched"),
        ([], "sketched"),
    ],
)
def test_a_sign_is_reviewed_when_enough_people_find_it_right(
    sign: Sign, ratings: list[str | None], standing: str
) -> None:
    assert verdict(sign, *ratings).sign.provenance.standing == standing


def test_one_person_counts_once_and_with_the_last_word(sign: Sign) -> None:
    first, second, third = rated(sign, "wrong", "right", "right")
    later = changed(first, rating="right", at=NOON + datetime.timedelta(hours=1))
    result = judge(sign, [later, second, first, third], day=DAY, rule=Rule(3, 1.0))
    assert (result.reviewers, result.right) == (3, 3)
    twice = [second, changed(second, at=later.at), third]
    assert judge(sign, twice, day=DAY, rule=Rule(3, 1.0)).reviewers == 2


def test_a_reviewed_sign_says_by_how_many_and_keeps_it_in_its_file(sign: Sign, tmp_path: Path) -> None:
    path = save_sign(tmp_path, verdict(sign, "right", "right", "right", "wrong").sign)
    read = read_sign(path).provenance
    assert read.standing == "reviewed"
    assert read.review is not None
    assert (read.review.reviewers, read.review.right, read.review.standing) == (4, 3, "sketched")
    assert read.review.reviewed == "2026-03-01"


def test_a_reviewed_sign_is_the_best_founded(sign: Sign) -> None:
    reviewed = verdict(sign, *["right"] * 3).sign
    for least in ("reviewed", "recorded", "sketched"):
        (item,) = Lexicon({"PERA": reviewed}, least_standing=least).resolve([Token(gloss="PERA")])
        assert item.sign is reviewed


def test_ratings_of_another_motion_do_not_count(sign: Sign) -> None:
    ratings = rated(sign, *["right"] * 3)
    moved = parse_sign(format_sign(replace(sign, knots=sign.knots + 0.01)), file="PERA.json")
    assert judge(moved, ratings, day=DAY, rule=Rule()).reviewers == 0


@pytest.mark.parametrize("field", ["knots", "times"])
def test_a_sign_whose_motion_changes_is_as_founded_as_before_its_review(
    sign: Sign, tmp_path: Path, field: str
) -> None:
    reviewed = verdict(sign, *["right"] * 3).sign
    slower = replace(reviewed, **{field: getattr(reviewed, field) * 1.01})
    read = read_sign(save_sign(tmp_path, slower))
    assert read.provenance.standing == "sketched"
    assert any("review" in warning for warning in sign_warnings(read))
    # Likewise if somebody edits the file.
    edited = json.loads(format_sign(reviewed))
    edited[field][1] = [-1.0, 0.4] if field == "knots" else 0.6
    assert parse_sign(json.dumps(edited), file="PERA.json").provenance.standing == "sketched"


def test_notes_and_figures_are_no_motion(sign: Sign) -> None:
    reviewed = verdict(sign, *["right"] * 3).sign
    noted = replace(
        reviewed,
        quality={"place_error_mm": 3.0},
        provenance=changed(reviewed.provenance, notes="seen"),
    )
    assert parse_sign(format_sign(noted), file="PERA.json").provenance.standing == "reviewed"


def test_a_reviewed_sign_that_people_find_wrong_falls_back(sign: Sign) -> None:
    reviewed = verdict(sign, *["right"] * 3).sign
    lowered = verdict(reviewed, "right", "right", "wrong")
    assert lowered.sign.provenance.standing == "sketched"
    assert lowered.changed
    # One other person does not outweigh three, and the same three change nothing.
    assert not verdict(reviewed, "wrong").changed
    assert not judge(reviewed, rated(sign, *["right"] * 3), day=DAY.replace(day=9), rule=Rule()).changed


def test_nobody_is_reviewed_without_a_review(sign: Sign) -> None:
    claimed = json.loads(format_sign(sign))
    claimed["provenance"]["standing"] = "reviewed"
    with refused("bad_value"):
        parse_sign(json.dumps(claimed), file="PERA.json")


@pytest.mark.parametrize(
    "content",
    [
        "{",
        '{"format": "teo-review-2", "answers": []}',
        '{"format": "teo-review-1", "answers": [{"kind": "sign", "gloss": "PERA"}]}',
        '{"format": "teo-review-1", "answers": [{"kind": "song"}]}',
    ],
)
def test_what_is_no_export_is_refused_and_sentences_rate_no_sign(tmp_path: Path, content: str) -> None:
    path = tmp_path / "export.json"
    path.write_text(content, "utf-8")
    with refused("bad_review"):
        read_ratings(path)
    path.write_text('{"format": "teo-review-1", "answers": [{"kind": "sentence", "rating": "right"}]}')
    assert read_ratings(path) == []
