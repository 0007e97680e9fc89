# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Whom something happens to, where an object pronoun alone says it: "la chica que te presenté".

A model that leaves out who acts on the addressee, or on whom a third person acts, turns the sentence round:
CHICA TÚ PRESENTAR has the addressee present her. Who acts is signed first, then whom it happens to, then what
happens (Herrero Blanco 2009, Gramática didáctica de la LSE, on directional verbs).
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from teo_sign_translator.pipeline.completeness import CompleteTranslation, own_places, read_gloss
from teo_sign_translator.pipeline.pipeline_words import PipelineWords
from teo_sign_translator.pipeline.topic import Topics
from teo_sign_translator.text.source_word import (
    CLITICS,
    FINITE,
    NOUNS,
    OBJECT,
    OPENING,
    TELLING,
    THIRD_ALONE,
    SourceWord,
    clause_end,
)

#: Of a verb that others do.
_OTHERS = re.compile(r"V:ind:.*:3p")
_THIRD = "3"
_SIGNER = "1s"
#: Of verbs that another one governs, and what may stand between the two.
_GOVERNED = ("V:inf", "V:ger", "V:part")
_LINKS = ("PREP", "CONJ", "PRON:rel", "ADV")


class _Deed(NamedTuple):
    """What somebody does to whom.

    Attributes:
        clitic: Place of the object pronoun.
        to_whom: Its person and number, e.g. "2s".
        who: Person and number of who does it.
        verbs: Places of the verb that says so, and of those that it governs.
    """

    clitic: int
    to_whom: str
    who: str
    verbs: tuple[int, ...]


