# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Who does what a verb says whose form alone is "yo" and "él": "sea", "estaba", "iría".

"Quiero que sea feliz" never wishes the signer happy: a subjunctive that "que" joins to a verb has another
subject than that verb; with the same one it would be an infinitive (disjoint reference; Nueva gramática de
la lengua española, 2009, chapter 25). Where nobody is named anew, others have the subject of the clause
beside theirs: "aunque esté cansada, voy a salir", "si Ana viviera aquí, estaría contenta".
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace

from teo_sign_translator.morphology import Reading
from teo_sign_translator.pipeline.completeness import CompleteTranslation
from teo_sign_translator.pipeline.pipeline_words import PipelineWords
from teo_sign_translator.pipeline.topic import Topics, behind_preposition
from teo_sign_translator.pointer import OutputGloss
from teo_sign_translator.text.source_word import (
    CLITICS,
    FINITE,
    NOUNS,
    OBJECT,
    TELLING,
    THIRD_ALONE,
    SourceWord,
    between_marks,
    opens_clause,
)

#: Of words that say themselves who does it.
_WHOSE = (*FINITE, "PRON")
#: Before a person of the signer's, who may be meant by what stands beside it.
_POSSESSIVE = "DET:poss:1"
_MAIN = ("V:ind", "V:cond")
_SUBJUNCTIVE = re.compile(r"V:sub:.*:3s")
_AMBIGUOUS = re.compile(r"V:(sub|cond|ind:impf)\b.*:3s")
_SIGNERS = re.compile(r"(V|PRON)\b.*:1s")
#: Of what opens a clause in which nobody is asked for something, as in "llama a Ana".
_SUBORDINATING = ("WH", "PRON:rel")
_ASKING = re.compile(r"V:imp:2.*")
_COMMAND = re.compile(r"V:(sub:pres|imp):.*3s")


