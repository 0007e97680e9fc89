"""Words and numbers of the lists as phrases."""

from __future__ import annotations

from collections.abc import Mapping

from teo_sign_translator.corpus.number_words import LIMIT, number_words
from teo_sign_translator.corpus.tokens import Phrase, Sign, Token
from teo_sign_translator.corpus.words import Word, WordLists

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
    gloss = word.lemma.upper().replace(" ", "_")
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
