# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Who does it, where only somebody else is named: "llamó a su madre", "vive con sus padres".

Spanish leaves a third person out and marks by a preposition whom he acts upon or is with. LSE has no such
mark, and who is named would be taken to do it: MADRE SU LLAMAR is what she does. Several who are left out
("despidieron a Ana") are nobody in particular: no known answer of seven signs ELLOS.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from teo_sign_translator.pipeline.completeness import CompleteTranslation, read_gloss
from teo_sign_translator.pipeline.pipeline_words import PipelineWords
from teo_sign_translator.pipeline.topic import Topics, behind_preposition
from teo_sign_translator.text.source_word import CLITICS, SourceWord

_FINITE = ("V:ind", "V:sub", "V:cond", "V:imp")
#: Of a verb that says by its form alone that it is neither the signer nor the addressee who does it.
_OTHERS = re.compile(r"V:ind:(?!impf).*:3s")
#: Of a verb that may ask the addressee, too, unless there is something of a third person's.
_ASKING = "V:ind:pres:3s"
_HIS = "DET:poss:3"
#: What may stand between a verb that helps and the one that says what is done.
_DONE = ("V:inf", "V:ger", "V:part")
#: What a clause opens with, and what names somebody.
_OPENING = ("MARK", "CONJ", "PRON:rel", "WH")
_NAMES = ("N:", "NAME")


class Doers:
    """Reads who does what is done to or with somebody."""

    def __init__(self, language: PipelineWords, topics: Topics) -> None:
        """Take how a language points at persons, and who may do things."""
        self._who = language.subjects.pointing.get("3s", "")
        self._persons = {*language.subjects.pointing.values(), *topics.subjects}
        self._deeds = language.subjects.deeds
        self._done_by_nobody = (
            language.completeness.of_things
            | language.subjects.impersonal
            | language.persons.experiencer_verbs
        )
        self._towards, self._beside = language.persons.towards, language.subjects.beside
        self._topics = topics

    def read(self, words: Sequence[SourceWord], said: CompleteTranslation) -> CompleteTranslation:
        """A translation in which who does it is pointed at before whom it is done to or with.

        Args:
            words: Of the sentence.
            said: A translation of it.
        """
        verb = next((at for at, word in enumerate(words) if word.tag.startswith(_FINITE)), 0)
        opened = any(word.tag.startswith(_OPENING) for word in words[:verb])
        if opened or words[-1].form == "?" or not _OTHERS.fullmatch(words[verb].tag):
            return said
        stop = next((at for at in range(verb, len(words)) if words[at].tag.startswith(_OPENING)), len(words))
        if self._asks(words, verb) or any(self._may_do_it(words, at, verb) for at in range(stop)):
            return said
        others = {at for at in range(verb + 1, stop) if self._is_acted_on(words, at, verb)}
        place = next((at for at, gloss in enumerate(said.glosses) if others & {*gloss.sources}), -1)
        if place < 0 or any(gloss.gloss in self._persons for gloss in said.glosses):
            return said
        while place > 0 and any(others & {at, at + 1, at + 2} for at in said.glosses[place - 1].sources):
            place -= 1  # "ese hombre"
        return said.with_glosses(place, read_gloss(self._who, verb))

    def _asks(self, words: Sequence[SourceWord], verb: int) -> bool:
        """Whether it may ask for something, "llama al médico", or say what one can, "se puede"."""
        one_can = words[verb - 1].tag.startswith("PRON:refl") and words[verb + 1].tag == "V:inf"
        asks = verb == 0 and words[0].tag == _ASKING and not words[1].tag.startswith(_DONE)
        return one_can or (asks and not any(word.tag.startswith(_HIS) for word in words))

    def _may_do_it(self, words: Sequence[SourceWord], place: int, verb: int) -> bool:
        """Whether a word may name who does it: behind the verb of a deed somebody, else anything."""
        word = words[place]
        if word.tag.startswith(CLITICS) or behind_preposition(words, place):
            return False
        if word.tag.startswith(("PRON", "A:")) and place < verb:
            return True
        is_deed = words[verb].readings[0].lemma in self._deeds
        return self._topics.may_act(words, place) and (
            place < verb or not is_deed or self._topics.may_do(word)
        )

    def _is_acted_on(self, words: Sequence[SourceWord], place: int, verb: int) -> bool:
        """Whether a word names somebody whom what is done is done to, or with."""
        word = words[place]
        if not word.tag.startswith(_NAMES) or not self._topics.may_do(word):
            return False
        preposition = next(
            (each.form for each in reversed(words[verb:place]) if each.tag.startswith("PREP")), ""
        )
        done = {each.readings[0].lemma for each in words[verb:place] if each.tag.startswith(("V:ind", *_DONE))}
        if preposition in self._beside:
            return done.isdisjoint(self._done_by_nobody)
        return preposition in self._towards and not done.isdisjoint(self._deeds)
