# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which form a sign takes that agrees: who acts on whom, or where it hurts, from the words of its clause.

The form is a token's inflection: "2>1" is from the addressee to the signer (`¿Me ayudas?`), "CABEZA" at the
head (`Me duele la cabeza`). It is empty where the clause does not say both persons, or says two places:
then the citation form is signed, which says less but nothing false.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from teo_sign_translator.data_files import invalid_line, read_rows
from teo_sign_translator.morphology import Reading
from teo_sign_translator.morphology.lexicon import nouns
from teo_sign_translator.pipeline.pipeline_words import PersonWords, PipelineWords
from teo_sign_translator.text.source_word import CLITICS, FINITE, SourceWord, between_marks

_DATIVE, _PERSON, _BODY = "dative", "person", "body"
_NONE = "-"

_ENDS = (".", "?", "!")
_OF_PEOPLE = frozenset({"person", "family", "profession"})


@dataclass(frozen=True, slots=True)
class _Rule:
    """How one sign agrees: its verb, with what, and the places of the body that it may be made at."""

    lemma: str
    kind: str
    places: frozenset[str]


class Agreement:
    """Finds inflections."""

    def __init__(self, rules: dict[str, _Rule], people: frozenset[str], said: PersonWords) -> None:
        """Take the signs that agree, by gloss, the nouns that name people, and how persons are said."""
        self._rules = rules
        self._people = people
        self._said = said

    @classmethod
    def load(cls, folder: Path) -> Agreement:
        """Read `agreement.tsv`, which explains its columns, and the nouns that name people of a text folder.

        Raises:
            TranslationError: "invalid_data", with file and line.
        """
        path = folder / "agreement.tsv"
        rules: dict[str, _Rule] = {}
        for number, (gloss, lemma, kind, places) in read_rows(path, columns=4):
            listed = frozenset(each.strip() for each in places.split(",")) - {_NONE}
            if gloss in rules or kind not in (_DATIVE, _PERSON, _BODY) or (kind == _BODY) != bool(listed):
                expected = "a gloss once, its verb, dative, person or body, and places for body alone"
                raise invalid_line(path, number, expected, f"'{gloss} {lemma} {kind} {places}'")
            rules[gloss] = _Rule(lemma, kind, listed)
        people = (noun.lemma for noun in nouns(folder) if not _OF_PEOPLE.isdisjoint(noun.classes))
        return cls(rules, frozenset(people) if rules else frozenset(), PipelineWords.load(folder).persons)

    def inflection(self, gloss: str, sources: Iterable[int], words: Sequence[SourceWord]) -> str:
        """The form that a gloss takes; empty for the citation form.

        Args:
            gloss: What is signed.
            sources: Places of the words that it stands for.
            words: Of the sentence.
        """
        rule = self._rules.get(gloss)
        if rule is None:
            return ""
        for place in sources:
            verbs = [reading for reading in words[place].readings if reading.lemma == rule.lemma]
            if verbs:
                start, stop = between_marks(words, place)
                ends = next((word.form for word in words[place:] if word.form in _ENDS), "")
                orders = place == start and ends != "?" and not _says_verb(words[:start])
                clause = _Clause(
                    words=words[start:stop],
                    verb=place - start,
                    readings=[reading for reading in verbs if reading.exact] or verbs,
                    people=self._people,
                    said=self._said,
                    asks=ends == "?",
                    opens=orders,
                )
                return clause.place(rule.places) if rule.kind == _BODY else clause.persons(rule.kind)
        return ""


def _names_person(reading: Reading, people: frozenset[str]) -> bool:
    if reading.tag.startswith("NAME"):
        return reading.tag != "NAME:place"
    return reading.tag.startswith("N:") and reading.lemma in people


def _says_verb(words: Sequence[SourceWord]) -> bool:
    """Whether a verb is among the words of the same sentence."""
    start = max((index + 1 for index, word in enumerate(words) if word.form in _ENDS), default=0)
    return any(word.tag.startswith(FINITE) for word in words[start:])


