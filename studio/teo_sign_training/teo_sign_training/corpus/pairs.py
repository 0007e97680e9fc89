# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Sentence pairs as files: a line holds a sentence, its glosses and their alignment."""

from __future__ import annotations

import hashlib
import random
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from teo_common.atomic_files import write_atomically
from teo_common.text_folding import folded
from teo_sign_translator.data_files import invalid_line
from teo_sign_translator.errors import TranslationError

_COLUMNS = ("text", "glosses", "alignment", "rule", "split")

#: `test_words`: known templates with words that train never has; `test_templates`: known words in templates
#: that train never has; `test_both`: neither was seen; `test_constructions`: known words in constructions
#: that no sentence of train has, if the corpus was made without them.
SPLITS = ("train", "dev", "test_words", "test_templates", "test_both", "test_constructions")


@dataclass(frozen=True, slots=True)
class Pair:
    """A sentence and its translation.

    Attributes:
        text: As people write it, with accents and marks.
        glosses: In signing order; upper case with accents, `_` for spaces, numbers in digits.
        alignment: For each gloss the indices into `source_words(text)` that it stands for; empty for none.
        rule: Name of the template it was made from, `family.rule` and what fills the rule; `paper` for the
            paper's and the project's own pairs.
        split: One of `SPLITS`.
    """

    text: str
    glosses: tuple[str, ...]
    alignment: tuple[tuple[int, ...], ...]
    rule: str
    split: str


def write_pairs(path: Path, pairs: Iterable[Pair]) -> None:
    """Write a corpus file; whoever reads it meanwhile finds the old one or the whole new one."""
    lines = ["\t".join(_COLUMNS)]
    lines += (
        "\t".join(
            (
                pair.text,
                " ".join(pair.glosses),
                " ".join(",".join(map(str, places)) or "-" for places in pair.alignment),
                pair.rule,
                pair.split,
            )
        )
        for pair in pairs
    )
    path.parent.mkdir(parents=True, exist_ok=True)
    write_atomically(path, ("\n".join(lines) + "\n").encode())


def read_pairs(path: Path) -> Iterator[Pair]:
    """Yield the pairs of a corpus file.

    Raises:
        TranslationError: "invalid_data", with file and line, if a line is not what `write_pairs` writes.
    """
    try:
        with path.open(encoding="utf-8") as file:
            for number, line in enumerate(file, start=1):
                fields = line.rstrip("\n").split("\t")
                if number == 1:
                    if tuple(fields) != _COLUMNS:
                        raise invalid_line(path, number, f"the header {_COLUMNS}", f"'{line.strip()}'")
                    continue
                yield _pair(path, number, fields)
    except (OSError, UnicodeDecodeError) as error:
        raise TranslationError("invalid_data", f"{path}: expected a readable UTF-8 file: {error}") from error


def _pair(path: Path, number: int, fields: list[str]) -> Pair:
    if len(fields) != len(_COLUMNS):
        raise invalid_line(path, number, f"{len(_COLUMNS)} columns", f"{len(fields)}")
    text, glosses, alignment, rule, split = fields
    if split not in SPLITS:
        raise invalid_line(path, number, f"one of {SPLITS}", f"'{split.strip()}'")
    try:
        places = tuple(
            () if entry == "-" else tuple(map(int, entry.split(","))) for entry in alignment.split()
        )
    except ValueError:
        raise invalid_line(path, number, "word numbers or '-'", f"'{alignment.strip()}'") from None
    pair = Pair(text, tuple(glosses.split()), places, rule, split)
    if len(pair.alignment) != len(pair.glosses):
        raise invalid_line(path, number, f"{len(pair.glosses)} alignments, one a gloss", f"{len(places)}")
    return pair


def _corpus_files(corpus: Path) -> tuple[Path, ...]:
    """The files of a corpus: itself, or the `.tsv` files of the folder."""
    files = (corpus,) if corpus.is_file() else tuple(sorted(corpus.glob("*.tsv")))
    if not files:
        raise TranslationError(
            "invalid_data",
            f"expected a corpus file, or a folder with .tsv files, got {corpus}: make one with "
            "`ros2 run teo_sign_translator generate_corpus`",
        )
    return files


def read_splits(corpus: Path) -> dict[str, list[Pair]]:
    """All pairs by split; a split may be empty.

    Raises:
        TranslationError: "invalid_data", with file and line.
    """
    splits: dict[str, list[Pair]] = {split: [] for split in SPLITS}
    for path in _corpus_files(corpus):
        for pair in read_pairs(path):
            splits[pair.split].append(pair)
    return splits


def corpus_hash(corpus: Path) -> str:
    """SHA-256 over the files of a corpus in the order of their names, hexadecimal."""
    digest = hashlib.sha256()
    for path in _corpus_files(corpus):
        digest.update(path.read_bytes())
    return digest.hexdigest()


def sample(pairs: list[Pair], count: int | None, seed: int) -> list[Pair]:
    """Pairs chosen at random, the same for the same seed; all of them if there are no more than `count`."""
    if count is None or count >= len(pairs):
        return pairs
    return random.Random(seed).sample(pairs, count)


def without(pairs: list[Pair], sentences: Iterable[str]) -> list[Pair]:
    """The pairs whose text, however typed, is none of the sentences."""
    unwanted = set(map(folded, sentences))
    return [pair for pair in pairs if folded(pair.text) not in unwanted]
