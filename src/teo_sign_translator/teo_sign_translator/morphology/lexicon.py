# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The lists of a language's lexicon, the forms of their words, and candidates for the words of a text.

Each reader of a list takes the language's text folder, which holds `lexicon`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import NamedTuple, Protocol

from teo_sign_translator.data_files import read_rows, words_of
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.morphology.readings import Reading
from teo_sign_translator.morphology.spanish import accents_fit, feminine, is_invariable, plural

ADVERB_TAGS = {
    "time-past": "ADV:time:past",
    "time-present": "ADV:time:present",
    "time-future": "ADV:time:future",
    "time-frequency": "ADV:time:frequency",
    "time": "ADV:time",
    "negative": "ADV:neg",
    "manner": "ADV:manner",
    "place": "ADV:place",
    "degree": "ADV:degree",
    "sentence": "ADV:sentence",
}
NAME_TAGS = {
    "m": "NAME:m",
    "f": "NAME:f",
    "surname": "NAME",
    "country": "NAME:place",
    "continent": "NAME:place",
    "region": "NAME:place",
    "city": "NAME:place",
}
#: Semantic classes; the files' headers say what each holds.
NOUN_CLASSES = words_of(
    "person family profession animal food drink place building room object clothing furniture vehicle body "
    "illness time event subject nature weather material abstract media money tool sport music group language "
    "plant container document device game"
)
ADJECTIVE_CLASSES = words_of("size colour person feeling food object place quality weather nationality")
_USES = ("ser", "estar", "both")
_REFLEXIVE = ("no", "also", "mostly")

#: What the gender column says, as the beginnings of tags: of the word itself and of its feminine; `-` is of
#: languages without gender.
_GENDERS = {"m": "m", "f": "f", "mf": "c", "inv": "c", "m+f": "m", "mp": "m", "fp": "f", "-": ""}


class Inflected(NamedTuple):
    """A word whose forms are made by suffixes; `irregular` has the others, by the last part of their tag."""

    lemma: str
    irregular: dict[str, str]


class Form(NamedTuple):
    """One form of a word as it is written."""

    written: str
    lemma: str
    tag: str


class Nominal(NamedTuple):
    """A noun or adjective: a row of nouns.tsv or adjectives.tsv.

    `kind` is "N" or "A"; `irregular` has the forms that rules do not give, by "p" and "f".
    """

    kind: str
    lemma: str
    gender: str
    classes: tuple[str, ...]
    irregular: dict[str, str]


class Adverb(NamedTuple):
    """A row of adverbs.tsv."""

    lemma: str
    kind: str


class Name(NamedTuple):
    """A row of names.tsv; `kind` is "m", "f", "surname", "country", "continent", "region" or "city"."""

    name: str
    kind: str


@cache
def nouns(folder: Path) -> tuple[Nominal, ...]:
    """The common nouns."""
    return tuple(
        _nominal("N", lemma, gender, _classes(classes, NOUN_CLASSES, place), forms, place)
        for place, (lemma, gender, classes, forms) in _rows("nouns", 4, folder)
    )


@cache
def adjectives(folder: Path) -> tuple[Nominal, ...]:
    """The common adjectives."""
    found: list[Nominal] = []
    for place, (lemma, gender, classes, use, forms) in _rows("adjectives", 5, folder):
        _known(use, _USES, place)
        known = _classes(classes, ADJECTIVE_CLASSES, place)
        found.append(_nominal("A", lemma, gender, known, forms, place))
    return tuple(found)


@cache
def adverbs(folder: Path) -> tuple[Adverb, ...]:
    """The common adverbs."""
    return tuple(
        Adverb(lemma, _known(kind, ADVERB_TAGS, place))
        for place, (lemma, kind) in _rows("adverbs", 2, folder)
    )


@cache
def verbs(folder: Path) -> tuple[str, ...]:
    """The infinitives of everyday use."""
    found: list[str] = []
    for place, (lemma, reflexive) in _rows("verbs", 2, folder):
        _known(reflexive, _REFLEXIVE, place)
        found.append(lemma)
    return tuple(found)