class Subjects:
    """Reads who does it."""

    def __init__(self, language: PipelineWords, topics: Topics) -> None:
        """Take how a language joins clauses and points at persons, and who may do things."""
        self._who = language.subjects
        self._signer = language.subjects.pointing.get("1s", "")
        self._addressee = language.subjects.pointing.get("2s", "")
        self._other = language.subjects.pointing.get("3s", "")
        self._experiencer_verbs = language.persons.experiencer_verbs
        self._of_nobody = language.completeness.of_things | language.subjects.impersonal
        self._topics = topics

    def read(self, words: Sequence[SourceWord], said: CompleteTranslation) -> CompleteTranslation:
        """A translation in which the signer and a third person are exchanged where the other one is meant.

        Args:
            words: Of the sentence.
            said: A translation of it.
        """
        said = _with_nobody_first(words, said, self._who.pointing.values())
        glosses: list[OutputGloss] = []
        put_back: list[bool] = []
        left: tuple[int, ...] = ()
        for place, (gloss, back) in enumerate(zip(said.glosses, said.put_back, strict=True)):
            own = replace(gloss, sources=tuple(sorted({*gloss.sources, *left}))) if left else gloss
            meant = list(self._meant(words, own, said.glosses))
            is_last = place + 1 == len(said.glosses)
            left = () if meant or is_last else own.sources
            meant = meant or [own] * is_last
            glosses += meant
            put_back += [back] * len(meant)
        return replace(said, glosses=tuple(glosses), put_back=tuple(put_back))

    def _meant(
        self, words: Sequence[SourceWord], gloss: OutputGloss, every: Sequence[OutputGloss]
    ) -> Iterator[OutputGloss]:
        """Whom a gloss should point at; nobody where he is named already; who acts and to whom it happens."""
        asked = all(_says(words[place].readings[:1], _ASKING) for place in gloss.sources)
        if gloss.gloss == self._signer and gloss.sources and asked and not self._is_addressed(gloss, every):
            return  # "mándame": the sign's direction says to whom, and the signer does nothing
        if self._is_another(words, gloss):
            yield replace(gloss, gloss=self._other)
            return
        verb = self._verb(words, gloss)
        if verb < 0 or gloss.gloss not in (self._signer, self._other):
            yield gloss
        elif _commands(words, verb) and (gloss.gloss == self._other or words[-1].is_mark):
            return  # "olvide la cita", typed in haste, is "olvidé"
        elif gloss.gloss == self._other:
            is_named = any(self._topics.may_do(words[place]) for place in gloss.sources)
            conceded = not is_named and self._opens(words, verb) in self._who.concessives
            own = (conceded and _has_signers_verb(words)) or (not is_named and self._is_doubted(words, verb))
            yield replace(gloss, gloss=self._signer) if own else gloss
        elif self._is_wished(words, verb):
            if not any(each.gloss == self._other and verb in each.sources for each in every):
                yield replace(gloss, gloss=self._other, sources=(verb,))
            if words[verb - 1].form == self._who.object:
                yield replace(gloss, sources=(verb - 1,))
        elif self._is_beside(words, verb, THIRD_ALONE) or self._is_beside_named(words, verb):
            yield replace(gloss, gloss=self._other)
        elif self._is_beside(words, verb, _COMMAND):
            return
        elif not self._is_named(words, gloss.sources, verb):
            yield gloss

    def _is_another(self, words: Sequence[SourceWord], gloss: OutputGloss) -> bool:
        """Whether a gloss points at the addressee for a verb of a third person: "a qué hora viene"."""
        verbs = [place for place in gloss.sources if not words[place].tag.startswith("DET")]
        if gloss.gloss != self._addressee or not verbs:
            return False
        start, _ = between_marks(words, verbs[0])
        asked = any(word.tag.startswith(_SUBORDINATING) for word in words[start : verbs[0]])
        return asked and all(THIRD_ALONE.fullmatch(words[place].tag) for place in verbs)

    def _verb(self, words: Sequence[SourceWord], gloss: OutputGloss) -> int:
        """Place of the verb that a person does, if its form alone is "yo" and "él"; -1 if it says who."""
        own = next((place for place in gloss.sources if _says(words[place].readings, _AMBIGUOUS)), -1)
        if (
            own >= 0
            or not gloss.sources
            or any(words[place].tag.startswith(_WHOSE) for place in gloss.sources)
        ):
            return own
        for place in range(gloss.sources[0] - 1, -1, -1):  # of what a noun or an adjective is said
            if words[place].is_mark:
                return -1
            if words[place].tag.startswith(TELLING):
                return place if _says(words[place].readings[:1], _AMBIGUOUS) else -1
        return -1

    def _is_addressed(self, asking: OutputGloss, every: Sequence[OutputGloss]) -> bool:
        """Whether who is asked is pointed at, too: TÚ YO DAR."""
        subjects = self._topics.subjects.keys() - {asking.gloss}
        return any(gloss.gloss in subjects and {*gloss.sources} & {*asking.sources} for gloss in every)

    def _is_beside(self, words: Sequence[SourceWord], verb: int, another: re.Pattern[str]) -> bool:
        """Whether a clause like "cuando llegue" stands beside a verb that is not the signer's."""
        if not self._opens(words, verb) or _names_signer(words, verb):
            return False
        return any(
            another.fullmatch(word.tag) and word.readings[0].lemma not in self._of_nobody
            for place, word in enumerate(words)
            if place != verb and not self._opens(words, place)
        )

    def _is_beside_named(self, words: Sequence[SourceWord], verb: int) -> bool:
        """Whether it stands beside what somebody does by name: "aunque estuviera triste, Ana sonreía"."""
        possessed = any(word.tag.startswith(_POSSESSIVE) for word in words)
        if not self._opens(words, verb) or possessed or _names_signer(words, verb):
            return False
        _, mark = between_marks(words, verb)
        done = (at for at in range(mark, len(words)) if _says(words[at].readings[:1], _AMBIGUOUS))
        return any(self._is_said_of(words, at, mark) for at in done)

    def _is_named(self, words: Sequence[SourceWord], sources: Sequence[int], verb: int) -> bool:
        """Whether the subject is who is named in the clause that this one belongs to."""
        opening = self._opens(words, verb)
        if opening and verb in sources:
            start = max(place for place in range(verb) if words[place].form == opening)
            return self._is_said_of(words, verb, start)
        if _says(words[verb].readings[:1], _SUBJUNCTIVE) or _says_signer(words, sources):
            return False
        governor = self._governor(words, verb)
        if governor >= 0:
            return words[governor].tag.endswith(":3s") and not _has_signers_verb(words)
        if opening or (verb in sources and _names_signer(words, verb)):
            return False
        return self._is_said_of(words, verb)

    def _is_said_of(self, words: Sequence[SourceWord], verb: int, start: int = 0) -> bool:
        """Whether who is named does what a verb, or one before it, says: "Ana fue, pero odiaba ir"."""
        for place in range(start, verb):
            if not self._names(words[place]) or behind_preposition(words, place):
                continue
            behind = next((word for word in words[place + 1 :] if word.tag.startswith(TELLING)), None)
            if behind is not None and behind.tag.endswith(":3s"):
                return True
        return False

    def _names(self, word: SourceWord) -> bool:
        """Whether a word names somebody, by what it is most likely."""
        return word.tag.startswith(NOUNS) and self._topics.may_do(word)

    def _opens(self, words: Sequence[SourceWord], place: int) -> str:
        """The word that opens a clause in which something is done when, if or although; empty for none."""
        for word in reversed(words[:place]):
            if word.is_mark or word.tag.startswith(_MAIN):
                return ""
            if word.form in self._who.adjuncts or word.form in self._who.concessives:
                return word.form
        return ""

    def _governor(self, words: Sequence[SourceWord], verb: int) -> int:
        """The verb whose clause another one's is, joined to it and with nothing between but adverbs; -1."""
        joiner = next((place for place in range(verb - 1, 0, -1) if words[place].form == self._who.joiner), 0)
        between = words[joiner + 1 : verb]
        if not joiner or any(word.is_mark or word.tag.startswith(_MAIN) for word in between):
            return -1
        if any(self._topics.may_do(word) and not word.tag.startswith(CLITICS) for word in between):
            return -1
        main = joiner - 2 if words[joiner - 1].form == self._who.link else joiner - 1
        return main if main >= 0 and words[main].tag.startswith((*_MAIN, "V:part")) else -1

    def _is_doubted(self, words: Sequence[SourceWord], verb: int) -> bool:
        """Whether the signer doubts what he is able to do himself: "no creo que pueda ir"."""
        main = self._governor(words, verb)
        if main < 0 or words[verb].readings[0].lemma != self._who.able:
            return False
        return words[main].readings[0].lemma in self._who.believing and words[main].tag.endswith(":1s")

    def _is_wished(self, words: Sequence[SourceWord], verb: int) -> bool:
        """Whether a subjunctive stands alone behind a joiner, and a verb of the signer's governs it."""
        main = self._governor(words, verb)
        if main < 0 or not _says(words[verb].readings, _SUBJUNCTIVE) or self._is_doubted(words, verb):
            return False
        reading = words[main].readings[0]
        feels = main > 0 and words[main - 1].form == self._who.object
        return reading.tag.endswith(":1s") or (
            feels and reading.tag.endswith(":3s") and reading.lemma in self._experiencer_verbs
        )


