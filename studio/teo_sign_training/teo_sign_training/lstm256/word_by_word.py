# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Signing a sentence that the model does not know: each word for itself, in Spanish order."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import takewhile

from teo_sign_training.lstm256.gloss_list import GlossList
from teo_sign_translator.output.output_words import (
    SPELLED_CONFIDENCE,
    OutputWord,
    carried,
    lexical,
    number,
    spelled,
)
from teo_sign_translator.output.translation import Origin
from teo_sign_translator.text.reading import Word, WordKind

#: A listed word that is a clause of its own ("Hola", "Gracias"): nothing is left to order, only the sense may
#: be wrong.
ALONE_CONFIDENCE = 0.9
#: A listed word among others: its sign is right, its place and form in the sentence are not looked at.
LISTED_CONFIDENCE = 0.5
#: A name, or digits: spelled and counted as they are, at a place that is not looked at.
NAME_CONFIDENCE = 0.5


def word_by_word(words: Sequence[Word], glosses: GlossList) -> list[OutputWord]:
    """Sign each word: listed words and phrases by their gloss, numbers by digits, all others spelled.

    Function words have no sign and go with the next word. A capital in the middle marks a name, which is
    spelled even if the word is listed, unless everything is in capitals.
    """
    shouted = all(word.parts[0].isupper() for word in words)
    content = [word for word in words if not _is_function(word, glosses)]
    result: list[OutputWord] = []
    index = 0
    while index < len(words):
        word = words[index]
        if word.kind is WordKind.NUMBER:
            confidence = NAME_CONFIDENCE if len(content) > 1 else ALONE_CONFIDENCE
            result += number(word.value, word.parts, confidence)
            index += 1
            continue
        name = index > 0 and word.capitalised and not shouted and not _is_function(word, glosses)
        found = None if name else glosses.find_longest(_run(words, index, glosses.longest))
        if found is None:
            likely_name = word.capitalised and not shouted
            confidence = NAME_CONFIDENCE if likely_name else SPELLED_CONFIDENCE
            result += spelled(word.lower, word.parts, confidence)
            index += 1
            continue
        entry, size = found
        typed = tuple(part for w in words[index : index + size] for part in w.parts)
        if entry.function:
            result += [carried(w.lower, w.parts) for w in words[index : index + size]]
        else:
            alone = size == len(words)
            confidence = ALONE_CONFIDENCE if alone else LISTED_CONFIDENCE
            result.append(lexical(entry.gloss, typed, confidence, Origin.WORD_LIST))
        index += size
    return result


def _is_function(word: Word, glosses: GlossList) -> bool:
    entry = glosses.find(word.lower) if word.kind is not WordKind.NUMBER else None
    return entry is not None and entry.function


def _run(words: Sequence[Word], start: int, longest: int) -> list[str]:
    """Words in lower case from a place on, up to the next number, at most `longest`."""
    run = takewhile(lambda word: word.kind is not WordKind.NUMBER, words[start : start + longest])
    return [word.lower for word in run]
