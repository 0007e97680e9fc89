# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from pathlib import Path

import pytest
from refusals import refused

from teo_sign_training.corpus.paper_pairs import read_aligned_pairs
from teo_sign_training.lstm256.word_by_word import GlossList
from teo_sign_translator.errors import TranslationError


def test_a_word_is_found_without_its_accents_an_accent_that_was_typed_counts_and_phrases_come_first() -> None:
    glosses = GlossList.load()
    assert [glosses.find(typed).gloss for typed in ("adiós", "adios")] == ["ADIÓS", "ADIÓS"]
    assert glosses.find("te") is not None
    assert glosses.find("té") is None
    assert glosses.find("él") != glosses.find("el")
    found = glosses.find_longest(["por", "favor", "hola"])
    assert found is not None
    assert (found[0].gloss, found[1]) == ("POR_FAVOR", 2)


def test_every_gloss_is_a_name_that_the_look_up_table_can_hold() -> None:
    glosses = GlossList.load()
    for entry in map(glosses.find, glosses):
        assert entry is not None
        assert entry.gloss == entry.gloss.upper()
        assert entry.function or entry.gloss.replace("_", "").isalpha()


@pytest.mark.parametrize(
    "line",
    [
        "HOLA\tword",
        "HOLA\tgreeting\thola",
        "-\tword\tel",
        "HOLA\tfunction\thola",
        "A B\tword\ta",
        "A\tword\ta, a",
    ],
)
def test_a_damaged_list_is_refused_with_file_and_line(tmp_path: Path, line: str) -> None:
    path = tmp_path / "glosses.tsv"
    path.write_text(f"# comment\nADIÓS\tword\tadiós\n{line}\n", encoding="utf-8")
    with refused("invalid_data", r"glosses\.tsv, line 3"):
        GlossList.load(path)


@pytest.mark.parametrize("glosses", ["Tú", "Tú(vas)/", "Tú(nada)", "Tú(vas", "{otro}"])
def test_a_damaged_alignment_is_refused_with_file_and_line(tmp_path: Path, glosses: str) -> None:
    path = tmp_path / "pairs.tsv"
    path.write_text(f"¿Tú vas?\t{glosses}\n", encoding="utf-8")
    with pytest.raises(TranslationError, match=r"pairs\.tsv, line 1"):
        read_aligned_pairs(path)
