"""Seeing to it that a translation loses no word of its sentence and invents none."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from teo_sign_translator.morphology import Reading
from teo_sign_translator.neural import Hypothesis, OutputGloss
from teo_sign_translator.pipeline.coverage import Coverage
from teo_sign_translator.pipeline.function_words import FunctionWords
from teo_sign_translator.pipeline.gloss_evidence import Warrants
from teo_sign_translator.pointer.vocabulary import copied_gloss
from teo_sign_translator.text.source_words import SourceWord

#: Of a gloss that was put back: its word is right, its place a guess.
REPAIRED_CONFIDENCE = 0.2

# Tags of words that LSE signs last.
_LAST = ("WH",)


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
    words: Sequence[SourceWord], hypotheses: Sequence[Hypothesis], coverage: Coverage, warrants: Warrants
) -> Faithful:
    """The best translation that loses no word and invents no gloss.

    If there is none, that with the fewest faults, without what it invents and with what it loses put back: a
    sign that nobody said misleads. A word put back stands beside the gloss of the nearest word that has one,
    a question word last. A sentence of nothing but function words has each of them signed, since it would be
    empty otherwise.

    Args:
        words: Of the sentence; one at least is no mark.
        hypotheses: Its translations, best first.
        coverage: Finds lost words.
        warrants: Finds invented glosses.
    """
    for hypothesis in hypotheses:
        if hypothesis.glosses and not _faults(words, hypothesis.glosses, coverage, warrants):
            return as_said(hypothesis)
    best = min(
        (each.glosses for each in hypotheses), key=lambda each: _faults(words, each, coverage, warrants)
    )
    invented = warrants.invented(words, best)
    best = tuple(gloss for place, gloss in enumerate(best) if place not in invented)
    missing = {place: _meant(words[place], coverage.function_words) for place in coverage.lost(words, best)}
    if not best and not missing:
        missing = {place: word.readings[0] for place, word in enumerate(words) if not word.is_mark}
    glosses = list(best)
    repaired = [False] * len(best)
    for place, reading in missing.items():
        index = len(glosses)
        if not reading.tag.startswith(_LAST):
            index = _beside(place, words, glosses, coverage)
        gloss = OutputGloss(copied_gloss(reading), (place,), REPAIRED_CONFIDENCE, copied=True)
        glosses.insert(index, gloss)
        repaired.insert(index, True)
    return Faithful(tuple(glosses), tuple(repaired))


def _faults(
    words: Sequence[SourceWord], glosses: Sequence[OutputGloss], coverage: Coverage, warrants: Warrants
) -> int:
    return len(coverage.lost(words, glosses)) + len(warrants.invented(words, glosses))


def _meant(word: SourceWord, function_words: FunctionWords) -> Reading:
    """The likeliest reading of a word that was left out: a name where a capital says so."""
    names = (reading for reading in word.readings if word.capital and reading.tag.startswith("NAME"))
    others = (reading for reading in word.readings if not function_words.lists(reading))
    return next(names, None) or next(others, None) or word.readings[0]


def _beside(
    word: int, words: Sequence[SourceWord], glosses: Sequence[OutputGloss], coverage: Coverage
) -> int:
    """Where the gloss of a word belongs: beside that of the nearest word, of two the one before."""
    best, index = float("inf"), len(glosses)
    for place, said in enumerate(coverage.said(words, glosses)):
        for source in said:
            distance = 2 * abs(source - word) - (source < word)
            if distance < best or (distance == best and source < word):
                best, index = distance, place + (source < word)
    return index
