# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Whether the table's signs are those of a dictionary's photographs, as two judges saw them side by side.

`photograph_judgments.tsv` holds what was judged, from pictures as `lut compare` draws them, without a look at
the scores: gloss, which motion (the beginning of its hash), judge, then handshape, place, palm and movement,
each `right`, `near`, `variant` (another form than the photograph's) or `wrong`, and whether the sign was
recognised. A judgment counts only as long as the sign moves as it did.
"""

from __future__ import annotations

import csv
from collections import defaultdict
from collections.abc import Sequence
from pathlib import Path

from report import Figure, share
from teo_signs.look_up_table import Lut, default_lut_directory
from teo_signs.sign import citation_hash

_FILE = Path(__file__).with_name("photograph_judgments.tsv")
_ASPECTS = ("handshape", "place", "palm", "movement")
_GOOD = ("right", "near")
# Digits of a motion's hash that the file holds.
_DIGITS = 12

_Row = dict[str, str]


def measure() -> list[Figure]:
    """Figures of the judgments that are still of the table's motions."""
    signs = Lut.open(default_lut_directory())
    judged: defaultdict[str, list[_Row]] = defaultdict(list)
    with _FILE.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file, delimiter="\t"))
    changed = set()
    for row in rows:
        gloss = row["gloss"]
        if gloss in signs and citation_hash(signs[gloss])[:_DIGITS] == row["motion"]:
            judged[gloss].append(row)
        else:
            changed.add(gloss)
    twice = {gloss: found for gloss, found in judged.items() if len(found) == 2}
    figures = [_by_standing("all", list(twice.values()))]
    standings = {gloss: signs[gloss].provenance.standing for gloss in twice}
    figures += [
        _by_standing(standing, [twice[gloss] for gloss in twice if standings[gloss] == standing])
        for standing in sorted(set(standings.values()))
    ]
    figures += [_aspect(aspect, list(twice.values())) for aspect in _ASPECTS]
    once = len(judged) - len(twice)
    return [*figures, Figure("judged once; changed since", f"{once}; {len(changed - judged.keys())}")]


def _good(row: _Row) -> bool:
    return all(row[aspect] in _GOOD for aspect in _ASPECTS)


def _by_standing(name: str, signs: Sequence[Sequence[_Row]]) -> Figure:
    both = sum(all(map(_good, rows)) for rows in signs)
    either = sum(any(map(_good, rows)) for rows in signs)
    read = sum(all(row["recognised"] == "yes" for row in rows) for rows in signs)
    return Figure(
        f"{name}: right or near in all four, by both judges, of {len(signs)}",
        f"{share(both, len(signs))}; by one at least {either}; recognised by both {read}",
    )


def _aspect(aspect: str, signs: Sequence[Sequence[_Row]]) -> Figure:
    """How often an aspect is what, and how far the judges agree beyond chance (Cohen's kappa)."""
    answers = [(first[aspect], second[aspect]) for first, second in signs]
    counts = {word: sum(pair.count(word) for pair in answers) for word in (*_GOOD, "variant", "wrong")}
    pairs = [(first in _GOOD, second in _GOOD) for first, second in answers]
    agreed = sum(first == second for first, second in pairs) / len(pairs)
    shares = [sum(pair[judge] for pair in pairs) / len(pairs) for judge in (0, 1)]
    chance = shares[0] * shares[1] + (1 - shares[0]) * (1 - shares[1])
    kappa = (agreed - chance) / (1 - chance) if chance < 1 else 1.0
    total = 2 * len(answers)
    shown = ", ".join(f"{word} {100 * count / total:.0f} %" for word, count in counts.items())
    return Figure(aspect, f"{shown}; kappa of right or near {kappa:.2f}")
