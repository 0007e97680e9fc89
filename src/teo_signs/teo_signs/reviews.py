# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From what signers said of signs to the standing `reviewed`: the exported ratings, and the rule.

A sign is reviewed when enough people rated the motion that it has now, and enough of them found it right.
Ratings of an earlier motion do not count; of several ratings by one person the last does.
"""

from __future__ import annotations

import datetime
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Literal, NamedTuple

import msgspec
from msgspec import Meta, Struct
from msgspec.structs import replace as changed

from teo_signs.errors import LutError
from teo_signs.sign import Sign, motion_hash
from teo_signs.sign_schema import Gloss, Provenance, Review, check_gloss

#: What a reviewer finds a motion to be.
Rating = Literal["right", "understandable", "wrong"]

# One person's habit is no norm, and two who differ decide nothing.
LEAST_REVIEWERS = 3
# With three reviewers all must agree; from four on one in four may sign it otherwise, as signers of different
# regions do.
LEAST_RIGHT = 0.75

# Bytes of an export that is read: a thousand signs rated by twenty people with comments are a third of it.
_MAX_EXPORT_BYTES = 30_000_000


class SignRating(Struct, frozen=True, kw_only=True, tag_field="kind", tag="sign"):
    """One person's rating of one sign's motion, as exported; further fields are for people."""

    reviewer: Annotated[str, Meta(min_length=1)]
    gloss: Gloss
    motion_hash: Annotated[str, Meta(pattern=r"^[0-9a-f]{64}$")]
    rating: Rating | None
    """None where the person has said what was understood and has not rated it."""
    at: datetime.datetime

    def __post_init__(self) -> None:
        """Refuse a name that no sign may have."""
        check_gloss(self.gloss)


class _SentenceRating(Struct, frozen=True, tag_field="kind", tag="sentence"):
    """One person's rating of a sentence, which says nothing of any sign in it."""


class _Export(Struct, frozen=True):
    format: Literal["teo-review-1"]
    answers: list[SignRating | _SentenceRating]


class Rule(NamedTuple):
    """How many people must have rated a motion, and what share of them must find it right."""

    least_reviewers: int = LEAST_REVIEWERS
    least_right: float = LEAST_RIGHT


@dataclass(frozen=True, kw_only=True)
class Verdict:
    """What the ratings make of a sign.

    Attributes:
        sign: The sign, with the standing that it has now.
        changed: Whether that, or the count of its reviewers, is another than before.
        reviewers: People who rated the motion that it has.
        right: How many of them found it right.
        reason: Why it stands so; a sentence.
    """

    sign: Sign
    changed: bool
    reviewers: int
    right: int
    reason: str


def read_ratings(path: Path) -> list[SignRating]:
    """The ratings of signs in an export of the console's reviews.

    Raises:
        LutError: The file cannot be read ("unreadable"), is too large ("too_large"), or is no such export
            ("bad_review").
    """
    try:
        with path.open("rb") as file:
            text = file.read(_MAX_EXPORT_BYTES + 1)
    except OSError as error:
        message = f"{path}: expected an export of reviews, got: {error.strerror or error}"
        raise LutError("unreadable", message) from error
    if len(text) > _MAX_EXPORT_BYTES:
        raise LutError("too_large", f"{path}: expected at most {_MAX_EXPORT_BYTES} bytes, got more")
    try:
        export = msgspec.json.decode(text, type=_Export)
    except msgspec.DecodeError as error:  # of those that do not fit, too
        message = f"{path.name}: expected an export of reviews in JSON: {error}"
        raise LutError("bad_review", message) from error
    return [answer for answer in export.answers if isinstance(answer, SignRating)]


def judge(sign: Sign, ratings: Iterable[SignRating], *, day: datetime.date, rule: Rule) -> Verdict:
    """What the ratings of a sign make of its standing.

    With fewer people than the rule asks for nothing changes. A reviewed sign that enough people rated and
    too few found right falls back to the standing before its review.

    Args:
        sign: The sign, as read from its file.
        ratings: Of this gloss; of any motion.
        day: Day that the entry will name.
        rule: When a sign is reviewed.
    """
    shown = motion_hash(sign)
    last: dict[str, SignRating] = {}
    for rating in sorted(ratings, key=lambda rating: rating.at):
        if rating.rating is not None and rating.motion_hash == shown:
            last[rating.reviewer] = rating
    reviewers = len(last)
    right = sum(rating.rating == "right" for rating in last.values())
    provenance = sign.provenance
    if reviewers >= rule.least_reviewers:
        provenance = _standing_by(provenance, reviewers, right, shown, day=day, rule=rule)
    return Verdict(
        sign=replace(sign, provenance=provenance),
        changed=provenance != sign.provenance,
        reviewers=reviewers,
        right=right,
        reason=f"{right} of {reviewers} found this motion right; needed are {rule.least_reviewers} people, "
        f"and {100.0 * rule.least_right:g} % of them",
    )


def _standing_by(
    provenance: Provenance, reviewers: int, right: int, shown: str, *, day: datetime.date, rule: Rule
) -> Provenance:
    """The provenance after enough people rated the motion `shown`."""
    earlier = provenance.review
    source = provenance.standing if earlier is None else earlier.standing
    assert source != "reviewed"  # no provenance says so without a review
    if right < rule.least_right * reviewers:
        return changed(provenance, standing=source, review=None)
    review = Review(
        reviewers=reviewers, right=right, standing=source, motion_hash=shown, reviewed=day.isoformat()
    )
    if earlier is not None and changed(review, reviewed=earlier.reviewed) == earlier:
        review = earlier  # of the day that it names already
    return changed(provenance, standing="reviewed", review=review)
