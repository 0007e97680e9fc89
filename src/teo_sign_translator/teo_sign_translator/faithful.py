"""Seeing to it that no word of a sentence is lost in its translation."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

from teo_sign_translator.function_words import FunctionWords
from teo_sign_translator.morphology import Reading
from teo_sign_translator.neural import Hypothesis, OutputGloss
from teo_sign_translator.neural.lexis import copied_gloss
from teo_sign_translator.spanish_words import SourceWord

#: Of a gloss that was put back: its word is right, its place a guess.
REPAIRED_CONFIDENCE = 0.2


@dataclass(frozen=True, slots=True)
class Faithful:
    """Glosses that leave no word out.

    Attributes:
        glosses: In signing order.
        repaired: For each whether the model had left its word out and it was put back.
    """

    glosses: tuple[OutputGloss, ...]
    repaired: tuple[bool, ...]


def as_said(hypothesis: Hypothesis) -> Faithful:
    """A translation as the model says it."""
    return Faithful(hypothesis.glosses, (False,) * len(hypothesis.glosses))


def faithful(
    words: Sequence[SourceWord], hypotheses: Sequence[Hypothesis], function_words: FunctionWords
) -> Faithful:
    """The best translation that loses no word; if all do, that which loses fewest, with those put back.

    A word put back stands beside the gloss of the nearest word that has one. A sentence of nothing but
    function words has each of them signed, since it would be empty otherwise.

    Args:
        words: Of the sentence; one at least is no mark.
        hypotheses: Its translations, best first.
        function_words: What may be left out.
    """
    for hypothesis in hypotheses:
        if hypothesis.glosses and not lost(words, hypothesis.glosses, function_words):
            return as_said(hypothesis)
    best = min((each.glosses for each in hypotheses), key=lambda each: len(lost(words, each, function_words)))
    missing = {place: _meant(words[place], function_words) for place in lost(words, best, function_words)}
    if not best and not missing:
        missing = {place: word.readings[0] for place, word in enumerate(words) if not word.is_mark}
    glosses = list(best)
    repaired = [False] * len(best)
    for place, reading in missing.items():
        index = _place_for(place, words, glosses)
        gloss = OutputGloss(copied_gloss(reading), (place,), REPAIRED_CONFIDENCE, copied=True)
        glosses.insert(index, gloss)
        repaired.insert(index, True)
    return Faithful(tuple(glosses), tuple(repaired))


def lost(
    words: Sequence[SourceWord], glosses: Sequence[OutputGloss], function_words: FunctionWords
) -> list[int]:
    """Places of the words that must not be left out and that no gloss stands for."""
    covered = {place for gloss in glosses for place in _stands_for(words, gloss)}
    return [
        place
        for place, word in enumerate(words)
        if place not in covered
        and not function_words.may_be_left_out(word)
        and not _says_only_the_future(words, place)
    ]


def _stands_for(words: Sequence[SourceWord], gloss: OutputGloss) -> Collection[int]:
    """The words that a gloss says: of those that it stands for, not all may be meant.

    A word's own lemma says that word, whatever else the model looked at; a name or a number is said by
    nothing else.
    """
    own = [
        place
        for place in gloss.sources
        if any(copied_gloss(reading) == gloss.gloss for reading in words[place].readings)
    ]
    return own or [
        place
        for place in gloss.sources
        if not all(reading.tag.startswith(("NAME", "NUM")) for reading in words[place].readings)
    ]


def _says_only_the_future(words: Sequence[SourceWord], place: int) -> bool:
    """Whether a word is "voy" of "voy a comer", which a word of time may replace."""
    following = words[place + 1 : place + 3]
    return (
        any(reading.lemma == "ir" for reading in words[place].readings)
        and len(following) == 2
        and following[0].form == "a"
        and any(reading.tag == "V:inf" for reading in following[1].readings)
    )


def _meant(word: SourceWord, function_words: FunctionWords) -> Reading:
    """The likeliest reading of a word that was left out: a name where a capital says so."""
    names = (reading for reading in word.readings if word.capital and reading.tag.startswith("NAME"))
    others = (reading for reading in word.readings if not function_words.lists(reading))
    return next(names, None) or next(others, None) or word.readings[0]


def _place_for(word: int, words: Sequence[SourceWord], glosses: Sequence[OutputGloss]) -> int:
    """Where the gloss of a word belongs: beside that of the nearest word, of two the one before."""
    best, index = float("inf"), len(glosses)
    for place, gloss in enumerate(glosses):
        for source in _stands_for(words, gloss):
            distance = 2 * abs(source - word) - (source < word)
            if distance < best or (distance == best and source < word):
                best, index = distance, place + (source < word)
    return index
