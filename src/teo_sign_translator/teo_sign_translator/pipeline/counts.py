# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How many: an article that counts, and two numbers with what lies between them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from teo_sign_translator.pipeline.completeness import CompleteTranslation, read_gloss
from teo_sign_translator.pipeline.pipeline_words import PipelineWords
from teo_sign_translator.pointer.vocabulary import copied_gloss
from teo_sign_translator.text.source_word import SourceWord

#: Less than that is rather somebody than an age: "se lo di a los dos".
_LEAST_AGE = 5


class Counts:
    """Reads how many a language says."""

    def __init__(self, language: PipelineWords) -> None:
        """Take how a language counts and joins clauses."""
        self._said = language.counts
        self._joiner = language.subjects.joiner

    def read(self, words: Sequence[SourceWord], said: CompleteTranslation) -> CompleteTranslation:
        """A translation in which numbers are said that the model leaves out.

        Args:
            words: Of the sentence.
            said: A translation of it.
        """
        said = self._with_one(words, self._with_span(words, said))
        said = self._with_until(words, self._with_age(words, said))
        return self._with_how_many(words, self._with_past(words, said))

    def _with_until(self, words: Sequence[SourceWord], said: CompleteTranslation) -> CompleteTranslation:
        """The same with "until" before what is asked: "¿hasta qué hora abrís?"."""
        for place, (word, asks) in enumerate(pairwise(words)):
            behind = {place + 1, place + 2}
            at = next((at for at, each in enumerate(said.glosses) if behind & {*each.sources}), -1)
            until = any(gloss.gloss == self._said.until for gloss in said.glosses)
            if copied_gloss(word.readings[0]) == self._said.until and asks.tag.startswith("WH") and not until:
                return said.with_glosses(at, read_gloss(self._said.until, place)) if at >= 0 else said
        return said

    def _with_age(self, words: Sequence[SourceWord], said: CompleteTranslation) -> CompleteTranslation:
        """The same with "age" before a number of nothing: "se quedó viuda a los treinta"."""
        for place in range(2, len(words)):
            number = words[place].form
            before = (words[place - 2].form, words[place - 1].form)
            counted = place + 1 < len(words) and words[place + 1].tag.startswith(("N:", "A:"))
            if before != self._said.at_age or counted or not number.isdigit() or int(number) < _LEAST_AGE:
                continue
            at = next((at for at, gloss in enumerate(said.glosses) if gloss.gloss == number), -1)
            if at >= 0 and not any(gloss.gloss == self._said.age for gloss in said.glosses):
                return said.with_glosses(at, read_gloss(self._said.age, place - 1))
        return said

    def _with_past(self, words: Sequence[SourceWord], said: CompleteTranslation) -> CompleteTranslation:
        """The same with "past" before how long ago it was: "hace dos años que murió", no "que no fumo"."""
        joiner = next((at for at in range(3, len(words)) if words[at].form == self._joiner), 0)
        verb = next((word.tag for word in words[joiner:] if word.tag.startswith("V:")), "")
        ago = joiner > 0 and words[joiner - 3].form == self._said.ago and words[joiner - 2].tag == "NUM"
        told = any(gloss.gloss == self._said.past for gloss in said.glosses)
        at = next((at for at, gloss in enumerate(said.glosses) if joiner - 2 in gloss.sources), -1)
        if not ago or told or at < 0 or not verb.startswith("V:ind:pret"):
            return said
        return said.with_glosses(at, read_gloss(self._said.past, joiner - 3))

    def _with_how_many(self, words: Sequence[SourceWord], said: CompleteTranslation) -> CompleteTranslation:
        """The same with "how many" where nobody marvels: "pregunté cuánto costaba"."""
        if any(word.form == "!" for word in words):
            return said
        glosses = tuple(
            replace(gloss, gloss=self._said.how_many)
            if gloss.gloss == self._said.many and any(self._asks(words[at]) for at in gloss.sources)
            else gloss
            for gloss in said.glosses
        )
        return replace(said, glosses=glosses)

    def _asks(self, word: SourceWord) -> bool:
        """Whether a word asks how many."""
        reading = word.readings[0]
        return reading.tag.startswith("WH") and copied_gloss(reading) == self._said.how_many

    def _with_one(self, words: Sequence[SourceWord], said: CompleteTranslation) -> CompleteTranslation:
        """The same with "1" where an article counts: "una hora", "solo hay una mujer"."""
        for place, (word, noun) in enumerate(pairwise(words)):
            is_said = place > 0 and words[place - 1].readings[0].lemma == self._said.is_verb
            only = not is_said and any(before.form in self._said.only for before in words[:place])
            counts = only or noun.form in self._said.measures or _is_behind_number(words, place)
            if word.form not in self._said.one or not counts:
                continue
            own = [{*gloss.sources} for gloss in said.glosses]
            at = next((at for at, each in enumerate(own) if {place + 1} <= each <= {place, place + 1}), -1)
            counted = any(gloss.gloss[0].isdigit() and place in gloss.sources for gloss in said.glosses)
            if at >= 0 and not counted:
                return said.with_glosses(at, read_gloss("1", place))
        return said

    def _with_span(self, words: Sequence[SourceWord], said: CompleteTranslation) -> CompleteTranslation:
        """The same with "until" between two numbers of a span: "de nueve a dos" is no 9:02."""
        for place in range(3, len(words)):
            first, last = words[place - 2].tag, words[place].tag
            span = (words[place - 3].form, words[place - 1].form) == self._said.span
            to = next((at for at, gloss in enumerate(said.glosses) if gloss.sources == (place,)), 0)
            if span and first == last == "NUM" and to and place - 2 in said.glosses[to - 1].sources:
                return said.with_glosses(to, read_gloss(self._said.until, place - 1))
        return said


def _is_behind_number(words: Sequence[SourceWord], place: int) -> bool:
    """Whether others are counted before a word: "dos pizzas y una ensalada"."""
    before = [word.tag for word in words[max(0, place - 3) : place]]
    return before[:1] == ["NUM"] and before[-1].startswith("CONJ")