class Objects:
    """Reads whom something happens to."""

    def __init__(self, language: PipelineWords, topics: Topics) -> None:
        """Take how a language joins clauses and points at persons, and who may do things."""
        self._who = language.subjects
        self._pointing = language.subjects.pointing
        self._towards, self._things = language.persons.towards, language.persons.things
        self._names = frozenset(self._pointing.values())
        self._experiencer_verbs = language.persons.experiencer_verbs
        self._topics = topics

    def read(self, words: Sequence[SourceWord], said: CompleteTranslation) -> CompleteTranslation:
        """A translation in which both are pointed at where one who is left out would be taken for the other.

        Args:
            words: Of the sentence.
            said: A translation of it.
        """
        for deed in self._deeds(words):
            _, verbs = self._said(said, deed)
            if verbs and deed.who.startswith(_THIRD):
                said = self._with_whom(words, self._with_both(words, said, deed), deed)
            elif verbs:
                said = self._with_actor(said, deed)
        return self._with_actor_first(words, self._with_unnamed(words, said))

    def _with_unnamed(self, words: Sequence[SourceWord], said: CompleteTranslation) -> CompleteTranslation:
        """The same with others who do it to whom a relative clause tells of: "el médico al que operaron"."""
        for verb in range(2, len(words)):
            relative = words[verb - 1].form == self._who.joiner and words[verb - 1].tag == "PRON:rel"
            to_whom = any(word.form in self._towards for word in words[max(0, verb - 3) : verb - 1])
            if not relative or not to_whom or not _OTHERS.fullmatch(words[verb].tag):
                continue
            named = any(self._topics.may_act(words, at) for at in range(verb + 1, clause_end(words, verb)))
            own = [at for at, gloss in enumerate(said.glosses) if verb in gloss.sources]
            if own and not named and not any(said.glosses[at].gloss in self._names for at in own):
                return said.with_glosses(own[0], read_gloss(self._pointing["3p"], verb))
        return said

    def _with_actor_first(
        self, words: Sequence[SourceWord], said: CompleteTranslation
    ) -> CompleteTranslation:
        """The same with who does it before whom it is done to: "al perro lo persigue el gato"."""
        clitic = next((at for at in range(len(words)) if _is_third(words, at) and _behind(words, at)), 0)
        verbs = _behind(words, clitic)
        asked = any(word.tag.startswith("WH") for word in words[:clitic])
        if not verbs or asked or words[0].form not in self._towards:
            return said
        start = verbs[-1] + 1
        deed = words[verbs[-1]].readings[0].lemma in self._who.deeds or words[clitic].form in self._things
        actor = range(start, clause_end(words, start, ("PREP", "V:", *OPENING)))
        acts = any(self._topics.may_do(words[at]) and words[at].tag.startswith(NOUNS) for at in actor)
        if not deed or not acts or not words[verbs[0]].person.startswith(_THIRD):
            return said
        own = [own_places(words, gloss) for gloss in said.glosses]
        first = [at for at, places in enumerate(own) if places and places <= {*range(clitic)}]
        then = [at for at, places in enumerate(own) if places and places <= {*actor}]
        if not first or not then:
            return said
        rest = [at for at in range(len(own)) if at not in (*first, *then)]
        place = sum(at < min(*first, *then) for at in rest)
        return said.in_order([*rest[:place], *then, *first, *rest[place:]])

    def _deeds(self, words: Sequence[SourceWord]) -> Iterator[_Deed]:
        """What is done to the signer or the addressee: a pronoun before its verb, or at its end."""
        for place, word in enumerate(words):
            reading = word.readings[0]
            own = (self._who.clitics[each] for each in reading.clitics if each in self._who.clitics)
            at_end = next(own, "")
            if at_end:
                to_whom, verbs = at_end, _up_to(words, place)
            else:
                to_whom, verbs = reading.tag.removeprefix(OBJECT), _behind(words, place)
            if not verbs or to_whom not in self._who.clitics.values():
                continue
            who = (_finite(words[verbs[0]]) or words[verbs[0]].tag).rsplit(":", 1)[-1]
            # "se me olvidó llamarte", "quiere verme": who feels, and who is named before.
            is_open = at_end and who.startswith(_THIRD) and not _acts(words, verbs)
            if who in self._pointing and who[0] != to_whom[0] and not is_open:  # else it is reflexive
                yield _Deed(place, to_whom, who, verbs)

    def _with_actor(self, said: CompleteTranslation, deed: _Deed) -> CompleteTranslation:
        """The same with the signer or the addressee who does it, before who would be taken to do it."""
        who, to_whom = self._pointing[deed.who], self._pointing[deed.to_whom]
        own, verbs = self._said(said, deed)
        done = next((at for at in verbs if deed.verbs[-1] in said.glosses[at].sources), -1)
        if [said.glosses[at].gloss for at in own] != [to_whom] or own[0] > done:
            return said
        place = min(own[0], verbs[0])
        typed = place > 0 and said.glosses[place - 1].gloss == who
        return said if typed else said.with_glosses(place, read_gloss(who, deed.verbs[0]))

    def _with_both(
        self, words: Sequence[SourceWord], said: CompleteTranslation, deed: _Deed
    ) -> CompleteTranslation:
        """The same with who is not named and whom he does it to: "ayer me llamó", never AYER YO LLAMAR."""
        own, verbs = self._said(said, deed)
        pointed = [said.glosses[at].gloss for at in own]
        asks = words[-1].form == "?" and deed.who == "3s"  # the addressee, politely: "¿me ayuda?"
        who = read_gloss(self._topics.polite if asks else self._pointing[deed.who], deed.verbs[0])
        to_whom = read_gloss(self._pointing[deed.to_whom], deed.clitic)
        if who.gloss in pointed or not self._is_deed(words, deed) or self._is_named(words, deed):
            return said
        if asks and not (own and deed.to_whom.startswith("1")):
            return said
        start = _clause_start(words, deed.clitic)
        first = [min(gloss.sources, default=start) for gloss in said.glosses]
        in_clause = [at for at in own if all(each >= start for each in first[at : verbs[0]])]
        if to_whom.gloss not in pointed or not in_clause:
            return said.with_glosses(verbs[0], who, to_whom)
        return said.with_glosses(min(in_clause[0], verbs[0]), who)

    def _with_whom(
        self, words: Sequence[SourceWord], said: CompleteTranslation, deed: _Deed
    ) -> CompleteTranslation:
        """The same with whom it is done to, unless that is the signer: "¿cuándo te dan las notas?".

        Signers leave themselves out, but for what they wish for ("que me llame"): of 19 known translations
        without YO all answers of one have it, that of a wish; of five without TÚ or NOSOTROS, of three.
        """
        _, verbs = self._said(said, deed)
        wished = words[deed.verbs[0]].tag.startswith("V:sub")
        to_whom = read_gloss(self._pointing[deed.to_whom], deed.clitic)
        is_said = any(gloss.gloss == to_whom.gloss for gloss in said.glosses)
        if is_said or _happens(words, deed) or (deed.to_whom == _SIGNER and not wished):
            return said
        return said.with_glosses(verbs[0], to_whom)

    def _said(self, said: CompleteTranslation, deed: _Deed) -> tuple[list[int], list[int]]:
        """Which glosses point at somebody for a deed, and which say what is done."""
        pointing: list[int] = []
        verbs: list[int] = []
        for at, gloss in enumerate(said.glosses):
            if gloss.gloss not in self._names and not {*deed.verbs}.isdisjoint(gloss.sources):
                verbs.append(at)
            elif gloss.gloss in self._names and not {deed.clitic, *deed.verbs}.isdisjoint(gloss.sources):
                pointing.append(at)
        return pointing, verbs

    def _is_deed(self, words: Sequence[SourceWord], deed: _Deed) -> bool:
        """Whether a third person, or several, does it on purpose: "me llamó", not "me gusta llamar"."""
        finite = words[deed.verbs[0]].readings[0]
        says_who = THIRD_ALONE.fullmatch(finite.tag) or _OTHERS.fullmatch(finite.tag)
        if not says_who or finite.lemma in self._experiencer_verbs:
            return False
        done = {reading.lemma for reading in words[deed.verbs[-1]].readings if reading.tag.startswith("V:")}
        return not done.isdisjoint(self._who.deeds)

    def _is_named(self, words: Sequence[SourceWord], deed: _Deed) -> bool:
        """Whether the clause names who does it, is another's that does, or says that nobody does it."""
        start = _clause_start(words, deed.clitic)
        stop = clause_end(words, deed.verbs[-1] + 1)
        joined = start > 0 and (
            words[start - 1].form == self._who.joiner or words[start - 1].tag.startswith(("WH", "PRON:rel"))
        )
        others = (at for at in range(start, stop) if at not in deed.verbs)
        return joined or _happens(words, deed) or any(self._may_be(words, at, deed) for at in others)

    def _may_be(self, words: Sequence[SourceWord], place: int, deed: _Deed) -> bool:
        """Whether a word may name who does it; behind the verb only somebody does, no thing."""
        word = words[place]
        if word.tag.startswith(CLITICS):
            return False
        names = self._topics.may_act(words, place) and (place < deed.clitic or self._topics.may_do(word))
        return names or word.tag.startswith(("PRON:", "WH"))


