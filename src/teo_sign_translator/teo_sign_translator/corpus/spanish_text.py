# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From words to a written sentence: contractions, vowels that meet, marks, the first capital."""

from __future__ import annotations

from collections.abc import Sequence

from teo_sign_translator.corpus.tokens import Token
from teo_sign_translator.morphology.accents import unaccented

_OPENING = ("¿", "¡")
_CLOSING = (",", ".", "?", "!", ":")
_MASCULINE = {"la": "el", "una": "un", "alguna": "algún", "ninguna": "ningún"}
_CONTRACTIONS = {("a", "el"): "al", ("de", "el"): "del"}


def write(tokens: Sequence[Token], stressed_a: frozenset[str]) -> tuple[str, dict[int, int]]:
    """Write a sentence.

    Args:
        tokens: Words and marks.
        stressed_a: Feminine nouns that take "el": agua.

    Returns:
        The text, and for the identity of each token its index among the words and marks that
        `spanish_words.source_words` finds in the text.
    """
    pieces: list[str] = []
    places: dict[int, int] = {}
    words = 0
    previous: Token | None = None
    glued = True
    for position, token in enumerate(tokens):
        text = token.text
        if text in _OPENING:
            pieces.append(text if glued else " " + text)
            glued = True
            previous = None
            continue
        places[id(token)] = words
        words += 1
        if text in _CLOSING:
            pieces.append(text)
            glued = False
            previous = None
            continue
        following = tokens[position + 1].text if position + 1 < len(tokens) else ""
        text = _meeting(token, following, stressed_a)
        contracted = _CONTRACTIONS.get((previous.text, text)) if previous else None
        if contracted:
            pieces[-1] = pieces[-1][: -len(previous.text if previous else "")] + contracted
            words -= 1
            places[id(token)] = words - 1
        else:
            pieces.append(text if glued else " " + text)
        glued = False
        previous = token
    return _capitalised("".join(pieces)), places


def _meeting(token: Token, following: str, stressed_a: frozenset[str]) -> str:
    text = token.text
    if token.article and following in stressed_a:
        return _MASCULINE.get(text, text)
    if text not in ("y", "o"):
        return text
    sound = unaccented(following.lower()).removeprefix("h")
    if text == "y" and sound.startswith("i") and not sound.startswith(("ie", "ia")):
        return "e"
    if text == "o" and sound.startswith("o"):
        return "u"
    return text


def _capitalised(text: str) -> str:
    for place, letter in enumerate(text):
        if letter.isalnum():
            return text[:place] + letter.upper() + text[place + 1 :]
    return text
