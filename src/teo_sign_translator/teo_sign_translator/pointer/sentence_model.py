"""The interface of sentence models: words with readings in, hypotheses out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from teo_sign_translator.text.source_words import SourceWord


@dataclass(frozen=True, slots=True)
class OutputGloss:
    """One gloss that a model says.

    Attributes:
        gloss: Upper case with accents, `_` for spaces; a number in digits.
        sources: Indices of the words that it stands for, ascending; empty where no word says it.
        probability: Of this gloss, given those before it, 0 to 1.
        copied: Whether it is a word's lemma carried over, not a gloss of the model's own vocabulary.
    """

    gloss: str
    sources: tuple[int, ...]
    probability: float
    copied: bool


@dataclass(frozen=True, slots=True)
class Hypothesis:
    """One translation of a sentence.

    Attributes:
        glosses: In signing order.
        log_probability: Of the whole, the end included [nat]; at most 0.
    """

    glosses: tuple[OutputGloss, ...]
    log_probability: float


class SentenceModel(Protocol):
    """Translates sentences of words that carry their readings."""

    @property
    def name(self) -> str:
        """The name under which it was loaded."""

    def translate(self, words: Sequence[SourceWord], *, beam: int = 1) -> tuple[Hypothesis, ...]:
        """Translate one sentence; raises nothing for words it has never seen.

        Args:
            words: Of `source_words`; none gives one empty hypothesis.
            beam: Hypotheses kept at each step, at least 1; 1 takes the likeliest gloss each time.

        Returns:
            One to `beam` hypotheses, best first.
        """

    def translate_all(
        self, sentences: Sequence[Sequence[SourceWord]], *, beam: int = 1
    ) -> tuple[tuple[Hypothesis, ...], ...]:
        """Translate many sentences, faster than one by one; the results are in their order."""
