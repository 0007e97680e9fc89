# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which sign, which signs together, or which letters a gloss is shown by, and the lists that say it."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, field, replace
from enum import IntEnum
from itertools import pairwise
from pathlib import Path

from teo_sign_translator.data_files import data_file, invalid_line, read_lines, read_rows
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.morphology import Morphology
from teo_sign_translator.output.output_words import OutputWord, Spelling, spelled
from teo_sign_translator.output.translation import Kind, Origin

#: What a look-up table can name: Spanish letters, `_` for spaces, as long as a message holds.
SIGN_NAME = re.compile(r"[A-ZÁÉÍÓÚÜÑ_]{1,64}")


class Substitutes(IntEnum):
    """How far from a gloss without a sign what is signed may be; each allows those before it too."""

    #: The sign of the gloss or of its dictionary form, else letters.
    NONE = 0
    #: The same sign under another name.
    SYNONYM = 1
    #: A general sign and one that narrows it.
    PARAPHRASE = 2

    @classmethod
    def named(cls, name: str) -> Substitutes:
        """The value of a name in lower case.

        Raises:
            TranslationError: "unknown_substitutes".
        """
        try:
            return cls[name.upper()]
        except KeyError:
            known = ", ".join(each.name.lower() for each in cls)
            raise TranslationError("unknown_substitutes", f"expected one of {known}, got {name!r}") from None


@dataclass(frozen=True, slots=True)
class SubstituteLists:
    """The lists of the package's data.

    Attributes:
        synonyms: For each gloss others that the same sign is known by, in the order of the lists.
        paraphrases: For each gloss the rows of glosses that say it together, the best first.
    """

    synonyms: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    paraphrases: Mapping[str, tuple[tuple[str, ...], ...]] = field(default_factory=dict)

    @classmethod
    def load(cls, folder: Path | None = None) -> SubstituteLists:
        """Read `synonyms.tsv`, `word_families.tsv` and `paraphrases.tsv`.

        Args:
            folder: The language's text folder; by default that of the default language.

        Raises:
            TranslationError: "invalid_data", with file and line.
        """
        folder = folder or data_file("")
        own = read_synonyms(folder / "synonyms.tsv")
        families = read_synonyms(folder / "word_families.tsv")
        synonyms: dict[str, tuple[str, ...]] = {}
        for gloss in {*own, *families}:
            near = [*own.get(gloss, ()), *families.get(gloss, ())]
            far = [other for each in near for other in (*own.get(each, ()), *families.get(each, ()))]
            synonyms[gloss] = tuple(other for other in dict.fromkeys([*near, *far]) if other != gloss)
        return cls(synonyms, read_paraphrases(folder / "paraphrases.tsv"))


def read_synonyms(path: Path) -> dict[str, tuple[str, ...]]:
    """For each gloss the others that mean the same, in the order of the file, which has a line a group.

    Raises:
        TranslationError: "invalid_data", with file and line.
    """
    synonyms: dict[str, tuple[str, ...]] = {}
    for line_number, line in read_lines(path):
        group = [gloss.strip() for gloss in line.split(",")]
        valid = all(SIGN_NAME.fullmatch(gloss) and gloss not in synonyms for gloss in group)
        if len(group) < 2 or len({*group}) < len(group) or not valid:
            raise invalid_line(path, line_number, "two or more glosses, each listed once", f"'{line}'")
        for gloss in group:
            synonyms[gloss] = tuple(other for other in group if other != gloss)
    return synonyms


def read_paraphrases(path: Path) -> dict[str, tuple[tuple[str, ...], ...]]:
    """For each gloss the rows of glosses that say it together, in the order of the file.

    Raises:
        TranslationError: "invalid_data", with file and line.
    """
    found: dict[str, tuple[tuple[str, ...], ...]] = {}
    for number, (gloss, said) in read_rows(path, columns=2):
        parts = tuple(said.split())
        known = found.get(gloss, ())
        if not all(map(SIGN_NAME.fullmatch, (gloss, *parts))) or gloss in parts or parts in known:
            expected = "a gloss and others, separated by blanks, that say it, each row once"
            raise invalid_line(path, number, expected, f"'{gloss}', '{said}'")
        found[gloss] = (*known, parts)
    return found


