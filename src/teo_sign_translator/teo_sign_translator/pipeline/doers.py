# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Who does it, where only somebody else is named: "llamó a su madre", "vive con sus padres".

Spanish leaves a third person out and marks by a preposition whom he acts upon or is with. LSE has no such
mark, and who is named would be taken to do it: MADRE SU LLAMAR is what she does. Several who are left out
("despidieron a Ana") are nobody in particular: no known answer of seven signs ELLOS.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence

from teo_sign_translator.pipeline.completeness import CompleteTranslation, read_gloss
from teo_sign_translator.pipeline.pipeline_words import PipelineWords
from teo_sign_translator.pipeline.topic import Topics, behind_preposition, preposition_before
from teo_sign_translator.text.source_word import (
    BEFORE_VERBS,
    CLITICS,
    COMPANIONS,
    FINITE,
    NOUNS,
    OBJECT,
    OPENING,
    THIRD_ALONE,
    SourceWord,
    clause_end,
    opens_clause,
)

#: Of a verb that may ask the addressee, too, unless there is something of a third person's.
_ASKING = "V:ind:pres:3s"
_HIS = "DET:poss:3"
#: What may stand between a verb that helps and the one that says what is done.
_DONE = ("V:inf", "V:ger", "V:part")
#: Of what the signer does, and of what is done next.
_SIGNERS = re.compile(r"V:(ind|sub|cond).*:1[sp]")
_NEXT = re.compile(r"V:ind:(?!impf).*:(3[sp])")
_THIRD = f"{OBJECT}3"
_JOINING = ("MARK", "CONJ")
_PLACE = "NAME:place"
#: Of what the addressee is asked to do, or not to do.
_ORDER = "V:imp:2s"
_DENIED_ORDER = "V:sub:pres:2s"


