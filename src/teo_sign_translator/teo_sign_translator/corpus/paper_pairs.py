"""The sentence pairs: as the paper lists them, and with their words aligned."""

from __future__ import annotations

import hashlib
import re
from dataclasses import dataclass
from pathlib import Path

from teo_sign_translator.errors import TranslationError
from teo_sign_translator.resources import data_file
from teo_sign_translator.tables import read_rows

#: Stand in sentences and glosses for any name and any number.
NAME = "{nombre}"
NUMBER = "{número}"
SLOTS = (NAME, NUMBER)

_ALIGNED = re.compile(r"(?P<gloss>[^()]+)\((?P<words>[^()]*)\)")


@dataclass(frozen=True, slots=True)
class Pair:
    """A Spanish sentence and its glosses, as written."""

    sentence: str
    glosses: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class AlignedPair:
    """A Spanish sentence whose glosses name the words they stand for.

    Attributes:
        sentence: Spanish, with slots.
        glosses: Upper case with `_` for spaces, or a slot.
        sources: For each gloss the words (lower case) that it stands for; empty where nothing in the sentence
            says it.
    """

    sentence: str
    glosses: tuple[str, ...]
    sources: tuple[tuple[str, ...], ...]


def gloss_name(written: str) -> str:
    """A gloss as the look-up table names it: `"Por favor"` is `"POR_FAVOR"`."""
    return written.strip().upper().replace(" ", "_")


def read_pairs(path: Path) -> list[Pair]:
    """Read a file of sentences and glosses.

    Raises:
        TranslationError: "invalid_data", with file and line.
    """
    return [
        Pair(sentence, tuple(gloss.strip() for gloss in glosses.split("/")))
        for _, (sentence, glosses) in read_rows(path, columns=2)
    ]


def paper_pairs() -> list[Pair]:
    """The paper's 39 pairs, in its order."""
    return read_pairs(data_file("paper_pairs.tsv"))


def paper_predictions() -> list[Pair]:
    """What the paper's model predicts at learning rate 0.0001 for the first ten sentences."""
    return read_pairs(data_file("paper_predictions.tsv"))


def read_aligned_pairs(path: Path) -> list[AlignedPair]:
    """Read a file of sentences and aligned glosses; `data/paper_alignment.tsv` explains the notation.

    Raises:
        TranslationError: "invalid_data", with file and line.
    """
    return [
        _aligned(path, number, sentence, glosses)
        for number, (sentence, glosses) in read_rows(path, columns=2)
    ]


def training_pairs() -> list[AlignedPair]:
    """What the shipped model is trained on: the paper's sentences, then the project's."""
    return [pair for path in _training_files() for pair in read_aligned_pairs(path)]


def training_data_hash() -> str:
    """SHA-256 of the files behind `training_pairs`, hexadecimal."""
    digest = hashlib.sha256()
    for path in _training_files():
        digest.update(path.read_bytes())
    return digest.hexdigest()


def _training_files() -> tuple[Path, Path]:
    return data_file("paper_alignment.tsv"), data_file("project_pairs.tsv")


def _aligned(path: Path, number: int, sentence: str, glosses: str) -> AlignedPair:
    names: list[str] = []
    sources: list[tuple[str, ...]] = []
    for written in glosses.split("/"):
        match = _ALIGNED.fullmatch(written)
        if written in SLOTS:
            names.append(written)
            sources.append((written,))
        elif match:
            names.append(gloss_name(match["gloss"]))
            sources.append(tuple(match["words"].lower().split()))
        else:
            raise TranslationError(
                "invalid_data",
                f"{path}, line {number}: expected 'Gloss(words)' or a slot of {SLOTS}, got '{written}'",
            )
    present = sentence.lower()
    lost = [word for words in sources for word in words if word not in present]
    if lost:
        raise TranslationError(
            "invalid_data", f"{path}, line {number}: words not in the sentence: {', '.join(lost)}"
        )
    return AlignedPair(sentence, tuple(names), tuple(sources))