def _clause_start(words: Sequence[SourceWord], place: int) -> int:
    """Where the clause begins that a word stands in."""
    return next((at for at in range(place, 0, -1) if words[at - 1].tag.startswith(OPENING)), 0)


def _finite(word: SourceWord) -> str:
    """The tag of what a word is behind a pronoun: "te mando" is no noun; empty if it is no finite verb."""
    exact = (each.tag for each in word.readings if each.exact and each.tag.startswith("V:ind"))
    return word.tag if word.tag.startswith(TELLING) else next(exact, "") if word.tag.startswith("N:") else ""


def _is_third(words: Sequence[SourceWord], place: int) -> bool:
    """Whether a word may be a pronoun for a third person to whom something is done."""
    return any(each.tag.startswith(f"{OBJECT}{_THIRD}") for each in words[place].readings)


def _happens(words: Sequence[SourceWord], deed: _Deed) -> bool:
    """Whether nobody does it: "se me olvidó"."""
    pronouns = words[max(0, deed.clitic - 1) : deed.verbs[0]]
    return any(word.tag.startswith("PRON:refl") for word in pronouns)


def _behind(words: Sequence[SourceWord], clitic: int) -> tuple[int, ...]:
    """Places of the verb behind a pronoun and of those that it governs: "me van a operar"; or none."""
    following = (at for at in range(clitic + 1, len(words)) if not words[at].tag.startswith(CLITICS))
    finite = next(following, -1)
    is_pronoun = any(each.tag.startswith(OBJECT) for each in words[clitic].readings)
    if not is_pronoun or finite < 0 or not _finite(words[finite]):
        return ()
    places = [finite]
    for place in range(finite + 1, len(words)):
        participle = place == finite + 1 and any(each.tag == "V:part:ms" for each in words[place].readings)
        if participle or words[place].tag.startswith(_GOVERNED):  # "ha pedido" is no "pedido"
            places.append(place)
        elif not words[place].tag.startswith(_LINKS):
            break
    return tuple(places)


def _up_to(words: Sequence[SourceWord], place: int) -> tuple[int, ...]:
    """Places of a verb that ends with a pronoun, and first of the one that says who: "ven a verme"."""
    if not words[place].tag.startswith("V:inf"):
        return (place,)
    perfect = any(word.tag.startswith("V:part") for word in words[place + 1 : place + 2])  # haberme llamado
    done = (place, place + 1) if perfect else (place,)
    for before in range(place - 1, -1, -1):
        if words[before].tag.startswith(FINITE):
            return (before, *done)
        if not words[before].tag.startswith((*_LINKS, *_GOVERNED)):
            break
    return ()


def _acts(words: Sequence[SourceWord], verbs: tuple[int, ...]) -> bool:
    """Whether one who is not named goes on or begins to do it: "volvió a llamarme", no "ven a verme"."""
    governs = len(verbs) > 1 and words[verbs[0] + 1].tag.startswith("PREP")
    opens = verbs[0] == 0 or words[verbs[0] - 1].is_mark
    may_ask = opens and words[verbs[0]].tag.startswith("V:ind:pres")
    return governs and not may_ask and not (verbs[0] > 0 and words[verbs[0] - 1].tag.startswith(CLITICS))
