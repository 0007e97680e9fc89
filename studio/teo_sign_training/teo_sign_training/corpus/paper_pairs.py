# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The paper's and the project's own pairs: as published, and as corpus pairs."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from teo_common.text_folding import fold
from teo_sign_training.corpus.aligned_pairs import (
    NAME,
    NUMBER,
    SLOTS,
    AlignedPair,
    training_files,
    training_pairs,
)
from teo_sign_training.corpus.pairs_file import Pair
from teo_sign_translator.data_files import data_file, read_rows
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.morphology import Morphology
from teo_sign_translator.text.source_words import SourceWord, source_words

#: Fill the slots of the pairs; common names of different lengths, and ages.
_NAMES = (
    "Ana",
    "Juan",
    "Lucía",
    "Pedro",
    "María",
    "Carlos",
    "Sofía",
    "Miguel",
    "Elena",
    "Javier",
    "Carmen",
    "David",
)
_NUMBERS = ("7", "12", "23", "35", "41", "8", "64", "19", "nueve", "diez", "treinta", "dieciocho")


@dataclass(frozen=True, slots=True)
class PublishedPair:
    """A Spanish sentence and its glosses, as written."""

    sentence: str
    glosses: tuple[str, ...]


def read_pairs(path: Path) -> list[PublishedPair]:
    """Read a file of sentences and glosses.

    Raises:
        TranslationError: "invalid_data", with file and line.
    """
    return [
        PublishedPair(sentence, tuple(gloss.strip() for gloss in glosses.split("/")))
        for _, (sentence, glosses) in read_rows(path, columns=2)
    ]


def paper_pairs() -> list[PublishedPair]:
    """The paper's 39 pairs, in its order."""
    return read_pairs(data_file("paper_pairs.tsv"))


def paper_predictions() -> list[PublishedPair]:
    """What the paper's model predicts at learning rate 0.0001 for the first ten sentences."""
    return read_pairs(data_file("paper_predictions.tsv"))


def training_data_hash() -> str:
    """SHA-256 of the files behind `training_pairs`, hexadecimal."""
    digest = hashlib.sha256()
    for path in training_files():
        digest.update(path.read_bytes())
    return digest.hexdigest()


def own_pairs(morphology: Morphology) -> Iterator[Pair]:
    """Yield the pairs that the translator must know exactly, slots filled with names and numbers."""
    read = partial(source_words, morphology=morphology)
    for pair in training_pairs(morphology.folder):
        fillings = list(zip(_NAMES, _NUMBERS, strict=True)) if {*SLOTS} & {*pair.glosses} else [("", "")]
        for name, number in fillings:
            yield filled(pair, name, number, read)


def filled(pair: AlignedPair, name: str, number: str, read: Callable[[str], Sequence[SourceWord]]) -> Pair:
    """A pair whose slots hold a name and a number; `read` makes words of its sentence.

    Raises:
        TranslationError: "invalid_data" if a gloss stands for a word that is not read from the sentence.
    """
    sentence = pair.sentence.replace(NAME, name).replace(NUMBER, number)
    words = read(sentence)
    glosses: list[str] = []
    places: list[tuple[int, ...]] = []
    for gloss, sources in zip(pair.glosses, pair.sources, strict=True):
        if gloss in SLOTS:
            place = _slot_place(words, name if gloss == NAME else number, sentence)
            glosses.append(name.upper() if gloss == NAME else words[place].form)
            places.append((place,))
        else:
            glosses.append(gloss)
            places.append(tuple(sorted({_place(words, source, sentence) for source in sources})))
    return Pair(sentence, tuple(glosses), tuple(places), "paper", "train")


def _place(words: Sequence[SourceWord], source: str, sentence: str) -> int:
    """The last word with a form: "Ana, ¿quién es Ana?" asks about the second one."""
    places = [place for place, word in enumerate(words) if word.text.lower() == source]
    places = places or [place for place, word in enumerate(words) if fold(word.form) == fold(source)]
    # Words that are read as one, such as "por favor", stand in one place.
    places = places or [place for place, word in enumerate(words) if fold(source) in fold(word.form).split()]
    if not places:
        raise TranslationError(
            "invalid_data",
            f"expected '{source}' among the words of '{sentence}', got {[word.form for word in words]}",
        )
    return places[-1]


def _slot_place(words: Sequence[SourceWord], filler: str, sentence: str) -> int:
    for place, word in enumerate(words):
        if word.text == filler or word.form == filler.lower():
            return place
    raise TranslationError("invalid_data", f"expected '{filler}' to be one word of '{sentence}'")