def _with_nobody_first(
    words: Sequence[SourceWord], said: CompleteTranslation, persons: Collection[str]
) -> CompleteTranslation:
    """The same with nobody, as a subject, before the object: YO EXPLICAR NADIE says another thing."""
    alone = [gloss.sources[0] if len(gloss.sources) == 1 else -1 for gloss in said.glosses]
    pointing = [gloss.sources if gloss.gloss in persons else () for gloss in said.glosses]
    objects = [
        at for at, own in enumerate(pointing) if any(words[place].tag.startswith(OBJECT) for place in own)
    ]
    nobody = (
        at
        for at, place in enumerate(alone)
        if 0 <= place < len(words) - 1
        and words[place].tag.startswith("PRON:neg")
        and words[place + 1].tag.startswith(OBJECT)
    )
    at = next(nobody, -1)
    if not objects or objects[0] >= at:
        return said
    order = list(range(len(alone)))
    order.insert(objects[0], order.pop(at))
    return said.in_order(order)


def _says(readings: Sequence[Reading], pattern: re.Pattern[str]) -> bool:
    return any(pattern.fullmatch(reading.tag) for reading in readings)


def _says_signer(words: Sequence[SourceWord], places: Sequence[int]) -> bool:
    return any(_says(words[place].readings[:1], _SIGNERS) for place in places)


def _names_signer(words: Sequence[SourceWord], apart_from: int) -> bool:
    """Whether a word but one says the signer."""
    return _says_signer(words, [place for place in range(len(words)) if place != apart_from])


def _commands(words: Sequence[SourceWord], verb: int) -> bool:
    """Whether a verb asks somebody who is called "usted" to do something: "respire", "no se mueva"."""
    return _says(words[verb].readings[:1], _COMMAND) and opens_clause(words, verb)


def _has_signers_verb(words: Sequence[SourceWord]) -> bool:
    return any(word.tag.startswith(_MAIN) and word.tag.endswith(":1s") for word in words)
