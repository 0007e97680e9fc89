# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which words of a sentence its glosses say, and which are lost."""

from __future__ import annotations

from pathlib import Path

import pytest
from word_by_word_model import MORPHOLOGY

from teo_sign_training.corpus.generator import Generator
from teo_sign_translator.data_files import data_file
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.pipeline.coverage import Coverage, read_gloss_words
from teo_sign_translator.pointer import OutputGloss
from teo_sign_translator.text.source_words import source_words

COVERAGE = Coverage.load()


def _lost(sentence: str, *glosses: tuple[str, tuple[int, ...]]) -> list[str]:
    words = source_words(sentence, MORPHOLOGY)
    said = [OutputGloss(gloss, sources, 0.9, False) for gloss, sources in glosses]
    return [words[place].form for place in COVERAGE.lost(words, said)]


@pytest.mark.parametrize(
    ("sentence", "glosses", "lost"),
    [
        ("La niña bebe leche.", [("NIÑA", (1,)), ("LECHE", (3,)), ("BEBER", (2,))], []),
        ("La niña bebe leche.", [("NIÑA", (1,)), ("LECHE", (2, 3))], ["bebe"]),
        ("Bebo leche.", [("YO", (0,)), ("LECHE", (1,))], ["bebo"]),
        ("Bebo leche.", [("YO", (0,)), ("LECHE", (1,)), ("BEBER", ())], []),
        ("¿Cuántos años tienes?", [("EDAD", (1,)), ("CUÁNTOS", (0,))], []),
        ("Como porque quiero", [("YO", (0,)), ("COMER", (0,)), ("MOTIVO", (1,)), ("QUERER", (2,))], []),
        ("Gato, gato, gato", [("GATO", (0, 2, 4))], ["gato", "gato"]),
        ("Sé lengua de signos", [("LENGUA_DE_SIGNOS", (3,)), ("SABER", (0,))], []),
        ("Gatos", [("GATO", (0,)), ("GATO", (0,))], []),
        ("¡Qué bonito!", [("BONITO", (1,))], []),
        ("¿Qué comes?", [("COMER", (1,))], ["qué"]),
        ("¿Qué tal el día?", [("DÍA", (3,)), ("BIEN", (0,))], []),
        ("No quiero nada", [("YO", (1,)), ("QUERER", (1,)), ("NADA", (2,))], []),
        ("No quiero pan", [("YO", (1,)), ("PAN", (2,)), ("QUERER", (1,))], ["no"]),
        ("Mañana voy a comer", [("MAÑANA", (0,)), ("COMER", (3,))], []),
        ("Mañana voy a Roma", [("MAÑANA", (0,)), ("ROMA", (3,))], ["voy"]),
        ("Va a hacer frío", [("FUTURO", (0,)), ("FRÍO", (3,))], []),
        ("No sé qué hacer", [("YO", (1,)), ("QUÉ", (2,)), ("SABER", (1,)), ("NO", (0,))], ["hacer"]),
    ],
)
def test_a_gloss_says_its_own_words_and_those_that_are_listed(
    sentence: str, glosses: list[tuple[str, tuple[int, ...]]], lost: list[str]
) -> None:
    assert _lost(sentence, *glosses) == lost


@pytest.mark.parametrize("line", ["edad\taño", "EDAD\taño\nEDAD\tvejez", "EDAD", "EDAD\taño,,vejez"])
def test_a_damaged_list_is_refused_with_file_and_line(tmp_path: Path, line: str) -> None:
    path = tmp_path / "gloss_words.tsv"
    path.write_text(line, encoding="utf-8")
    with pytest.raises(TranslationError, match=r"gloss_words\.tsv, line") as error:
        read_gloss_words(path)
    assert error.value.code == "invalid_data"


def test_what_the_grammar_translates_loses_no_word() -> None:
    pairs = list(Generator.load(data_file("grammar"), MORPHOLOGY).pairs(3000, seed=7))
    lossy = []
    for pair in pairs:
        glosses = zip(pair.glosses, pair.alignment, strict=True)
        lost = _lost(pair.text, *glosses)
        if lost:
            lossy.append(f"{pair.text} -> {' '.join(pair.glosses)}: {lost}")
    # The odd rule leaves a word to the context; many would be a list that the grammar has outgrown.
    assert len(lossy) < 0.01 * len(pairs), "\n".join(lossy[:20])
