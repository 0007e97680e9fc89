# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The interface of back ends: from the clauses of a text to the output words of its sentences."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from teo_sign_translator.output.output_words import OutputWord
from teo_sign_translator.text.reading import Clause
from teo_sign_translator.text.sentence_type import SentenceType


@dataclass(frozen=True, slots=True)
class TranslatedSentence:
    """One sentence of a text, translated.

    Attributes:
        clauses: At least one.
        output_words: Its output words and pauses, in signing order.
        recognised: Its type as far as the translation tells; counts only if no mark was typed.
    """

    clauses: Sequence[Clause]
    output_words: Sequence[OutputWord]
    recognised: SentenceType | None


class BackEnd(Protocol):
    """Translates sentences with a model."""

    @property
    def name(self) -> str:
        """Of the model."""

    def translate(self, texts: Sequence[Sequence[Clause]]) -> list[list[TranslatedSentence]]:
        """Translate texts.

        Args:
            texts: The clauses of each.

        Returns:
            The sentences of each text, in its order; every word of the text is among the
            words of their output.
        """
