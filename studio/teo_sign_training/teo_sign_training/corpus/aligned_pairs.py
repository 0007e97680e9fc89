# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Sentences whose translation is given, the paper's and the project's, with their words aligned."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from teo_sign_translator.data_files import data_file, invalid_line, read_rows
from teo_sign_translator.morphology import gloss_name

#: Stand in sentences and glosses for any name and any number.
NAME = "{nombre}"
NUMBER = "{número}"
SLOTS = (NAME, NUMBER)

_ALIGNED = re.compile(r"(?P<gloss>[^()]+)\((?P<words>[^()]*)\)")


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


def read_aligned_pairs(path: Path) -> list[AlignedPair]:
    """Read a file of sentences and aligned glosses; `text/paper_alignment.tsv` explains the notation.

    Raises:
        TranslationError: "invalid_data", with file and line.
    """
    return [
        _aligned(path, number, sentence, glosses)
        for number, (sentence, glosses) in read_rows(path, columns=2)
    ]


def training_pairs(folder: Path | None = None) -> list[AlignedPair]:
    """What the shipped model of a language must know by heart: the paper's sentences, then the project's.

    Args:
        folder: The language's text folder, by default that of the default language; one without either
            file has no such sentences.
    """
    return [pair for path in training_files(folder) for pair in read_aligned_pairs(path)]


def training_files(folder: Path | None = None) -> list[Path]:
    """Files of the sentences whose translation is given, as far as a language has them."""
    paths = (
        (folder or data_file("")) / "paper_alignment.tsv",
        (folder or data_file("")) / "project_pairs.tsv",
    )
    return [path for path in paths if path.is_file()]


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
            raise invalid_line(path, number, f"'Gloss(words)' or a slot of {SLOTS}", f"'{written}'")
    present = sentence.lower()
    lost = [word for words in sources for word in words if word not in present]
    if lost:
        raise invalid_line(path, number, "words of the sentence", ", ".join(lost))
    return AlignedPair(sentence, tuple(names), tuple(sources))
