"""A sentence as the words that a sentence model reads: the same way in training and in use."""

from __future__ import annotations

import re
from dataclasses import dataclass

from teo_sign_translator.morphology import Morphology, Reading
from teo_sign_translator.normalisation import clean

_WORD = re.compile(r"\d+(?:[.,]\d+)*|[^\W\d_]+|[,.?!:]")


@dataclass(frozen=True, slots=True)
class SourceWord:
    """A word or mark of a sentence.

    Attributes:
        text: As typed.
        form: Lower case with the accents that were typed; a number, also one of several words, in digits.
        capital: Whether it was typed with a capital although it is not the first word of its sentence.
        readings: What it may be, most likely first; at least one.
    """

    text: str
    form: str
    capital: bool
    readings: tuple[Reading, ...]


def source_words(sentence: str, morphology: Morphology) -> tuple[SourceWord, ...]:
    """The words and marks of one sentence, in its order."""
    words: list[SourceWord] = []
    for match in _WORD.finditer(clean(sentence).text):
        text = match.group()
        words.append(
            SourceWord(text, text.lower(), bool(words) and text[0].isupper(), morphology.readings(text))
        )
    return tuple(words)
