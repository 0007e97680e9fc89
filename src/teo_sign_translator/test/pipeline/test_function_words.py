# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which words a translation may leave out."""

from __future__ import annotations

from pathlib import Path

import pytest
from word_by_word_model import MORPHOLOGY

from teo_sign_translator.errors import TranslationError
from teo_sign_translator.pipeline.coverage import FunctionWords
from teo_sign_translator.text.source_words import source_words


@pytest.mark.parametrize(
    ("sentence", "kept"),
    [
        ("La niña bebe la leche.", "niña bebe leche"),
        ("Soy de Sevilla, pero vivo en Madrid.", "Sevilla pero vivo Madrid"),
        ("¿Quién ha roto una ventana?", "Quién roto ventana"),
        ("esta cansada", "cansada"),
        ("Nunca voy sin ti", "Nunca voy sin ti"),
        ("No se lo digas", "No digas"),
        ("7 gatos y perros", "7 gatos perros"),
    ],
)
def test_articles_copulas_auxiliaries_and_most_prepositions_may_be_left_out(sentence: str, kept: str) -> None:
    words = FunctionWords.load()
    read = source_words(sentence, MORPHOLOGY)
    assert " ".join(word.text for word in read if not words.may_be_left_out(word)) == kept


@pytest.mark.parametrize("line", ["DEF\tel", "PREP\ta\nPREP\tde", "PREP"])
def test_a_damaged_list_is_refused_with_file_and_line(tmp_path: Path, line: str) -> None:
    path = tmp_path / "function_words.tsv"
    path.write_text(line, encoding="utf-8")
    with pytest.raises(TranslationError, match=r"function_words\.tsv, line") as error:
        FunctionWords.load(path)
    assert error.value.code == "invalid_data"
