# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a series says: recognition, confusions, agreement and ratings; and all answers as JSON or CSV."""

from __future__ import annotations

import csv
import datetime
import io
import math
from collections import Counter, defaultdict
from collections.abc import Hashable, Iterable, Sequence
from statistics import NormalDist
from typing import NamedTuple

import msgspec
from msgspec import Struct

from teo_console.review.series import Answer


class Interval(NamedTuple):
    """A share and the interval in which the true one is with 95 %; all 0 to 1."""

    share: float
    low: float
    high: float


def wilson(successes: int, total: int) -> Interval | None:
    """The score interval of a share with 95 % confidence; None of no answers.

    E. B. Wilson, "Probable inference, the law of succession, and statistical inference", JASA 22 (1927).
    Answers of one person to several items hang together, so that it is rather too narrow.
    """
    if total == 0:
        return None
    z = NormalDist().inv_cdf(0.975)
    share = successes / total
    middle = (share + z * z / (2 * total)) / (1 + z * z / total)
    half = z * math.sqrt(share * (1 - share) / total + z * z / (4 * total * total)) / (1 + z * z / total)
    return Interval(share, max(middle - half, 0.0), min(middle + half, 1.0))


def krippendorff_alpha(units: Iterable[Sequence[Hashable]]) -> float | None:
    """Krippendorff's alpha of nominal values: 1 if reviewers agree always, 0 if as by chance.

    K. Krippendorff, "Computing Krippendorff's alpha-reliability" (2011), by coincidences. Not every reviewer
    needs to have rated every unit.

    Args:
        units: For each item the values that reviewers gave it.

    Returns:
        At most 1; None if no item has two values, or all values of all items are the same: then nothing tells
        agreement from habit.
    """
    coincidences: Counter[tuple[Hashable, Hashable]] = Counter()
    for values in units:
        counts = Counter(values)
        pairs = len(values) - 1
        if pairs < 1:
            continue
        for one, first in counts.items():
            for other, second in counts.items():
                coincidences[one, other] += first * (second - (one == other)) / pairs  # type: ignore[assignment]
    totals: Counter[Hashable] = Counter()
    for (one, _), count in coincidences.items():
        totals[one] += count
    n = sum(totals.values())
    expected = n * n - sum(count * count for count in totals.values())
    if n < 2 or expected == 0:
        return None
    observed = sum(count for (one, other), count in coincidences.items() if one != other)
    return 1.0 - (n - 1) * observed / expected


class _Anchor(Struct, frozen=True, kw_only=True):
    """A published figure to compare with. It was asked otherwise and of others: no more than a mark."""

    name: str
    """What a page has words for in its language: `anchor.<name>`."""
    what: str
    source: str


_ANCHORS = (
    _Anchor(
        name="letters",
        what="94.7 % of 26 letters recognised (American manual alphabet on the TATUM hand)",
        source="TATUM hand, IEEE EMBC 2021",
    ),
    _Anchor(
        name="words",
        what="most of 15 isolated signs recognised by most of 12 people (Italian Sign Language on Pepper)",
        source="Botta et al. 2025, arXiv:2509.09889",
    ),
    _Anchor(
        name="teo",
        what="TEO's fingerspelling and basic words shown to 16 deaf and hard of hearing people",
        source="Gago et al., Electronics 2019, 8(1) 57, arXiv:1901.05939",
    ),
)


class _ItemReport(Struct, frozen=True, kw_only=True):
    """What was said of one sign or sentence, over its motions."""

    meaning: str
    answers: int
    recognised: Interval | None
    taken_for: dict[str, int]
    """What else it was taken for; "" is nothing."""
    ratings: dict[str, int]
    flags: dict[str, int]
    comments: tuple[str, ...]


class Report(Struct, frozen=True, kw_only=True):
    """Figures of a series."""

    reviewers: int
    answers: int
    recognised: Interval | None
    """Of all answers."""
    recognised_by_majority: int
    """Items that more than half of those who answered recognised."""
    agreement: float | None
    """Krippendorff's alpha of the ratings, nominal; None if it cannot be told."""
    agreement_understood: float | None
    """The same of what was understood."""
    items: tuple[_ItemReport, ...]
    anchors: tuple[_Anchor, ...] = _ANCHORS


def report(meanings: Sequence[str], answers: Sequence[Answer]) -> Report:
    """The figures of a series.

    Args:
        meanings: What its items mean, in their order.
        answers: What was said of them.
    """
    of_item: dict[str, list[Answer]] = defaultdict(list)
    for answer in answers:
        of_item[answer.gloss].append(answer)
    items = tuple(_item(meaning, of_item[meaning]) for meaning in dict.fromkeys(meanings))
    return Report(
        reviewers=len({answer.reviewer for answer in answers}),
        answers=len(answers),
        recognised=wilson(sum(answer.recognised for answer in answers), len(answers)),
        recognised_by_majority=sum(
            2 * sum(a.recognised for a in of_item[item.meaning]) > item.answers for item in items
        ),
        agreement=krippendorff_alpha(
            [answer.rating for answer in said if answer.rating is not None] for said in of_item.values()
        ),
        agreement_understood=krippendorff_alpha(
            [answer.understood.casefold() for answer in said] for said in of_item.values()
        ),
        items=items,
    )


def _item(meaning: str, said: Sequence[Answer]) -> _ItemReport:
    return _ItemReport(
        meaning=meaning,
        answers=len(said),
        recognised=wilson(sum(answer.recognised for answer in said), len(said)),
        taken_for=dict(Counter(answer.understood for answer in said if not answer.recognised).most_common()),
        ratings=dict(Counter(answer.rating for answer in said if answer.rating is not None)),
        flags=dict(Counter(flag for answer in said for flag in answer.flags).most_common()),
        comments=tuple(answer.comment for answer in said if answer.comment),
    )


FORMAT = "teo-review-1"
# Spreadsheets take a cell that begins so for a formula (OWASP, "CSV injection").
_FORMULA = ("=", "+", "-", "@", "\t", "\r")


def as_json(answers: Sequence[Answer]) -> bytes:
    """The export that `lut review` reads."""
    exported = datetime.datetime.now(datetime.UTC).isoformat(timespec="seconds")
    content = {"format": FORMAT, "exported": exported, "answers": answers}
    return msgspec.json.format(msgspec.json.encode(content), indent=1) + b"\n"


def as_csv(answers: Sequence[Answer]) -> bytes:
    """A row for each answer, flags with spaces between them; an apostrophe before what would be a formula."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(Answer.__struct_fields__)
    for answer in answers:
        row = {**msgspec.structs.asdict(answer), "flags": " ".join(answer.flags)}
        writer.writerow([_cell(value) for value in row.values()])
    return out.getvalue().encode()


def _cell(value: object) -> object:
    if isinstance(value, bool):
        return int(value)
    if isinstance(value, str) and value.startswith(_FORMULA):
        return f"'{value}"
    return value
