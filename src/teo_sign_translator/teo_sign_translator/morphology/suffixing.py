# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Words of a language whose forms are few: a suffix rule for each, which the language's data gives."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from teo_sign_translator.data_files import invalid_line, read_rows
from teo_sign_translator.morphology import lexicon
from teo_sign_translator.morphology.lexicon import (
    ADJECTIVE,
    NOUN,
    VERB,
    Candidate,
    Entry,
    Form,
    Index,
    listed_entries,
)
from teo_sign_translator.morphology.readings import TAGS, Reading, tag_class

#: Where the rules stand in a language's text folder; the file explains its columns.
SUFFIXES = "morphology/suffixes.tsv"
_GUESSES = "morphology/guesses.tsv"


class _Rule(NamedTuple):
    """One way to make a form: of words that a pattern matches, by a replacement."""

    tag: str
    pattern: re.Pattern[str]
    replacement: str


class SuffixedForms:
    """`WordForms` of a language whose text folder has `morphology/suffixes.tsv`."""

    def __init__(self, folder: Path) -> None:
        """Read the rules of a language's text folder.

        Raises:
            TranslationError: "invalid_data" if a file is damaged.
        """
        self._folder = folder
        self._rules = _read_rules(folder / SUFFIXES)
        self._guesses = _read_rules(folder / _GUESSES)

    def entries(self) -> Iterator[Entry]:
        """See `WordForms`."""
        return listed_entries(self._folder, self._inflected())

    def unlisted(self, form: str, folded: str, listed: list[Candidate], index: Index) -> list[Candidate]:
        """See `WordForms`: nothing, every form of a listed word is an entry."""
        del form, folded, index
        return listed

    def guess(self, form: str) -> Reading:
        """See `WordForms`."""
        for rule in self._guesses:
            if match := rule.pattern.fullmatch(form):
                return Reading(match.expand(rule.replacement), rule.tag, exact=False)
        return Reading(form, "X", exact=False)

    def forms(self, lemma: str, tag: str) -> tuple[str, ...]:
        """See `WordForms`: none beside the entries."""
        del lemma, tag
        return ()

    def _inflected(self) -> Iterator[Entry]:
        for row in lexicon.inflected_words(self._folder, "nouns", columns=4):
            yield from (Entry(form, NOUN) for form in self._of(row, "N"))
        for row in lexicon.inflected_words(self._folder, "adjectives", columns=5):
            yield from (Entry(form, ADJECTIVE) for form in self._of(row, "A"))
        verbs = {row.lemma: row for row in lexicon.inflected_words(self._folder, "verbs", columns=2)}
        for lemma in verbs:
            verb, _, particle = lemma.partition("_")
            for form in self._of(verbs.get(verb, verbs[lemma]), "V"):
                written = f"{form.written} {particle.replace('_', ' ')}".rstrip()
                yield Entry(Form(written, lemma, form.tag), VERB)

    def _of(self, row: lexicon.Inflected, word_class: str) -> Iterator[Form]:
        """The forms of a word: those that its row gives, the others by the first rule that fits."""
        made: set[str] = set()
        for rule in self._rules:
            if tag_class(rule.tag) != word_class or rule.tag in made:
                continue
            own = row.irregular.get(rule.tag.rpartition(":")[2])
            match = rule.pattern.fullmatch(row.lemma)
            if own or match:
                made.add(rule.tag)
                written = own.split("/") if own else [match.expand(rule.replacement)] if match else []
                yield from (Form(each.replace("_", " "), row.lemma, rule.tag) for each in written)


def _read_rules(path: Path) -> list[_Rule]:
    rules: list[_Rule] = []
    for number, (tag, pattern, replacement) in read_rows(path, columns=3):
        if tag not in TAGS:
            raise invalid_line(path, number, "a tag of morphology/readings.py", f"'{tag}'")
        try:
            rules.append(_Rule(tag, re.compile(pattern), replacement))
        except re.error as error:
            raise invalid_line(path, number, "a regular expression", f"'{pattern}': {error}") from error
    return rules
