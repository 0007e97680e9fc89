# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Words of a language with a table of conjugations: verbs with pronouns, derived words."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from teo_sign_translator.data_files import data_file
from teo_sign_translator.morphology import lexicon
from teo_sign_translator.morphology.accents import accents_fit, unaccented
from teo_sign_translator.morphology.candidates import (
    ACCENTS_WRONG,
    ADJECTIVE,
    CLOSED,
    DERIVED,
    EXACT,
    LATE_ADVERB,
    NOUN,
    RARE,
    VERB,
    WITH_PRONOUNS,
    Candidate,
    Entry,
    Index,
    effort,
    listed_entries,
)
from teo_sign_translator.morphology.conjugation import Conjugations
from teo_sign_translator.morphology.derivation import DIMINUTIVE, SUPERLATIVE, Derived, derived, of_adverb
from teo_sign_translator.morphology.enclitics import attach_pronouns, detach_pronouns
from teo_sign_translator.morphology.guessing import guess
from teo_sign_translator.morphology.reading import Reading
from teo_sign_translator.morphology.tags import tag_class

_SPOKEN_PARTICIPLE = re.compile(r"(?P<stem>\w{2,})ao(?P<plural>s?)")


class ConjugatedForms:
    """`WordForms` of a language whose text folder has `morphology/conjugations.tsv`."""

    def __init__(self, folder: Path | None = None) -> None:
        """Read the lists and the table.

        Args:
            folder: The language's text folder; by default that of the default language.

        Raises:
            TranslationError: "invalid_data" if a file is damaged.
        """
        self._folder = folder
        table = "morphology/conjugations.tsv"
        self._conjugations = Conjugations(folder / table if folder else data_file(table))
        self._everyday = {verb.lemma for verb in lexicon.verbs(folder)}

    def entries(self) -> Iterator[Entry]:
        """See `WordForms`."""
        return listed_entries(self._folder, self._nominal())

    def unlisted(self, form: str, folded: str, listed: list[Candidate], index: Index) -> list[Candidate]:
        """See `WordForms`; rare verbs, and words with other accents, only where there is nothing else.

        The short words of the closed classes are always there: people mistake tú for tu and más for mas.
        """
        common = [*listed, *self._verbs(form, folded)]
        if not any(each.effort == EXACT and each.reading.exact for each in common):
            common += _derived(form, folded, index)
        common += _adverbs(form, folded, index)
        likely = [each for each in common if each.effort != RARE] or common
        fitting = [each for each in likely if each.effort != ACCENTS_WRONG or each.source == CLOSED]
        return fitting or likely or self._spoken_participles(folded)

    def guess(self, form: str) -> Reading:
        """See `WordForms`."""
        return guess(form, self._conjugations)

    def forms(self, lemma: str, tag: str) -> tuple[str, ...]:
        """See `WordForms`."""
        return self._conjugations.forms(lemma, tag)

    def _nominal(self) -> Iterator[Entry]:
        described = {adjective.lemma for adjective in lexicon.adjectives(self._folder)}
        for noun in lexicon.nouns(self._folder):
            # A word for people is more often said of them: "está enfermo" before "un enfermo".
            after_adjective = noun.classes[0] == "person" and noun.lemma in described
            source = LATE_ADVERB if after_adjective else NOUN
            yield from (Entry(form, source) for form in lexicon.nominal_forms(noun))
        for adjective in lexicon.adjectives(self._folder):
            yield from (Entry(form, ADJECTIVE) for form in lexicon.nominal_forms(adjective))

    def _verbs(self, form: str, folded: str) -> Iterator[Candidate]:
        for verb, tag, written in self._conjugations.readings(folded):
            if verb in self._everyday or accents_fit(written, form):  # tráfico is not the rare traficar
                yield self._verb(verb, tag, written, form, ())
        for bare, pronouns in detach_pronouns(folded):
            for verb, tag, written in self._conjugations.readings(bare):
                if tag in ("V:inf", "V:ger") or tag.startswith("V:imp"):
                    yield self._verb(verb, tag, attach_pronouns(written, pronouns), form, pronouns)

    def _verb(self, verb: str, tag: str, written: str, form: str, pronouns: tuple[str, ...]) -> Candidate:
        cost = effort(written, form)
        reading = Reading(verb, tag, pronouns, exact=cost == EXACT)
        if verb not in self._everyday:
            cost = RARE
        return Candidate(cost, WITH_PRONOUNS if pronouns else VERB, reading)

    def _spoken_participles(self, folded: str) -> list[Candidate]:
        """Participles in -ado as people say and type them: mandao."""
        spoken = _SPOKEN_PARTICIPLE.fullmatch(folded)
        written = f"{spoken['stem']}ado{spoken['plural']}" if spoken else ""
        return [each for each in self._verbs(written, written) if each.reading.tag.startswith("V:part")]


def _adverbs(form: str, folded: str, index: Index) -> Iterator[Candidate]:
    """An adverb in -mente, and the adjective that it is made from."""
    base = of_adverb(folded)
    for (written, lemma, tag), _ in index.get(base, ()) if base else ():
        if tag in ("A:fs", "A:cs"):
            adverb = written + "mente"
            cost = effort(adverb, form)
            yield Candidate(cost, LATE_ADVERB, Reading(adverb, "ADV:manner", exact=cost == EXACT))
            yield Candidate(DERIVED, ADJECTIVE, Reading(lemma, tag, exact=cost == EXACT))


def _derived(form: str, folded: str, index: Index) -> Iterator[Candidate]:
    if unaccented(form) == form:  # mérito is no mere little
        for little in derived(DIMINUTIVE, folded):
            yield from _from_base(little, ("N", "A", "ADV", "DET"), index)
    for utmost in derived(SUPERLATIVE, folded):
        yield from _from_base(utmost, ("A", "DET"), index)


def _from_base(derived: Derived, classes: tuple[str, ...], index: Index) -> Iterator[Candidate]:
    for base in derived.bases:
        for (_, lemma, tag), source in index.get(base, ()):
            stem, last = tag[:-2], tag[-2:]
            if tag_class(tag) not in classes or (tag_class(tag) == "DET" and ":quant" not in tag):
                continue
            if tag_class(tag) == "ADV":
                yield Candidate(DERIVED, source, Reading(lemma, tag))
            elif last[1] == "s" and last[0] in (derived.gender, "c"):
                yield Candidate(DERIVED, source, Reading(lemma, f"{stem}{last[0]}{derived.number}"))
