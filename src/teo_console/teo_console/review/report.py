# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a series says: shares recognised with intervals, what was taken for what, agreement, ratings."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Sequence

from msgspec import Struct

from teo_console.review.figures import Interval, krippendorff_alpha, wilson
from teo_console.review.series import Answer


class Anchor(Struct, frozen=True, kw_only=True):
    """A published figure to compare with. It was asked otherwise and of others: no more than a mark."""

    name: str
    """What a page has words for in its language: `anchor.<name>`."""
    what: str
    source: str


_ANCHORS = (
    Anchor(
        name="letters",
        what="94.7 % of 26 letters recognised (American manual alphabet on the TATUM hand)",
        source="TATUM hand, IEEE EMBC 2021",
    ),
    Anchor(
        name="words",
        what="most of 15 isolated signs recognised by most of 12 people (Italian Sign Language on Pepper)",
        source="Botta et al. 2025, arXiv:2509.09889",
    ),
    Anchor(
        name="teo",
        what="TEO's fingerspelling and basic words shown to 16 deaf and hard of hearing people",
        source="Gago et al., Electronics 2019, 8(1) 57, arXiv:1901.05939",
    ),
)


class ItemReport(Struct, frozen=True, kw_only=True):
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
    items: tuple[ItemReport, ...]
    anchors: tuple[Anchor, ...] = _ANCHORS


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


def _item(meaning: str, said: Sequence[Answer]) -> ItemReport:
    return ItemReport(
        meaning=meaning,
        answers=len(said),
        recognised=wilson(sum(answer.recognised for answer in said), len(said)),
        taken_for=dict(Counter(answer.understood for answer in said if not answer.recognised).most_common()),
        ratings=dict(Counter(answer.rating for answer in said if answer.rating is not None)),
        flags=dict(Counter(flag for answer in said for flag in answer.flags).most_common()),
        comments=tuple(answer.comment for answer in said if answer.comment),
    )