class Doers:
    """Reads who does what is done to or with somebody."""

    def __init__(self, language: PipelineWords, topics: Topics) -> None:
        """Take how a language points at persons, and who may do things."""
        self._pointing = language.subjects.pointing
        self._who = self._pointing.get("3s", "")
        self._asked = self._pointing.get("2s", "")
        self._persons = {*self._pointing.values(), *topics.subjects}
        self._deeds = language.subjects.deeds
        self._done_by_nobody = language.of_nobody
        objects = language.persons.objects.items()
        self._thirds = language.persons.things | {form for form, person in objects if person == "3"}
        self._towards, self._beside = language.persons.towards, language.subjects.beside
        self._topics = topics

    def read(self, words: Sequence[SourceWord], said: CompleteTranslation) -> CompleteTranslation:
        """A translation in which who does it is pointed at before whom it is done to or with.

        Args:
            words: Of the sentence.
            said: A translation of it.
        """
        return self._with_next(words, self._with_asked(words, self._with_first(words, said)))

    def _with_asked(self, words: Sequence[SourceWord], said: CompleteTranslation) -> CompleteTranslation:
        """The same with who is asked before whom he should do it to: "dile a Ana que venga"."""
        for verb, word in enumerate(words):
            denied = verb > 0 and words[verb - 1].tag.startswith(BEFORE_VERBS)
            asks = word.tag == _ORDER or (word.tag.startswith(_DENIED_ORDER) and denied)
            opened = any(each.tag.startswith(OPENING) for each in words[:verb])
            if not asks or (opened and not opens_clause(words, verb)):
                continue
            stop = clause_end(words, verb + 1)
            others = {at for at in range(verb + 1, stop) if self._is_asked_for(words, at, verb)}
            asked = read_gloss(self._asked, verb)
            own = [at for at, gloss in enumerate(said.glosses) if gloss.gloss == asked.gloss]
            named = (
                at for at, gloss in enumerate(said.glosses) if others & {*gloss.sources} and at not in own
            )
            place = next(named, -1)
            before = any(at < place for at in own)
            behind = [at for at in own if at > place and verb in said.glosses[at].sources]
            while place > 0 and min(said.glosses[place - 1].sources, default=-1) > verb:
                place -= 1
            if place >= 0 and asked.gloss and not before:
                return said.without(behind).with_glosses(place, asked)
        return said

    def _is_asked_for(self, words: Sequence[SourceWord], place: int, verb: int) -> bool:
        """Whether a word names somebody to whom what is asked for should be done."""
        return place > verb and self._is_somebody_behind(words, place, self._towards)

    def _with_next(self, words: Sequence[SourceWord], said: CompleteTranslation) -> CompleteTranslation:
        """The same with whom something is done to, where he does the next thing: "la llamé y no contestó"."""
        start, whom = 0, -1
        for opening, word in enumerate(words[:-1]):
            if not word.tag.startswith(_JOINING):
                continue
            if opening > start:  # else a comma and a conjunction part the same two clauses
                whom = self._done_to(words, start, opening)
            start = opening + 1
            verb = next((at for at in range(start, len(words)) if words[at].tag.startswith(FINITE)), -1)
            stop = clause_end(words, start)
            person = _NEXT.fullmatch(words[verb].tag) if start <= verb < stop else None
            if person is None or whom < 0:
                continue
            is_noun = words[whom].tag.startswith(NOUNS)
            named = any(self._may_do_it(words, at, verb) for at in range(start, stop)) or (
                is_noun and any(word.tag.startswith("PRON:neg") for word in words[start:stop])
            )
            feels = any(word.tag.startswith("A:") for word in words[verb + 1 : verb + 3])  # "está enfadado"
            by_nobody = words[verb].readings[0].lemma in self._done_by_nobody and not feels
            own = [at for at, gloss in enumerate(said.glosses) if min(gloss.sources, default=-1) >= start]
            before = (gloss.gloss for gloss in said.glosses if gloss.sources == (whom,) and not is_noun)
            who = next(before, self._pointing.get(person[1], ""))
            pointed = any(said.glosses[at].gloss in (self._who, who) for at in own)
            if who and own and not named and not by_nobody and not pointed:
                return said.with_glosses(own[0], read_gloss(who, verb))
        return said

    def _done_to(self, words: Sequence[SourceWord], start: int, stop: int) -> int:
        """Where whom the signer does something to or with in a clause is named; -1 if nobody is."""
        if not any(_SIGNERS.fullmatch(word.tag) for word in words[start:stop]):
            return -1
        for at in range(start, stop):
            pronoun = any(each.tag.startswith(_THIRD) for each in words[at].readings)
            if pronoun and words[at + 1].tag.startswith(FINITE):  # "la" is an article elsewhere
                return at
            if not self._thirds.isdisjoint(words[at].readings[0].clitics):
                return at
        beside = self._towards | self._beside
        return next((at for at in range(start, stop) if self._is_somebody_behind(words, at, beside)), -1)

    def _is_somebody_behind(
        self, words: Sequence[SourceWord], place: int, prepositions: Collection[str]
    ) -> bool:
        """Whether a word names somebody, and one of some prepositions stands before the name."""
        word, before = words[place], preposition_before(words, place)
        named = word.tag.startswith(NOUNS) and word.tag != _PLACE and self._topics.may_do(word)
        return named and before >= 0 and words[before].form in prepositions

    def _with_first(self, words: Sequence[SourceWord], said: CompleteTranslation) -> CompleteTranslation:
        """The same with who is left out of the first clause."""
        verb = next((at for at, word in enumerate(words) if word.tag.startswith(FINITE)), 0)
        opened = any(word.tag.startswith(OPENING) for word in words[:verb])
        if opened or words[-1].form == "?" or not THIRD_ALONE.fullmatch(words[verb].tag):
            return said
        stop = clause_end(words, verb)
        named = any(self._may_do_it(words, at, verb) for at in range(stop))
        if stop == verb + 1 or named or self._asks(words, verb):
            return said
        names = [at for at in range(verb + 1, stop) if self._is_acted_on(words, at, verb)]
        # Each with what belongs to it: "a ese hombre".
        others = {each for at in names for each in range(preposition_before(words, at) + 1, at + 1)}
        place = next((at for at, gloss in enumerate(said.glosses) if others & {*gloss.sources}), -1)
        pointed = (gloss for gloss in said.glosses if gloss.gloss in self._persons)
        if place < 0 or not all(others & {*gloss.sources} for gloss in pointed):
            return said
        return said.with_glosses(place, read_gloss(self._who, verb))

    def _asks(self, words: Sequence[SourceWord], verb: int) -> bool:
        """Whether it may ask for something, "llama al médico", or say what one can, "se puede"."""
        following = words[verb + 1].tag
        one_can = words[verb - 1].tag.startswith("PRON:refl") and following == "V:inf"
        asks = verb == 0 and words[0].tag == _ASKING and not following.startswith((*_DONE, "A:"))
        return one_can or (asks and not any(word.tag.startswith(_HIS) for word in words))

    def _may_do_it(self, words: Sequence[SourceWord], place: int, verb: int) -> bool:
        """Whether a word may name who does it: behind the verb of a deed somebody, else anything."""
        word = words[place]
        if word.tag.startswith((*CLITICS, *COMPANIONS)) or behind_preposition(words, place):
            return False
        if word.tag.startswith(("PRON", "A:")) and place < verb:
            return True
        is_deed = words[verb].readings[0].lemma in self._deeds
        return self._topics.may_act(words, place) and (
            place < verb or not is_deed or self._topics.may_do(word)
        )

    def _is_acted_on(self, words: Sequence[SourceWord], place: int, verb: int) -> bool:
        """Whether a word names somebody whom what is done is done to, or with."""
        happens = [each for each in words[verb:place] if each.tag.startswith((*_DONE, "A:"))] or [words[verb]]
        done = {each.readings[0].lemma for each in (words[verb], *happens)}
        by_somebody = happens[-1].readings[0].lemma not in self._done_by_nobody
        beside = self._is_somebody_behind(words, place, self._beside)
        if beside or words[place].tag.startswith(COMPANIONS):
            return by_somebody
        return self._is_somebody_behind(words, place, self._towards) and not done.isdisjoint(self._deeds)
