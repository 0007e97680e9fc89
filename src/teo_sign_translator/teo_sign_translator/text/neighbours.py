# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What stands beside a word rules out some of what it may be: a verb behind "el", a noun behind "me"."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from dataclasses import replace
from itertools import pairwise

from teo_sign_translator.morphology import Morphology, Reading
from teo_sign_translator.text.rules import TextRules
from teo_sign_translator.text.source_word import BEFORE_VERBS, CLITICS, FINITE, SourceWord

_MASCULINE = re.compile("[NA]:[mc][sn]|V:part:ms")
# Forms of a verb that tell its person, as not every language's do.
_PERSONAL = re.compile(f"(?:{'|'.join(FINITE)}).*:[123][sp]")
# Pronouns that are subjects alone; question words, and articles that are pronouns too or stand before them:
# not el and un, which stand before feminine nouns too.
_SUBJECTS = ("PRON:1s", "PRON:2s")
_ARTICLE = re.compile("(?:DET:(?:in)?def:(?!ms)|WH:)([fm])([sp])")


def told_by_neighbours(words: list[SourceWord], morphology: Morphology) -> list[SourceWord]:
    """The words, without readings that the one before rules out; typed right where the one behind tells."""
    told = TextRules.load(morphology.folder).neighbours
    for place, (word, following) in enumerate(pairwise(words)):
        written = told.perfect.get(word.form)
        if written and not _is_participle(following, behind=words[place - 1] if place else None):
            written = None
        if place == 0 and following.tag.startswith(("ADV:neg", *CLITICS, *FINITE)):
            written = told.opening.get(word.form, written)
        if word.form in told.conditional and (place == 0 or words[place - 1].is_mark):
            verb = next((each for each in words[place + 1 :] if not each.tag.startswith(BEFORE_VERBS)), word)
            supposed = {each.lemma for each in verb.readings if each.exact and each.tag.startswith("V:sub")}
            written = told.conditional[word.form] if supposed - told.not_conditional else written
        if following.tag.startswith("V:inf"):
            written = told.infinitive.get(word.form, written)
        if written:
            word = words[place] = replace(word, form=written, readings=morphology.readings(written))
        if following.form not in told.amounts:
            word = words[place] = replace(word, readings=_does(word, following, told.copulas))
        if following.form in told.amounts.get(word.form, "").split():
            words[place] = replace(word, readings=_without_verbs(word.readings, prepositions=False))
    for place in range(len(words) - 2):
        words[place] = _coming(words[place : place + 3], told.motion)
    for place in range(len(words) - 3):
        words[place] = _counting(words[place : place + 4], morphology)
    if len(words) > 1 and words[1].is_mark:
        words[0] = replace(words[0], readings=_as_order(words[0].readings))
    for place in range(1, len(words)):
        asks, word = words[place - 1].tag.startswith("WH"), words[place]
        is_last = all(following.is_mark for following in words[place + 1 : place + 2])
        if asks and is_last and word.form in told.misspelled:  # "dónde estas", but "prefiero estas"
            written = told.misspelled[word.form]
            words[place] = replace(word, form=written, readings=morphology.readings(written))
    behind_copula = False
    before = ""
    for place, word in enumerate(words):
        if place:
            word = words[place] = replace(word, readings=_behind(words, place, morphology))
        nominal = tuple(filter(_is_nominal, word.readings))
        masculine = any(_MASCULINE.match(reading.tag) for reading in nominal)
        if before in told.before_nouns and not nominal:
            words[place] = replace(word, readings=(Reading(word.form, "X", exact=False),))
        elif behind_copula or before in told.before_nouns or (before in told.before_masculine and masculine):
            readings = _without_verbs(word.readings, prepositions=behind_copula)
            words[place] = replace(word, readings=readings if behind_copula else _no_participles(readings))
        elif place and words[place - 1].tag.startswith(CLITICS):
            words[place] = replace(word, readings=_no_orders(word.readings))
        before = word.form
        behind_copula = word.readings[0].lemma in told.copulas or (
            behind_copula and word.form in told.degrees
        )
    return words


def _behind(words: Sequence[SourceWord], place: int, morphology: Morphology) -> tuple[Reading, ...]:
    """The readings of a word that may stand behind the one before it.

    No noun stands behind a pronoun ("yo cuento", "que me firmes"); no finite verb behind another or behind
    a preposition ("no llevo suelto", "sin falta"), but an order may follow an order ("espera llama a Ana").
    Behind an article that may be a pronoun a noun agrees with it ("las riego"), and what does so is hardly a
    subjunctive ("la calle"), and none behind a verb or a preposition ("pitó la falta").
    """
    word, before = words[place], words[place - 1]
    verbs = tuple(each for each in word.readings if _PERSONAL.fullmatch(each.tag))
    others = tuple(each for each in word.readings if each not in verbs)
    if not verbs or not any(each.exact for each in others):
        return word.readings
    if any(each.exact for each in verbs) and all(each.tag in _SUBJECTS for each in before.readings):
        return tuple(each for each in word.readings if not each.tag.startswith("N:"))
    doubled = place > 1 and words[place - 2].tag.startswith(CLITICS)  # me lo
    if all(each.tag.startswith(CLITICS) for each in before.readings) or (
        doubled and before.tag.startswith(CLITICS)
    ):
        return verbs if any(each.exact for each in verbs) else word.readings
    tags = [each.tag for each in before.readings if each.exact]
    if tags == ["ADV:neg"] and any(each.exact for each in verbs):  # "no vino", but "no solo"
        return tuple(each for each in word.readings if not each.tag.startswith("N:"))
    if _governs(before):
        opens = place == 1 or words[place - 2].is_mark
        orders = opens and _may_order(before, morphology) and _may_order(word, morphology)
        return word.readings if orders else others
    article = next(filter(None, map(_ARTICLE.fullmatch, tags)), None)
    if article is None:
        return word.readings
    agreeing = tuple(each for each in others if _agrees(each, *article.groups()))
    denied = place > 1 and words[place - 2].tag == "ADV:neg"
    unlikely = not denied and all(each.tag.startswith("V:sub") for each in verbs if each.exact)
    if agreeing and (unlikely or (place > 1 and _governs(words[place - 2]))):
        return agreeing
    return tuple(each for each in word.readings if each in agreeing or not each.tag.startswith(("N:", "A:")))


