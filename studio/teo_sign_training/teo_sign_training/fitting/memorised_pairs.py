# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The paper's and the project's own pairs as training pairs: every model has to know them by heart."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

from teo_common.text_folding import without_accents
from teo_sign_training.corpus.aligned_pairs import training_pairs
from teo_sign_training.corpus.pairs_file import Pair
from teo_sign_training.corpus.paper_pairs import filled, paper_pairs
from teo_sign_training.fitting.examples import Reader
from teo_sign_translator.morphology import gloss_name
from teo_sign_translator.pointer.decoding import SentenceModel

#: What fills the slots. A few are enough: the corpus shows hundreds of names and numbers in other sentences.
_NAMES = ("Ana", "Pedro", "Lucía", "Juan", "María", "Carlos")
_NUMBERS = ("7", "siete", "12", "treinta y cinco", "40", "veintitrés")

_NOT_LETTERS = re.compile(r"[¿?¡!.,:;…]+")


def memorised_pairs(read: Reader, folder: Path | None = None) -> tuple[Pair, ...]:
    """All of `training_pairs`, their slots filled in several ways, with and without a full stop.

    Args:
        read: How sentences become words.
        folder: The language's text folder; by default that of the default language.

    Raises:
        TranslationError: "invalid_data" if a gloss stands for a word that is not read from its sentence.
    """
    return tuple(
        dict.fromkeys(
            filled(replace(pair, sentence=pair.sentence + stop), name, number, read)
            for pair in training_pairs(folder)
            for name, number in zip(_NAMES, _NUMBERS, strict=True)
            for stop in ("", "" if pair.sentence[-1] in "?!…" else ".")
        )
    )


def ways_of_typing(sentence: str) -> tuple[str, ...]:
    """As given, without accents, without marks, and with nothing but lower case letters."""
    bare = " ".join(_NOT_LETTERS.sub(" ", sentence).split())
    return tuple(dict.fromkeys([sentence, without_accents(sentence), bare, without_accents(bare).lower()]))


def not_memorised(model: SentenceModel, read: Reader) -> tuple[str, ...]:
    """The paper's sentences, in all `ways_of_typing`, that a model does not translate as published.

    Returns:
        `sentence -> glosses that came out`, none if all are right.
    """
    wrong: list[str] = []
    for pair in paper_pairs():
        expected = tuple("7" if gloss == "X" else gloss_name(gloss) for gloss in pair.glosses)
        for sentence in ways_of_typing(pair.sentence.replace(" X ", " 7 ")):
            got = tuple(gloss.gloss for gloss in model.translate(read(sentence))[0].glosses)
            if got != expected:
                wrong.append(f"{sentence} -> {' '.join(got)}")
    return tuple(wrong)
