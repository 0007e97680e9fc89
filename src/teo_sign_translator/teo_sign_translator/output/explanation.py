# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Why each token of a translation is there, and where each word of the text went, as lines to read."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby

from teo_sign_translator.output.translation import Kind, Origin, Sentence, Token, Translation, printed

_REASONS = {
    Origin.MODEL: "the model says it",
    Origin.LEMMA: "the sign of the dictionary form",
    Origin.SYNONYM: "a sign that means the same",
    Origin.SPELLED: "in letters",
    Origin.NUMBER: "a number",
    Origin.REPAIRED: "the model left it out; its place is a guess",
    Origin.WORD_LIST: "the word alone, from a list",
    Origin.PARAPHRASE: "one of the signs that say it together",
}


def explained(translation: Translation) -> Iterator[str]:
    """Lines about each sentence: its tokens with their words, then the words that have none."""
    for sentence in translation.sentences:
        yield sentence.text
        yield from _aligned([_row(group) for group in _words(sentence)])
        if sentence.dropped:
            yield f"  nothing is signed for: {', '.join(sentence.dropped)}"
    if translation.ignored:
        yield f"ignored: {' '.join(translation.ignored)}"


def _words(sentence: Sentence) -> list[list[Token]]:
    """A sentence's tokens without pauses, letters of one word together."""
    signed = (token for token in sentence.tokens if token.kind is not Kind.PAUSE)
    return [list(group) for _, group in groupby(signed, key=lambda token: (token.word_index, token.kind))]


def _row(tokens: Sequence[Token]) -> tuple[str, str, str]:
    """What is signed, for which words, and why."""
    first = tokens[0]
    reason = _REASONS[first.origin]
    if first.meant:
        reason += f", for {first.meant}"
    if first.inflection:
        reason += f", form {first.inflection}"
    if first.origin is Origin.MODEL:
        reason += f" ({min(token.confidence for token in tokens):.0%})"
    return printed(tokens), " ".join(first.source_words) or "-", reason


def _aligned(rows: Sequence[tuple[str, str, str]]) -> list[str]:
    """Rows as lines, their columns below each other."""
    widths = [max((len(row[column]) for row in rows), default=0) for column in (0, 1)]
    return [f"  {gloss:<{widths[0]}}  {words:<{widths[1]}}  {reason}" for gloss, words, reason in rows]