@dataclass(frozen=True, slots=True, kw_only=True)
class _Clause:
    """The words around a verb that agrees.

    Attributes:
        words: Of the clause, without marks.
        verb: Place of the verb.
        readings: Those of the verb's word that are this verb; where it may be typed right, only those.
        people: Nouns that name people.
        said: How persons are said.
        asks: Whether its sentence is a question.
        opens: Whether the verb opens a sentence that is no question.
    """

    words: Sequence[SourceWord]
    verb: int
    readings: Sequence[Reading]
    people: frozenset[str]
    said: PersonWords
    asks: bool
    opens: bool

    def place(self, places: frozenset[str]) -> str:
        """The one place of the body that the clause names; empty if it names none or several."""
        named = {
            reading.lemma.upper()
            for word in self.words
            for reading in word.readings
            if reading.tag.startswith("N:") and reading.lemma.upper() in places
        }
        return named.pop() if len(named) == 1 else ""

    def persons(self, kind: str) -> str:
        """Who acts on whom, e.g. "2>1"; empty if the clause does not say both."""
        finite = self._finite()
        receiver = self._object(finite, kind)
        giver = self._subject(finite, receiver)
        return f"{giver}>{receiver}" if giver and receiver and giver != receiver else ""

    def _finite(self) -> int | None:
        """Place of the verb that has a person: this one, or the last before it that governs it."""
        if any(reading.tag.startswith(FINITE) for reading in self.readings):
            return self.verb
        before = range(self.verb - 1, -1, -1)
        return next((place for place in before if self._finite_readings(place)), None)

    def _finite_readings(self, place: int) -> list[Reading]:
        if place == self.verb:
            return [reading for reading in self.readings if reading.tag.startswith(FINITE)]
        likeliest = self.words[place].readings[0]
        return [likeliest] if likeliest.tag.startswith(FINITE) else []

    def _clitics(self, finite: int | None) -> tuple[list[str], bool]:
        """Pronouns of the verb, and whether they stand before it."""
        at_end = [clitic for reading in self.readings for clitic in reading.clitics][:2]
        if at_end or finite is None:
            return at_end, False
        before: list[str] = []
        for place in range(finite - 1, -1, -1):
            word = self.words[place]
            if not any(reading.tag.startswith(CLITICS) for reading in word.readings):
                break
            before.insert(0, word.form)
        return before, bool(before)

    def _object(self, finite: int | None, kind: str) -> str:
        clitics, _ = self._clitics(finite)
        if self._experiences(finite) and not any(reading.clitics for reading in self.readings):
            clitics = []
        for clitic in clitics:
            if clitic in self.said.objects:
                return self.said.objects[clitic]
        if self.said.reflexive in clitics:  # se lo doy: to him
            return "3" if any(clitic in self.said.things for clitic in clitics) else ""
        if kind == _PERSON and any(clitic in self.said.things for clitic in clitics):
            return "3"
        return self._prepositional_object()

    def _prepositional_object(self) -> str:
        """Person behind "a": `ayudo a Ana`, `se lo doy a él`."""
        for place in range(self.verb + 1, len(self.words)):
            word = self.words[place]
            if not word.tag.startswith("PREP") or word.form not in self.said.towards:
                continue
            for word in self.words[place + 1 : place + 3]:
                tag = word.tag
                if tag.startswith("PRON:prep:"):
                    return tag.removeprefix("PRON:prep:")[0]
                if word.readings[0].lemma in self.said.subjects:
                    return self.said.subjects[word.readings[0].lemma]
                if tag.startswith(("NAME", "N:", "PRON:3")) and tag != "NAME:place":
                    return "3"
                if not tag.startswith("DET"):
                    break
        return ""

    def _experiences(self, finite: int | None) -> bool:
        return (
            finite is not None
            and finite != self.verb
            and any(reading.lemma in self.said.experiencer_verbs for reading in self._finite_readings(finite))
        )

    def _subject(self, finite: int | None, receiver: str) -> str:
        if finite is None:
            return ""
        if self._experiences(finite):
            before = self.words[finite - 1].form if finite else ""
            return self.said.objects.get(before, "")
        readings = self._finite_readings(finite)
        if self._orders(readings):
            return "2"
        if self._clitics(finite)[1]:  # a pronoun before it is never an imperative's
            readings = [reading for reading in readings if not reading.tag.startswith("V:imp")]
        persons = [self._person(reading) for reading in readings]
        said = {reading.lemma: reading for word in self.words for reading in word.readings[:1]}
        explicit = {
            self.said.subjects[lemma]
            for lemma in said
            if lemma in self.said.subjects and said[lemma].tag.startswith("PRON")
        }
        possible = [person for person in dict.fromkeys(persons) if person != receiver]
        for person in possible:
            if person in explicit:
                return person
        if "3" in possible and "2" in explicit and any(lemma in said for lemma in self.said.polite):
            return "2"
        if possible[:1] == ["3"] and receiver == "1" and self._asks_politely():
            return "2"
        return possible[0] if possible else ""

    @staticmethod
    def _person(reading: Reading) -> str:
        # The imperative of the third person is usted's.
        return "2" if reading.tag.startswith("V:imp") else reading.tag.rsplit(":", 1)[-1][0]

    def _orders(self, readings: Sequence[Reading]) -> bool:
        """Whether a verb that may be of the third person is an imperative: `Pregunta a tu padre`.

        It opens the sentence, and no third person is named who could do it: no person that does not stand
        behind "a", and no "su".
        """
        if not self.opens or not any(reading.tag == "V:ind:pres:3s" for reading in readings):
            return False
        if any(reading.lemma in self.said.own_imperatives for reading in readings):
            return False
        towards = False
        for word in self.words[self.verb + 1 :]:
            reading = word.readings[0]
            if reading.lemma == self.said.own_possessive or (
                reading.tag.startswith("PRON:3") and not towards
            ):
                return False
            if _names_person(reading, self.people):
                if not towards:
                    return False
                towards = False
            towards = towards or word.form in self.said.towards
        return True

    def _asks_politely(self) -> bool:
        """Whether `¿Me ayuda?` is asked of the addressee: a question that names no third person."""
        tags = [word.tag for word in self.words]
        return self.asks and not any(
            tag.startswith(("NAME", "PRON:3")) and tag != "NAME:place" for tag in tags
        )
