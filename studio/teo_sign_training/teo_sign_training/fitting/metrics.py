# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How good translations are: exact matches and BLEU."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

Glosses = tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Score:
    """Of a set of translations.

    Attributes:
        count: Sentences.
        exact: Part of them that came out as expected, gloss by gloss, 0 to 1.
        bleu: Corpus BLEU-4 of sacreBLEU over glosses as they stand (tokenisation "none"), 0 to 100.
    """

    count: int
    exact: float
    bleu: float


def score(expected: Sequence[Glosses], got: Sequence[Glosses]) -> Score:
    """Compare translations with what was expected, one for one; none at all scores 0."""
    from sacrebleu import corpus_bleu  # only evaluation needs it

    if not expected:
        return Score(0, 0.0, 0.0)
    exact = sum(a == b for a, b in zip(expected, got, strict=True)) / len(expected)
    bleu = corpus_bleu(
        [" ".join(each) for each in got],
        [[" ".join(each) for each in expected]],
        tokenize="none",
        # Glosses are no sentences that someone forgot to tokenise; without this sacreBLEU warns of it.
        force=True,
    )
    return Score(len(expected), exact, float(bleu.score))
