# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Who a text goes on about, so that he is not pointed at in each of its sentences and clauses.

Spanish says the subject in the verb's ending each time; signers leave out who is known from the sentence
before (in the LSE-RADIS narratives 55 of 330 sentences are a verb alone).
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from teo_sign_translator.morphology import gloss_name
from teo_sign_translator.morphology.lexicon import nouns
from teo_sign_translator.pipeline.pipeline_words import PipelineWords
from teo_sign_translator.pointer import OutputGloss
from teo_sign_translator.text.source_word import CLITICS, NOUNS, SourceWord

#: Classes of nouns that may do what a verb says, so that they could be taken for its subject.
_DOERS = frozenset({"person", "family", "profession", "animal", "group"})
_BEFORE_NOUNS = ("DET", "A:", "NUM")
_PERSONS = ("PRON", "NAME")
#: What stands between a verb and what opens its clause ("que no me gustó").
_BEFORE_VERBS = (*CLITICS, "DET:def", "ADV")


class Topics:
    """What a language needs to know of who does things."""

    def __init__(self, folder: Path) -> None:
        """Read a language's text folder.

        Raises:
            TranslationError: "invalid_data" naming file and field.
        """
        persons = PipelineWords.load(folder).persons
        #: Pronouns' glosses with the person that a verb's ending says for each.
        self.subjects = {gloss_name(word): person for word, person in persons.subjects.items()}
        #: That of an addressee of whom one speaks as of a third person; empty if the language has none.
        self.polite = next((gloss_name(word) for word in persons.subjects if word in persons.polite), "")
        self._doers = frozenset(noun.lemma for noun in nouns(folder) if not _DOERS.isdisjoint(noun.classes))
        self._times = frozenset(noun.lemma for noun in nouns(folder) if "time" in noun.classes)

    def may_do(self, word: SourceWord) -> bool:
        """Whether a word names or points at somebody."""
        return any(
            reading.tag.startswith(_PERSONS)
            or (reading.tag.startswith("N:") and reading.lemma in self._doers)
            for reading in word.readings
        )

    def is_time(self, word: SourceWord) -> bool:
        """Whether a word says when: "ayer", "el lunes"."""
        reading = word.readings[0]
        return reading.tag.startswith("ADV:time") or (
            reading.tag.startswith("N:") and reading.lemma in self._times
        )

    def may_act(self, words: Sequence[SourceWord], place: int) -> bool:
        """Whether a noun may be who does it: "el colegio", but neither "el lunes" nor "en el colegio"."""
        reading = words[place].readings[0]
        if not reading.tag.startswith(NOUNS) or reading.lemma in self._times:
            return False
        return not behind_preposition(words, place)

    def repeated(self, words: Sequence[SourceWord], glosses: Sequence[OutputGloss]) -> list[int]:
        """The places of subjects that a clause before in the same sentence has said already.

        "No salgo porque quiero dormir" is YO SALIR NO PORQUE QUERER DORMIR. Only a verb's ending says
        such a subject, and nobody else is named, pointed at or acted upon up to there. A clause that
        describes a thing ("el abrigo que compraste") keeps it.

        Args:
            words: Of the sentence.
            glosses: Its translation.
        """
        result: list[int] = []
        before = -1
        for place, gloss in enumerate(glosses):
            if gloss.gloss not in self.subjects or not gloss.sources:
                continue
            ending = self._by_ending(words, gloss)
            if before >= 0 and glosses[before].gloss == gloss.gloss and ending:
                verb = max(at for at, each in enumerate(glosses) if {*gloss.sources} & {*each.sources})
                others = (*glosses[before + 1 : place], *glosses[place + 1 : verb + 1])
                named = any(self.may_do(words[source]) for each in others for source in each.sources)
                acts_on = glosses[place + 1].gloss in self.subjects if place + 1 < len(glosses) else False
                if not named and not acts_on and not _in_relative_clause(words, min(gloss.sources)):
                    result.append(place)
            if ending or self._typed(words, gloss):
                before = place
        return result

    def _by_ending(self, words: Sequence[SourceWord], gloss: OutputGloss) -> bool:
        """Whether a verb's ending alone says a pronoun."""
        ending = f":{self.subjects[gloss.gloss]}"
        return all(
            any(reading.tag.startswith("V:") and ending in reading.tag for reading in words[source].readings)
            for source in gloss.sources
        )

    def _typed(self, words: Sequence[SourceWord], gloss: OutputGloss) -> bool:
        """Whether a word says a pronoun, as a subject."""
        lemmas = {reading.lemma for source in gloss.sources for reading in words[source].readings}
        return gloss.gloss in map(gloss_name, lemmas)


def behind_preposition(words: Sequence[SourceWord], place: int) -> bool:
    """Whether a preposition stands before a noun and what belongs to it."""
    return preposition_before(words, place) >= 0


def preposition_before(words: Sequence[SourceWord], place: int) -> int:
    """Place of the preposition before a noun and what belongs to it; -1 if none is."""
    before = (at for at in range(place - 1, -1, -1) if not words[at].tag.startswith(_BEFORE_NOUNS))
    at = next(before, -1)
    return at if at >= 0 and words[at].tag.startswith("PREP") else -1


def _in_relative_clause(words: Sequence[SourceWord], verb: int) -> bool:
    """Whether what opens a verb's clause may be a relative; "creo que" is taken for one too."""
    opening = [word for word in words[:verb] if not word.tag.startswith(_BEFORE_VERBS)]
    return bool(opening) and any(reading.tag == "PRON:rel" for reading in opening[-1].readings)


class Topic:
    """Whom the sentences of one text are about, as far as they have been read."""

    def __init__(self, topics: Topics) -> None:
        """Begin a text."""
        self._topics = topics
        self._subject = ""

    def unsaid(self, words: Sequence[SourceWord], glosses: Sequence[OutputGloss]) -> list[int]:
        """The place of the gloss that the sentence before has said already, none if it must be said again.

        It is the only person of both sentences, no one asks, and only the verb's ending says it here: who is
        typed ("yo pago") is meant to be seen.

        Args:
            words: Of the next sentence.
            glosses: Its translation.
        """
        before, self._subject = self._subject, ""
        said = [place for place, gloss in enumerate(glosses) if gloss.gloss in self._topics.subjects]
        typed = {place for place, word in enumerate(words) if self._topics.may_do(word)}
        if len(said) != 1 or any(word.form == "?" for word in words):
            return []
        subject = glosses[said[0]]
        if not typed.issubset(subject.sources):
            return []
        self._subject = subject.gloss
        return said if not typed and subject.gloss == before and len(glosses) > 1 else []