def _governs(word: SourceWord) -> bool:
    """Whether a word is a finite verb or a preposition, and nothing else."""
    tags = [each.tag for each in word.readings if each.exact]
    return bool(tags) and all(tag.startswith("PREP") or _PERSONAL.fullmatch(tag) for tag in tags)


def _may_order(word: SourceWord, morphology: Morphology) -> bool:
    """Whether a word may be an order to somebody who is called *tú*."""
    verbs = {reading.lemma for reading in word.readings if reading.tag.startswith(FINITE)}
    return any(morphology.is_form(word.form, verb, "V:imp:2s") for verb in verbs)


def _agrees(reading: Reading, gender: str, number: str) -> bool:
    """Whether a noun or adjective may stand behind an article; any other word may."""
    kind, _, form = reading.tag.rpartition(":")
    return kind not in ("N", "A") or (form[:1] in (gender, "c") and form[1:] in (number, "n"))


def _coming(words: Sequence[SourceWord], motion: Collection[str]) -> SourceWord:
    """The first of three words, a verb alone if it is one of motion, with what for: "vino a cenar"."""
    verbs = tuple(
        each for each in words[0].readings if each.lemma in motion and _PERSONAL.fullmatch(each.tag)
    )
    purpose = words[1].tag == "PREP" and words[2].tag == "V:inf"
    return replace(words[0], readings=verbs) if verbs and purpose else words[0]


def _counting(words: Sequence[SourceWord], morphology: Morphology) -> SourceWord:
    """The first of four words, a number alone if a half is counted with it ("un litro y medio")."""
    numbers = TextRules.load(morphology.folder).numbers
    number = tuple(reading for reading in words[0].readings if reading.tag == "NUM")
    half = any(reading.lemma in numbers.fractions[:1] for reading in words[3].readings)
    counts = number and words[1].tag.startswith("N:") and words[2].form == numbers.joiner
    return replace(words[0], readings=number) if counts and half else words[0]


def _does(word: SourceWord, following: SourceWord, copulas: Collection[str]) -> tuple[Reading, ...]:
    """The readings of a word that the one behind leaves it.

    A reflexive pronoun before a verb is no verb typed without its accent ("se lima las uñas"), and a form of
    two verbs is the copula's before an adjective ("sé amable", "fue feliz").
    """
    tags = [each.tag for each in following.readings if each.exact]
    exact = tuple(each for each in word.readings if each.exact)
    if exact and all(each.tag.startswith("PRON:refl") for each in exact):
        acts = any(_PERSONAL.fullmatch(tag) and tag[-2:-1] == "3" for tag in tags)
        return exact if acts else word.readings
    adjective = bool(tags) and all(tag.startswith("A:") for tag in tags)
    return tuple(each for each in exact if adjective and each.lemma in copulas) or word.readings


def _as_order(readings: tuple[Reading, ...]) -> tuple[Reading, ...]:
    """Readings of a word that is a clause of its own: of two verbs the one that is an order ("Ven, ...")."""
    verbs = [reading for reading in readings if reading.tag.startswith(FINITE)]
    orders = tuple(reading for reading in verbs if reading.tag.startswith("V:imp"))
    return orders if orders and len({reading.lemma for reading in verbs}) > 1 else readings


def _is_participle(word: SourceWord, *, behind: SourceWord | None) -> bool:
    """Whether a word is a verb's participle here; what may be a noun is one behind an object's pronoun."""
    tags = [reading.tag for reading in word.readings if reading.exact]
    object_before = behind is not None and any(reading.tag.startswith(CLITICS) for reading in behind.readings)
    return any(tag == "V:part:ms" for tag in (tags if object_before else tags[:1]))


def _is_nominal(reading: Reading) -> bool:
    return not reading.tag.startswith((*FINITE, "PREP"))


def _no_orders(readings: tuple[Reading, ...]) -> tuple[Reading, ...]:
    """What a word behind a pronoun that is acted upon may be: no order, on which it would hang ("lo di")."""
    return tuple(each for each in readings if not each.tag.startswith("V:imp")) or readings


def _no_participles(readings: tuple[Reading, ...]) -> tuple[Reading, ...]:
    """What a word behind an article may be: no participle, if it may be a noun ("un puesto")."""
    nouns = any(reading.tag.startswith("N:") for reading in readings)
    return tuple(each for each in readings if not nouns or not each.tag.startswith("V:part"))


def _without_verbs(readings: tuple[Reading, ...], *, prepositions: bool) -> tuple[Reading, ...]:
    """What a word may be that is no finite verb, and no preposition if it may be a noun; all if nothing."""
    nouns = any(reading.tag.startswith("N:") for reading in readings)
    kept = (
        reading
        for reading in readings
        if not reading.tag.startswith(FINITE) and not (reading.tag == "PREP" and nouns and not prepositions)
    )
    return tuple(kept) or readings
