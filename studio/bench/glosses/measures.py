# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How near translations are to those of people: signs in common, their order, edits."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from itertools import combinations

Glosses = tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Overlap:
    """What translations have in common with those of signers.

    Attributes:
        precision: Part of the signs that came out that are among the signer's, 0 to 1.
        recall: Part of the signer's signs that came out, 0 to 1.
        pairs: Pairs of signs that both have, once each.
        in_order: Part of these pairs that come in the signer's order, 0 to 1.
    """

    precision: float
    recall: float
    pairs: int
    in_order: float


def overlap(expected: Sequence[Glosses], got: Sequence[Glosses]) -> Overlap:
    """Compare bags of signs and the order of common ones, over all sentences together."""
    common = pairs = in_order = 0
    for signed, said in zip(expected, got, strict=True):
        left, right = Counter(signed), Counter(said)
        common += (left & right).total()
        both = [gloss for gloss in signed if left[gloss] == right[gloss] == 1]
        for first, second in combinations(both, 2):
            pairs += 1
            in_order += said.index(first) < said.index(second)
    return Overlap(
        _part(common, sum(map(len, got))),
        _part(common, sum(map(len, expected))),
        pairs,
        _part(in_order, pairs),
    )


def fewest_edits(accepted: Collection[Glosses], got: Glosses) -> tuple[int, int]:
    """Edits from a translation to the nearest accepted one.

    Returns:
        Glosses to insert, delete or replace, and the glosses of that accepted translation.
    """
    return min((_edits(each, got), len(each)) for each in accepted)


def _edits(a: Glosses, b: Glosses) -> int:
    """Levenshtein's distance."""
    row = list(range(len(b) + 1))
    for i, gloss in enumerate(a, start=1):
        above, row[0] = row[0], i
        for j, other in enumerate(b, start=1):
            above, row[j] = row[j], min(row[j] + 1, row[j - 1] + 1, above + (gloss != other))
    return row[-1]


def _part(some: int, every: int) -> float:
    return some / every if every else 0.0
