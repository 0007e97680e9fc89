"""What a sentence model says."""

from __future__ import annotations

from dataclasses import dataclass


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
