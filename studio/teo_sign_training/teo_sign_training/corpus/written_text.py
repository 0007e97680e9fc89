# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From words to a written sentence: contractions, words that meet, marks, the first capital."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from teo_sign_training.corpus.tokens import SaidWord
from teo_sign_training.corpus.writing import Writing
from teo_sign_translator.morphology.spanish import unaccented

_OPENING = ("¿", "¡")
_CLOSING = (",", ".", "?", "!", ":")
#: What begins so hangs on the word before it: Ana's.
_HANGING = "'"


def write(
    tokens: Sequence[SaidWord], writing: Writing, contracts: Callable[[str], bool | None]
) -> tuple[str, dict[int, int]]:
    """Write a sentence.

    Args:
        tokens: Words and marks.
        writing: How the language writes words that meet.
        contracts: Of a contraction that a reader takes apart again, whether it is written this time; None of
            one that stays one word and is always written.

    Returns:
        The text, and for the identity of each token its index among the words and marks that
        `source_words` finds in the text.
    """
    pieces: list[str] = []
    places: dict[int, int] = {}
    words = 0
    previous: SaidWord | None = None
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
        text = _meeting(token, following, writing)
        contracted = writing.contractions.get((previous.text, text)) if previous else None
        written = contracts(contracted) if contracted else False
        if previous and contracted and written is not False:
            pieces[-1] = pieces[-1][: -len(previous.text)] + contracted
            if written is None:
                words -= 1
                places[id(token)] = words - 1
        else:
            pieces.append(text if glued or text.startswith(_HANGING) else " " + text)
        glued = False
        previous = None if written else token
    return _capitalised("".join(pieces)), places


def _meeting(token: SaidWord, following: str, writing: Writing) -> str:
    sound = unaccented(following.lower())
    for meeting in writing.meetings.get(token.text, ()):
        if meeting.before is not None and meeting.before.fullmatch(sound):
            return meeting.written
        if token.article and following in meeting.words:
            return meeting.written
    return token.text


def _capitalised(text: str) -> str:
    for place, letter in enumerate(text):
        if letter.isalnum():
            return text[:place] + letter.upper() + text[place + 1 :]
    return text
