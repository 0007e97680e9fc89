# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Who should do what the signer wishes or fears, where nobody is named: "espero que apruebe".

Left out, the signer would be taken to hope that he passes himself, which Spanish says with an infinitive
(disjoint reference; Nueva gramática de la lengua española, 2009, chapter 25).
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from teo_sign_translator.pipeline.completeness import CompleteTranslation, read_gloss
from teo_sign_translator.pipeline.pipeline_words import PipelineWords
from teo_sign_translator.pipeline.topic import Topics
from teo_sign_translator.text.source_word import CLITICS, OBJECT, SourceWord, between_marks

_WISHED = re.compile(r"V:sub:.*:(3[sp])")
#: What may stand between what joins a wish and its verb.
_BETWEEN = ("ADV", *CLITICS)
#: Of words that may name who does it.
_PERSONS = ("N:", "NAME", "PRON")
_SIGNERS = re.compile(r"V:.*:1[sp]")
_ANOTHERS = re.compile(r"V:.*:[23][sp]")
_SIGNER = "1s"
_FELT = f"{OBJECT}1"


class Wishes:
    """Reads who should do what is wished."""

    def __init__(self, language: PipelineWords, topics: Topics) -> None:
        """Take how a language joins clauses and points at persons, and who may do things."""
        self._who = language.subjects
        self._names = frozenset(language.subjects.pointing.values())
        self._done_by_nobody = language.of_nobody
        self._topics = topics

    def read(self, words: Sequence[SourceWord], said: CompleteTranslation) -> CompleteTranslation:
        """A translation in which whoever should do it is pointed at.

        Args:
            words: Of the sentence.
            said: A translation of it.
        """
        for verb, word in enumerate(words):
            person = _WISHED.fullmatch(word.tag)
            joiner = self._joiner(words, verb) if person else 0
            if person and joiner:
                said = self._with_others(words, said, verb, joiner, person[1])
            joiner = self._asked_of_signer(words, verb) if person and person[1] == "3s" else 0
            signer = self._who.pointing.get(_SIGNER, "")
            if joiner and not any(gloss.gloss == signer for gloss in said.glosses):
                said = self._with_others(words, said, verb, joiner, _SIGNER)
        return said

    def _joiner(self, words: Sequence[SourceWord], verb: int) -> int:
        """Place of what joins a wish of the signer's to its verb, if nobody is named in either; else 0."""
        joiner = self._joins(words, verb)
        if not joiner or words[verb].readings[0].lemma in self._done_by_nobody:
            return 0
        start, stop = between_marks(words, verb)
        main = [word.readings[0] for word in words[start:joiner]]
        feels = any(reading.tag.startswith(_FELT) for reading in main)
        acts = any(_SIGNERS.fullmatch(reading.tag) for reading in main)
        before_joiner = main[-1].tag if main else ""
        # "me da miedo que", but neither "un sitio que" nor "me llama para que".
        is_signers = feels if before_joiner.startswith("N:") else acts or (feels and before_joiner != "PREP")
        able = words[verb].readings[0].lemma == self._who.able
        is_own = able and any(reading.lemma in self._who.believing for reading in main)
        asked = feels and any(reading.lemma in self._who.asking for reading in main)  # "me dijo que viniera"
        named = asked or any(self._names_somebody(words[at]) for at in range(start, stop))
        return joiner if is_signers and not is_own and not named else 0

    def _asked_of_signer(self, words: Sequence[SourceWord], verb: int) -> int:
        """Place of what joins a wish of somebody else's to what the signer should do; else 0.

        "¿Qué quieres que haga?", "mi jefe quiere que trabaje": the wish names nobody, and who wishes is
        another than who should do it.
        """
        joiner = self._joins(words, verb)
        main = words[joiner - 1].readings[0] if joiner else None
        wants = main is not None and main.lemma in self._who.wanting and _ANOTHERS.fullmatch(main.tag)
        if not wants or not self._is_done(words, verb):
            return 0
        _, stop = between_marks(words, verb)
        clitics = any(word.tag.startswith(CLITICS) for word in words[joiner - 2 : joiner])
        named = clitics or any(self._names_somebody(words[at]) for at in range(joiner + 1, stop))
        return 0 if named else joiner

    def _joins(self, words: Sequence[SourceWord], verb: int) -> int:
        """Place of what joins a wish to its verb; 0 if nothing does."""
        before = (at for at in range(verb - 1, 0, -1) if not words[at].tag.startswith(_BETWEEN))
        joiner = next(before, 0)
        return joiner if words[joiner].form == self._who.joiner else 0

    def _is_done(self, words: Sequence[SourceWord], verb: int) -> bool:
        """Whether a verb is of what somebody does: "haga" at the end, but not in "haga sol"."""
        lemma = words[verb].readings[0].lemma
        is_last = all(word.is_mark for word in words[verb + 1 : verb + 2])
        return lemma not in self._done_by_nobody or (is_last and lemma in self._who.impersonal)

    def _names_somebody(self, word: SourceWord) -> bool:
        tag = word.tag
        return (
            tag.startswith(_PERSONS)
            and not tag.startswith((*CLITICS, "PRON:rel"))
            and self._topics.may_do(word)
        )

    def _with_others(
        self, words: Sequence[SourceWord], said: CompleteTranslation, verb: int, joiner: int, person: str
    ) -> CompleteTranslation:
        behind = [bool(gloss.sources) and min(gloss.sources) > joiner for gloss in said.glosses]
        place = next(
            (at for at, gloss in enumerate(said.glosses) if behind[at] and verb in gloss.sources), -1
        )
        while place > 0 and behind[place - 1]:
            place -= 1
        who = read_gloss(self._who.pointing[person], verb)
        clitic = words[verb - 1].tag.removeprefix(OBJECT)
        to_whom = self._who.pointing[clitic] if clitic in self._who.clitics.values() else ""
        own = [gloss for at, gloss in enumerate(said.glosses) if behind[at] and gloss.gloss in self._names]
        if place < 0 or any(gloss.gloss != to_whom or verb in gloss.sources for gloss in own):
            return said
        if own or not to_whom:
            return said.with_glosses(place, who)
        # One that no word says is this one, at another place.
        again = [at for at, gloss in enumerate(said.glosses) if not gloss.sources and gloss.gloss == to_whom]
        place -= sum(at < place for at in again)
        done_to = read_gloss(to_whom, verb - 1)
        return said.without(again).with_glosses(place, who, done_to)