# Tags of forms that name the same thing as their dictionary form: the feminine, the participle.
_OF_ONE_WORD = re.compile(r"[NA]:fs|V:part:.*")

#: Where a language's text folder says which; the file explains its columns.
INCORPORATED_NUMBERS = "incorporated_numbers.tsv"

#: The gloss that is both, by the gloss and the number.
Incorporated = Mapping[tuple[str, str], str]


def read_incorporated(path: Path) -> Incorporated:
    """Which glosses take up which numbers.

    Raises:
        TranslationError: "invalid_data", with file and line.
    """
    found: dict[tuple[str, str], str] = {}
    for line, (gloss, number, both) in read_rows(path, columns=3):
        valid = SIGN_NAME.fullmatch(gloss) and number.isdecimal() and SIGN_NAME.fullmatch(both)
        if not valid or (gloss, number) in found:
            got = f"'{gloss}', '{number}', '{both}'"
            raise invalid_line(path, line, "a gloss, a number and the gloss of both, once", got)
        found[gloss, number] = both
    return found


def with_numbers_incorporated(
    output_words: Sequence[OutputWord],
    typed: Sequence[str],
    signs: Set[str] | None,
    incorporated: Incorporated,
) -> list[OutputWord]:
    """Output words, a gloss and the number that counts it as one where that has a sign.

    Two weeks are one sign in LSE, made with the hand of the number. Where the table lacks it, noun and number
    stay two signs.

    Args:
        output_words: Of one sentence.
        typed: Its words: in "dos veces por semana" no weeks are counted.
        signs: Glosses that have a sign; None if that is not known: then nothing is put together.
        incorporated: The glosses that are both.
    """
    result: list[OutputWord] = []
    for word in output_words:
        gloss = _together(result[-1], word, incorporated) if result else ""
        if signs is not None and gloss in signs and _side_by_side(result[-1].words, word.words, typed):
            before = result.pop()
            noun = before if before.kind is Kind.LEXICAL else word
            confidence = min(before.confidence, word.confidence)
            said = (*before.words, *(each for each in word.words if each not in before.words))
            result.append(replace(noun, signs=(gloss,), confidence=confidence, words=said))
        else:
            result.append(word)
    return result


def _side_by_side(first: Sequence[str], second: Sequence[str], typed: Sequence[str]) -> bool:
    """Whether words stand beside others in a sentence."""
    return any(
        (one in first and other in second) or (one in second and other in first)
        for one, other in pairwise(typed)
    )


def _together(first: OutputWord, second: OutputWord, incorporated: Incorporated) -> str:
    """The gloss that says both; empty if they are no noun and number that go together."""
    for noun, number in ((first, second), (second, first)):
        if (
            noun.kind is Kind.LEXICAL
            and number.kind is Kind.NUMBER
            and len(noun.signs) == len(number.signs) == 1
        ):
            both = incorporated.get((noun.signs[0], number.signs[0]), "")
            if both:
                return both
    return ""