@cache
def names(folder: Path) -> tuple[Name, ...]:
    """Names of people and places."""
    return tuple(
        Name(name, _known(kind, NAME_TAGS, place)) for place, (name, kind) in _rows("names", 2, folder)
    )


def inflected_words(folder: Path, name: str, columns: int) -> Iterator[Inflected]:
    """The words of a list whose first column is the lemma and whose last has its irregular forms.

    Args:
        folder: The language's text folder.
        name: Of the list.
        columns: That it has.

    Raises:
        TranslationError: "invalid_data", with file and line.
    """
    for _, row in _rows(name, columns, folder):
        yield Inflected(row[0], _irregular(row[-1]))


def closed_class_forms(folder: Path) -> Iterator[Form]:
    """The forms of closed_classes.tsv, of equals the likeliest first."""
    for _, (form, lemma, tag) in _rows("closed_classes", 3, folder):
        yield Form(form.replace("_", " "), lemma, tag)


def preferences(folder: Path) -> dict[str, tuple[str, ...]]:
    """For forms whose usual order of readings is not the likeliest: lemmas and tag classes in their order."""
    return {form: tuple(order.split()) for _, (form, order) in _rows("preferences", 2, folder)}


def nominal_forms(word: Nominal) -> Iterator[Form]:
    """All forms of a noun or adjective."""
    tag = f"{word.kind}:{_GENDERS[word.gender]}"
    if word.gender in ("mp", "fp"):
        yield Form(word.lemma, word.lemma, tag + "p")
    elif word.gender == "inv":
        yield Form(word.lemma, word.lemma, tag + "n")
    else:
        yield from _numbers(word.lemma, word.lemma, tag, word.irregular.get("p"))
    if word.gender == "m+f":
        yield from _numbers(
            word.irregular.get("f") or feminine(word.lemma), word.lemma, f"{word.kind}:f", None
        )


def _numbers(singular: str, lemma: str, tag: str, irregular: str | None) -> Iterator[Form]:
    several = irregular or plural(singular)
    if several == singular or (irregular is None and is_invariable(singular)):
        yield Form(singular, lemma, tag + "n")
    else:
        yield Form(singular, lemma, tag + "s")
        yield Form(several, lemma, tag + "p")


def _rows(name: str, columns: int, folder: Path) -> Iterator[tuple[str, list[str]]]:
    """The rows of a list, each with its place for messages."""
    path = folder / "lexicon" / f"{name}.tsv"
    for number, row in read_rows(path, columns):
        yield f"{path}, line {number}", row


def _nominal(kind: str, lemma: str, gender: str, classes: tuple[str, ...], forms: str, place: str) -> Nominal:
    return Nominal(kind, lemma, _known(gender, _GENDERS, place), classes, _irregular(forms))


def _irregular(column: str) -> dict[str, str]:
    """Forms written as `p=menús f=reina`; `-` is none."""
    return dict(part.split("=", 1) for part in column.split() if "=" in part)


def _classes(column: str, known: Iterable[str], place: str) -> tuple[str, ...]:
    return tuple(_known(name, known, place) for name in column.split(","))


def _known(value: str, known: Iterable[str], place: str) -> str:
    if value not in known:
        raise TranslationError("invalid_data", f"{place}: expected one of {', '.join(known)}, got {value!r}")
    return value


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


def listed_entries(folder: Path, nominal: Iterable[Entry]) -> Iterator[Entry]:
    """The entries of a language's lists.

    Args:
        folder: The language's text folder.
        nominal: Those of its nouns, adjectives and, where they are listed, verbs.
    """
    for adverb in adverbs(folder):
        tag = ADVERB_TAGS[adverb.kind]
        late = adverb.kind in ("manner", "degree", "sentence")
        written = adverb.lemma.replace("_", " ")
        yield Entry(Form(written, adverb.lemma, tag), LATE_ADVERB if late else ADVERB)
    yield from nominal
    for name in names(folder):
        yield Entry(Form(name.name.replace("_", " "), name.name, NAME_TAGS[name.kind]), NAME)
    # Last: of the forms of a lemma and tag the first is the one that is written, and here is gran for grande.
    for form in closed_class_forms(folder):
        yield Entry(form, CLOSED)
