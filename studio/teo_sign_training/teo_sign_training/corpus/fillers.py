# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Words and numbers of the lists as phrases."""

from __future__ import annotations

from collections.abc import Mapping

from teo_sign_training.corpus.tokens import Phrase, SaidWord, Sign
from teo_sign_training.corpus.words import ListedWord, WordLists
from teo_sign_translator.morphology import gloss_name
from teo_sign_translator.text.numerals import Numerals

#: One more than the largest number that is written in words here.
LIMIT = 10_000
#: From here on hundreds agree with what is counted ("doscientas casas").
_AGREEING_HUNDREDS = 200


class NoFillerError(Exception):
    """Nothing fits a slot this time; another try may succeed."""


def word_phrase(words: WordLists, category: str, word: ListedWord, arguments: Mapping[str, str]) -> Phrase:
    """A noun in its number, an adjective that agrees, a name or an adverb.

    Raises:
        TranslationError: "no_form" if the morphology does not know the word.
    """
    form = word.lemma
    if category == "noun":
        form = words.inflect(word.lemma, word.features["tag"])
    elif category == "adj":
        number = arguments.get("number", "s")
        tags = {"m+f": f"A:{arguments.get('gender', 'm')}{number}", "mf": f"A:c{number}", "-": "A"}
        form = words.inflect(word.lemma, tags.get(word.features["gender"], "A:cn"))
    token = SaidWord(form)
    gloss = gloss_name(word.lemma)
    return Phrase({**word.features, "lemma": word.lemma}, [token], [Sign(gloss, [token])], token)


def can_be_in_words(value: int, gender: str) -> bool:
    """Whether a number may be in words: those that agree ("veintiún", "doscientas") are in digits."""
    agrees = value >= _AGREEING_HUNDREDS or (value % 10 == 1 and value != 11)
    return value < LIMIT and not (gender and agrees)


def number_phrase(value: int, gender: str, numbers: Numerals, *, in_words: bool) -> Phrase:
    """A number, in words or digits; one gloss of digits."""
    token = SaidWord(numbers.in_words(value) if in_words else str(value))
    features = {"number": "s" if value == 1 else "p", "gender": gender or "m", "person": "3"}
    return Phrase(features, [token], [Sign(str(value), [token])], token)
