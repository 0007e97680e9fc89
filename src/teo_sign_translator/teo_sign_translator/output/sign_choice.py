# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which sign, which signs together, or which letters a gloss is shown by."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from dataclasses import replace
from pathlib import Path

from teo_common.text_folding import fold
from teo_sign_translator.data_files import invalid_line, read_rows
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.morphology import Morphology
from teo_sign_translator.output.output_words import OutputWord, Spelling, spelled
from teo_sign_translator.output.substitutes import SIGN_NAME, SubstituteLists, Substitutes
from teo_sign_translator.output.translation import Kind, Origin
from teo_sign_translator.text.reading import Clause, SentenceType, is_negated
from teo_sign_translator.text.rules import TextRules


def may_be_generalised(clauses: Sequence[Clause], kind: SentenceType, rules: TextRules) -> bool:
    """Whether any word of a sentence may give way to a more general one, and it stays true.

    "I have a dog" entails "I have an animal"; "I have no dog" does not entail "I have no animal". A word may
    be generalised where its place is upward monotone: not under negation, `sin`, `si` or a comparison, not
    among all of a kind or the only ones (`todos`, `solo`), not of a kind as such ("los perros ladran", "me
    gustan las rosas"), and not in what is asked or told to be done, which is neither true nor false. One such
    word anywhere in the sentence is enough: its scope is not determined.

    Args:
        clauses: Of the sentence.
        kind: Its type.
        rules: Of its language.
    """
    if kind is not SentenceType.STATEMENT or is_negated(clauses, rules):
        return False
    listed = rules.generality
    words = [fold(word.lower) for clause in clauses for word in clause.words]
    return not any(word in listed.strict or word.startswith(listed.of_kinds) for word in words)


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
    output_words: Sequence[OutputWord], signs: Set[str] | None, incorporated: Incorporated
) -> list[OutputWord]:
    """Output words, a gloss and the number beside it as one where that has a sign.

    Two weeks are one sign in LSE, made with the hand of the number. Where the table lacks it, noun and number
    stay two signs.

    Args:
        output_words: Of one sentence.
        signs: Glosses that have a sign; None if that is not known: then nothing is put together.
        incorporated: The glosses that are both.
    """
    result: list[OutputWord] = []
    for word in output_words:
        gloss = _together(result[-1], word, incorporated) if result else ""
        if signs is not None and gloss and gloss in signs:
            before = result.pop()
            noun = before if before.kind is Kind.LEXICAL else word
            confidence = min(before.confidence, word.confidence)
            said = (*before.words, *(each for each in word.words if each not in before.words))
            result.append(replace(noun, signs=(gloss,), confidence=confidence, words=said))
        else:
            result.append(word)
    return result


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
        substitutes: Substitutes = Substitutes.HYPERNYM,
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

    def choose(
        self,
        output_words: Iterable[OutputWord],
        signs: Set[str] | None,
        *,
        general: bool = False,
        blurred: Set[str] = frozenset(),
    ) -> list[OutputWord]:
        """Make output words of what has signs, in the same order.

        Args:
            output_words: Glosses, letters, numbers, pauses.
            signs: Glosses that have a sign of their own. None if that is not known: then every gloss that
                could have one is kept, for the executor to look up, and names are spelled.
            general: Whether the sentence stays true with something more general in a word's place.
            blurred: More general signs that are not used all the same: those of `blurred` of its text.
        """
        return [
            _shows(chosen, word)
            for word in output_words
            for chosen in self._choose(word, signs, blurred if general else None)
        ]

    def blurred(self, output_words: Iterable[OutputWord], signs: Set[str] | None) -> frozenset[str]:
        """More general signs by which two things of a text would become one.

        A wolf and three pigs that all become ANIMAL are nobody's story any more.

        Args:
            output_words: Of all sentences of the text.
            signs: Glosses that have a sign; see `choose`.
        """
        words = list(output_words)
        if signs is None:
            return frozenset()
        said = {word.signs[0] for word in words if word.kind is Kind.LEXICAL and word.signs}
        shown: defaultdict[str, set[str]] = defaultdict(set)
        for word in words:
            for chosen in self._choose(word, signs, frozenset()):
                if chosen.origin is Origin.HYPERNYM:
                    shown[chosen.signs[0]].add(word.signs[0])
        return frozenset(above for above, glosses in shown.items() if len(glosses) > 1 or above in said)

    def _choose(
        self, output_word: OutputWord, signs: Set[str] | None, blurred: Set[str] | None
    ) -> Sequence[OutputWord]:
        """What shows a word; `blurred` is None where nothing more general may."""
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
        above = None if blurred is None else self._hypernym(gloss, signs)
        if above is not None and blurred is not None and above not in blurred:
            return [replace(output_word, signs=(above,), origin=Origin.HYPERNYM)]
        parts = [part for part in gloss.split("_") if part]
        if len(parts) > 1:
            return [
                c for part in parts for c in self._choose(replace(output_word, signs=(part,)), signs, blurred)
            ]
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

    def _hypernym(self, gloss: str, signs: Set[str]) -> str | None:
        """The sign of the closest thing that is more general."""
        if self.substitutes < Substitutes.HYPERNYM:
            return None
        for known in (gloss, *self._lemmas(gloss), *self._lists.synonyms.get(gloss, ())):
            for above in self._lists.hypernyms.get(known, ()):
                found = self._same_sign(above, signs)
                if found is not None:
                    return found[0]
        return None

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
