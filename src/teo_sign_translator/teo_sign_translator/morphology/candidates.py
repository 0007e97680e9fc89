# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a word may be before the likeliest is chosen, and where words come from."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple, Protocol

from teo_sign_translator.morphology import lexicon
from teo_sign_translator.morphology.accents import accents_fit
from teo_sign_translator.morphology.lexicon import Form
from teo_sign_translator.morphology.reading import Reading

#: What a reading comes from, the likeliest first.
CLOSED, ADVERB, NOUN, ADJECTIVE, LATE_ADVERB, VERB, NAME, WITH_PRONOUNS = range(8)
#: How much a reading asks of the reader, from none: accents left out, an ending taken off, a rare verb.
EXACT, ACCENTS_MISSING, ACCENTS_WRONG, DERIVED, RARE = range(5)


class Candidate(NamedTuple):
    """A reading, and the numbers that order it among the others; small is likely."""

    effort: int
    source: int
    reading: Reading


class Entry(NamedTuple):
    """A form of the lexicon, and what it comes from."""

    form: Form
    source: int


#: Entries by their form without marks.
Index = Mapping[str, Sequence[Entry]]


class WordForms(Protocol):
    """How the words of one language get their forms; `Morphology` asks it for what its lists do not hold."""

    def entries(self) -> Iterator[Entry]:
        """Every form that is known before any text is read."""

    def unlisted(self, form: str, folded: str, listed: list[Candidate], index: Index) -> list[Candidate]:
        """What else a word may be beside its entries: forms and words made by rule.

        Args:
            form: The word in lower case.
            folded: The same without marks.
            listed: What the entries say of it.
            index: All entries.
        """

    def guess(self, form: str) -> Reading:
        """The likeliest reading of an unknown word in lower case."""

    def forms(self, lemma: str, tag: str) -> tuple[str, ...]:
        """The ways to write a form that no entry has, the usual one first; none if there is no such form."""


def effort(written: str, typed: str) -> int:
    """How much is asked of who reads a form in a word as typed: nothing, or accents."""
    if written == typed:
        return EXACT
    return ACCENTS_MISSING if accents_fit(written, typed) else ACCENTS_WRONG


def listed_entries(folder: Path | None, nominal: Iterable[Entry]) -> Iterator[Entry]:
    """The entries of a language's lists.

    Args:
        folder: The language's text folder; by default that of the default language.
        nominal: Those of its nouns, adjectives and, where they are listed, verbs.
    """
    for adverb in lexicon.adverbs(folder):
        tag = lexicon.ADVERB_TAGS[adverb.kind]
        late = adverb.kind in ("manner", "degree", "sentence")
        yield Entry(Form(adverb.lemma, adverb.lemma, tag), LATE_ADVERB if late else ADVERB)
    yield from nominal
    for name in lexicon.names(folder):
        yield Entry(Form(name.name, name.name, lexicon.NAME_TAGS[name.kind]), NAME)
    # Last: of the forms of a lemma and tag the first is the one that is written, and here is gran for grande.
    for form in lexicon.closed_class_forms(folder):
        yield Entry(form, CLOSED)
