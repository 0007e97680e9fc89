# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Words and numbers of the lists as phrases."""

from __future__ import annotations

from collections.abc import Mapping

from teo_sign_translator.corpus.tokens import Phrase, Sign, Token
from teo_sign_translator.corpus.words import Word, WordLists
from teo_sign_translator.morphology import gloss_name
from teo_sign_translator.text.numerals import HUNDREDS, TENS, UNITS

#: One more than the largest number that is written in words here.
LIMIT = 10_000
#: From here on hundreds agree with what is counted ("doscientas casas").
_AGREEING_HUNDREDS = 200


class NoFillerError(Exception):
    """Nothing fits a slot this time; another try may succeed."""


def word_phrase(words: WordLists, category: str, word: Word, arguments: Mapping[str, str]) -> Phrase:
    """A noun in its number, an adjective that agrees, a name or an adverb.

    Raises:
        TranslationError: "no_form" if the morphology does not know the word.
    """
    form = word.lemma
    if category == "noun":
        form = words.inflect(word.lemma, word.features["tag"])
    elif category == "adj":
        letter = {"m+f": arguments.get("gender", "m"), "mf": "c"}.get(word.features["gender"])
        form = words.inflect(word.lemma, f"A:{letter}{arguments.get('number', 's')}" if letter else "A:cn")
    token = Token(form)
    gloss = gloss_name(word.lemma)
    return Phrase({**word.features, "lemma": word.lemma}, [token], [Sign(gloss, [token])], token)


def can_be_in_words(value: int, gender: str) -> bool:
    """Whether a number may be in words: those that agree ("veintiún", "doscientas") are in digits."""
    agrees = value >= _AGREEING_HUNDREDS or (value % 10 == 1 and value != 11)
    return value < LIMIT and not (gender and agrees)


def number_phrase(value: int, gender: str, *, in_words: bool) -> Phrase:
    """A number, in words or digits; one gloss of digits."""
    token = Token(number_words(value) if in_words else str(value))
    features = {"number": "s" if value == 1 else "p", "gender": gender or "m", "person": "3"}
    return Phrase(features, [token], [Sign(str(value), [token])], token)


def number_words(value: int) -> str:
    """A number from 0 to 9999 in words, as counted: `31` is `"treinta y uno"`."""
    if value >= 1000:
        thousands, rest = divmod(value, 1000)
        words = "mil" if thousands == 1 else f"{number_words(thousands)} mil"
        return f"{words} {number_words(rest)}" if rest else words
    if value == 100:
        return "cien"
    if value > 100:
        hundreds, rest = divmod(value, 100)
        return f"{HUNDREDS[hundreds - 1]} {number_words(rest)}" if rest else HUNDREDS[hundreds - 1]
    if value < 30:
        return UNITS[value]
    tens, units = divmod(value, 10)
    return f"{TENS[tens - 3]} y {UNITS[units]}" if units else TENS[tens - 3]
