# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What reviewers are shown and what they answer, as values."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Sequence
from typing import Literal

from msgspec import Struct

from teo_console.protocol import Motion

SeriesKind = Literal["review", "comprehension"]
ItemKind = Literal["sign", "sentence"]
Rating = Literal["right", "understandable", "wrong"]
Flag = Literal["handshape", "place", "palm", "movement", "speed", "face"]

# What a reviewer chooses from: who guesses gets one in fifteen right, and as many words fit a telephone.
CHOICES = 15


class NewItem(Struct, frozen=True, kw_only=True):
    """Something to be understood.

    A sign by its gloss, or a sentence by its text; `motion_hash` says which motion of the sign it is ("" of a
    sentence); `motion` runs from rest to rest; `choices` hold the right one, and are empty where the answer
    is free.
    """

    kind: ItemKind
    meaning: str
    language: str
    motion_hash: str
    motion: Motion
    choices: tuple[str, ...] = ()


class Answer(Struct, frozen=True, kw_only=True):
    """All that one reviewer said of one item, as it is exported."""

    series: str
    series_kind: SeriesKind
    kind: ItemKind
    gloss: str
    """The sign's gloss; of a sentence its text."""
    language: str
    motion_hash: str
    reviewer: str
    chosen: bool
    """Whether the answer was one of those offered."""
    understood: str
    """In the reviewer's own words, or the choice; empty if nothing was understood."""
    recognised: bool
    """Whether that is the gloss, but for accents and capitals; other words for the same are not."""
    at: str
    """When the reviewer last said something of it, ISO 8601, UTC."""
    rating: Rating | None
    flags: tuple[Flag, ...]
    comment: str


def blind_order(items: Iterable[str], reviewer: int, seed: int) -> list[str]:
    """The order in which a reviewer sees the items: as good as random, another for each, and always the same.

    Args:
        items: Their names, which say nothing of what they mean.
        reviewer: The reviewer's number.
        seed: Of the series.
    """
    return sorted(items, key=lambda item: _digest(seed, reviewer, item))


def offered(meaning: str, near: Sequence[str], others: Sequence[str], seed: int) -> tuple[str, ...]:
    """The choices of an item: what it means among what looks most like it, in an order that tells nothing.

    Args:
        meaning: The right one.
        near: Signs that look like it, the nearest first.
        others: Signs to fill up with.
        seed: Of the series.
    """
    distractors = list(dict.fromkeys(gloss for gloss in (*near, *others) if gloss != meaning))[: CHOICES - 1]
    return tuple(sorted((meaning, *distractors), key=lambda gloss: _digest(seed, meaning, gloss)))


def _digest(*parts: object) -> bytes:
    return hashlib.sha256("\n".join(map(str, parts)).encode()).digest()
