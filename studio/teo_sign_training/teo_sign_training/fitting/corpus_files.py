# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The pairs of a corpus folder, by split."""

from __future__ import annotations

import hashlib
import random
from collections.abc import Iterable
from pathlib import Path

from teo_common.text_folding import folded
from teo_sign_training.corpus import SPLITS, Pair, read_pairs
from teo_sign_translator.errors import TranslationError


def corpus_files(corpus: Path) -> tuple[Path, ...]:
    """The files of a corpus: itself, or the `.tsv` files of the folder.

    Raises:
        TranslationError: "invalid_data" if there is none.
    """
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
    for path in corpus_files(corpus):
        for pair in read_pairs(path):
            splits[pair.split].append(pair)
    return splits


def corpus_hash(corpus: Path) -> str:
    """SHA-256 over the files of a corpus in the order of their names, hexadecimal."""
    digest = hashlib.sha256()
    for path in corpus_files(corpus):
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