class SignChooser:
    """Chooses signs: the gloss's own, the same one by another name, several together, letters."""

    def __init__(
        self,
        lists: SubstituteLists,
        morphology: Morphology | None,
        substitutes: Substitutes = Substitutes.PARAPHRASE,
        spelling: Spelling | None = None,
    ) -> None:
        """Take the ways from a gloss without a sign to one that has one.

        Args:
            lists: What may be signed in place of a gloss.
            morphology: Gives lemmas and participles; None if glosses are lemmas.
            substitutes: Which of the lists' steps are taken; the rest is spelled.
            spelling: Of the language; by default the default language's.
        """
        self._spelling = spelling
        self._lists = lists
        self._morphology = morphology
        self.substitutes = substitutes

    def choose(self, output_words: Iterable[OutputWord], signs: Set[str] | None) -> list[OutputWord]:
        """Make output words of what has signs, in the same order.

        Args:
            output_words: Glosses, letters, numbers, pauses.
            signs: Glosses that have a sign of their own. None if that is not known: then every gloss that
                could have one is kept, for the executor to look up, and names are spelled.
        """
        return [_shows(chosen, word) for word in output_words for chosen in self._choose(word, signs)]

    def _choose(self, output_word: OutputWord, signs: Set[str] | None) -> Sequence[OutputWord]:
        if output_word.kind is not Kind.LEXICAL or not output_word.signs:
            return [output_word]
        (gloss,) = output_word.signs
        if signs is None:
            keeps = not output_word.is_name and SIGN_NAME.fullmatch(gloss)
            return [output_word] if keeps else self._letters(output_word)
        if gloss in signs:
            return [output_word]
        if output_word.is_name:
            return self._letters(output_word)
        found = self._same_sign(gloss, signs)
        if found is not None:
            return [replace(output_word, signs=(found[0],), origin=found[1])]
        said = self._paraphrase(gloss, signs)
        if said:
            return [replace(output_word, signs=(part,), origin=Origin.PARAPHRASE) for part in said]
        parts = [part for part in gloss.split("_") if part]
        if len(parts) > 1:
            return [c for part in parts for c in self._choose(replace(output_word, signs=(part,)), signs)]
        return self._letters(output_word)

    def _same_sign(self, gloss: str, signs: Set[str]) -> tuple[str, Origin] | None:
        """A name of the same sign that the table has: the gloss, its lemma, a synonym."""
        if gloss in signs:
            return gloss, Origin.MODEL
        lemmas = self._lemmas(gloss)
        for other in lemmas:
            if other in signs:
                return other, Origin.LEMMA
        if self.substitutes >= Substitutes.SYNONYM:
            for other in self._synonyms((gloss, *lemmas)):
                if other in signs:
                    return other, Origin.SYNONYM
        return None

    def _synonyms(self, glosses: Sequence[str]) -> Iterator[str]:
        """Other names of a sign: those of the lists, then the participle of a verb (CANSAR: CANSADO).

        A participle that is a noun as well (PESCAR: PESCADO) is the noun's sign.
        """
        for gloss in glosses:
            yield from self._lists.synonyms.get(gloss, ())
        for gloss in glosses:
            if self._morphology is not None and gloss.endswith(("AR", "ER", "IR", "ÍR")):
                try:
                    participle = self._morphology.inflect(gloss.lower(), "V:part:ms")
                except TranslationError:  # no verb
                    continue
                readings = self._morphology.readings(participle)
                if not any(reading.tag.startswith("N") and reading.exact for reading in readings):
                    yield participle.upper()

    def _paraphrase(self, gloss: str, signs: Set[str]) -> tuple[str, ...]:
        """Signs that say a gloss together; none unless the table has all of them."""
        if self.substitutes < Substitutes.PARAPHRASE:
            return ()
        for known in (gloss, *self._lemmas(gloss), *self._lists.synonyms.get(gloss, ())):
            for row in self._lists.paraphrases.get(known, ()):
                found = [self._same_sign(part, signs) for part in row]
                said = tuple(each[0] for each in found if each is not None)
                if len(said) == len(row):
                    return said
        return ()

    def _lemmas(self, gloss: str) -> tuple[str, ...]:
        """Other glosses of the same word: AMIGO for AMIGA, ABRIR for ABIERTO.

        A gloss is a dictionary form: where it is also a form of another word (CUENTA of CONTAR, ALTA of ALTO,
        DEBERES of DEBER), it is not that word.
        """
        if self._morphology is None or "_" in gloss:
            return ()
        readings = [each for each in self._morphology.readings(gloss.lower()) if each.exact]
        if any(reading.lemma.upper() == gloss for reading in readings):
            return ()
        lemmas = (reading.lemma.upper() for reading in readings if _OF_ONE_WORD.fullmatch(reading.tag))
        return tuple(dict.fromkeys(lemmas))

    def _letters(self, output_word: OutputWord) -> list[OutputWord]:
        (gloss,) = output_word.signs
        return [
            each
            for part in gloss.split("_")
            for each in spelled(part, output_word.words, output_word.confidence, self._spelling)
        ]


def _shows(chosen: OutputWord, word: OutputWord) -> OutputWord:
    """What was chosen, with the gloss that it shows if that is another's and no name."""
    if word.kind is not Kind.LEXICAL or word.is_name or chosen.signs == word.signs:
        return chosen
    return replace(chosen, meant=word.signs[0])
