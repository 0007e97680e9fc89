# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Tokens of the published model: a sentence as words and marks, and their places in a one-hot vector."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from teo_common.text_folding import fold
from teo_sign_training.corpus.aligned_pairs import SLOTS
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.text.cleaning import clean

#: Ends and begins every output sequence; always the first two of an output vocabulary.
END = "<end>"
START = "<start>"
#: Marks that are tokens of their own.
MARKS = ("?", "!")

_TOKEN = re.compile("|".join([*map(re.escape, SLOTS), r"\w+", "[?!]"]))


def published_tokens(sentence: str) -> tuple[str, ...]:
    """Tokens as in the paper: words in lower case with their accents, `!` and `?` tokens of their own.

    Opening marks, commas and points are left out: `"¿Qué tal?"` is `qué tal ?`.
    """
    return tuple(_TOKEN.findall(clean(sentence).text.lower()))


def folded_tokens(sentence: str) -> tuple[str, ...]:
    """The same without accents (`ñ` stays), which makes one token of all ways of typing a word."""
    return tuple(token if token in SLOTS else fold(token) for token in published_tokens(sentence))


def mark_variants(tokens: tuple[str, ...]) -> list[tuple[str, ...]]:
    """The same sentence with its marks typed in every likely way: as given, left out, or others."""
    inner = tokens[:-1] if tokens[-1:] and tokens[-1] in MARKS else tokens
    bare = tuple(token for token in inner if token not in MARKS)
    return list(
        dict.fromkeys([tokens, *((*body, *end) for body in (bare, inner) for end in ((), ("?",), ("!",)))])
    )


class TokenList:
    """An ordered set of tokens."""

    def __init__(self, tokens: Sequence[str]) -> None:
        """Number the tokens from 0.

        Raises:
            TranslationError: "invalid_model" if a token occurs twice or there is none.
        """
        self.tokens = tuple(tokens)
        self._index = {token: index for index, token in enumerate(self.tokens)}
        if not self.tokens or len(self._index) != len(self.tokens):
            raise TranslationError("invalid_model", "expected a vocabulary of one or more tokens, each once")

    @classmethod
    def of_inputs(cls, sequences: Iterable[Sequence[str]]) -> TokenList:
        """The vocabulary of input sequences, sorted."""
        return cls(sorted({token for sequence in sequences for token in sequence}))

    @classmethod
    def of_outputs(cls, sequences: Iterable[Sequence[str]]) -> TokenList:
        """The vocabulary of output sequences: END, START, then the tokens sorted."""
        return cls([END, START, *sorted({token for sequence in sequences for token in sequence})])

    def __len__(self) -> int:
        return len(self.tokens)

    def __contains__(self, token: object) -> bool:
        return token in self._index

    def indices(self, tokens: Iterable[str]) -> list[int]:
        """The places of tokens.

        Raises:
            TranslationError: "unknown_token" for one that is not in the vocabulary.
        """
        try:
            return [self._index[token] for token in tokens]
        except KeyError as error:
            raise TranslationError(
                "unknown_token", f"expected a token of the vocabulary, got {error}"
            ) from None
