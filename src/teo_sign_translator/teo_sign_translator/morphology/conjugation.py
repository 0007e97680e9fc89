# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Forms of verbs: from form to infinitive and back."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from teo_common.text_folding import strip_marks
from teo_sign_translator.data_files import read_rows
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.morphology.tags import VERB_TAGS

#: Where one form is several of its verb (come: he, or an order; comía: I, he), the first here is taken for
#: it, and of persons the third.
_LIKELIEST_FIRST = (
    "V:ind:pres",
    "V:ind:pret",
    "V:ind:impf",
    "V:ind:fut",
    "V:cond",
    "V:sub:pres",
    "V:sub:impf",
    "V:imp",
)


def _likelihood(tag: str) -> tuple[int, bool]:
    tense, _, person = tag.rpartition(":")
    rank = _LIKELIEST_FIRST.index(tense) if tense in _LIKELIEST_FIRST else len(_LIKELIEST_FIRST)
    return rank, person != "3s"


class VerbForm(NamedTuple):
    """One form of a verb: what it is, and how it is written."""

    infinitive: str
    tag: str
    written: str


@dataclass(frozen=True, slots=True)
class _Paradigm:
    """Endings that verbs share, by tag, and by the ending without marks."""

    infinitive: str
    by_tag: dict[str, tuple[str, ...]]
    by_folded: dict[str, list[tuple[str, str]]]


class Conjugations:
    """The verbs of text/morphology/conjugations.tsv."""

    def __init__(self, path: Path) -> None:
        """Read the file.

        Raises:
            TranslationError: "invalid_data" if it is not such a file.
        """
        self._verbs: dict[str, tuple[str, _Paradigm]] = {}
        self._stems: dict[str, list[tuple[str, _Paradigm]]] = defaultdict(list)
        for number, (_, endings, stems) in read_rows(path, 3):
            paradigm = _read_paradigm(endings.split(" "), f"{path}, line {number}")
            for word in stems.split(" "):
                stem = word.replace(".", "")
                self._verbs[stem + paradigm.infinitive] = (stem, paradigm)
                self._stems[strip_marks(stem)].append((stem, paradigm))

    def forms(self, infinitive: str, tag: str) -> tuple[str, ...]:
        """The ways to write a form, the usual one first; none if the verb is unknown or has no such form."""
        stem, paradigm = self._verbs.get(infinitive, ("", None))
        return tuple(stem + ending for ending in paradigm.by_tag.get(tag, ())) if paradigm else ()

    def endings(self, infinitive: str, folded: str) -> list[tuple[str, str]]:
        """Endings of a known verb that are typed like this without marks, each with its tag."""
        return self._verbs[infinitive][1].by_folded.get(folded, [])

    def readings(self, folded: str) -> Iterator[VerbForm]:
        """Every verb form that is typed like this without marks; of equals, the likelier tag first."""
        for cut in range(len(folded) + 1):
            for stem, paradigm in self._stems.get(folded[:cut], ()):
                for ending, tag in paradigm.by_folded.get(folded[cut:], ()):
                    yield VerbForm(stem + paradigm.infinitive, tag, stem + ending)


def _read_paradigm(columns: list[str], place: str) -> _Paradigm:
    if len(columns) != len(VERB_TAGS):
        raise TranslationError(
            "invalid_data", f"{place}: expected {len(VERB_TAGS)} endings, got {len(columns)}: build it again"
        )
    by_tag = {
        tag: tuple(ending.replace("_", "") for ending in column.split(","))
        for tag, column in zip(VERB_TAGS, columns, strict=True)
    }
    by_folded: dict[str, list[tuple[str, str]]] = defaultdict(list)
    for tag in sorted(by_tag, key=_likelihood):
        for ending in by_tag[tag]:
            by_folded[strip_marks(ending)].append((ending, tag))
    return _Paradigm(by_tag["V:inf"][0], by_tag, dict(by_folded))
