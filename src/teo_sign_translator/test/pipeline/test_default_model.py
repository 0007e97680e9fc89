# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the default model must do whatever it has learned: paper, names, numbers, any typing."""

from __future__ import annotations

import pytest
from loaded import translator
from ways_of_typing import WAYS_OF_TYPING

from teo_sign_training.corpus.paper_pairs import paper_pairs
from teo_sign_translator.morphology import gloss_name


@pytest.mark.parametrize("way", WAYS_OF_TYPING)
def test_the_papers_39_sentences_are_exact(way: str) -> None:
    expected = {pair.sentence: " ".join(map(gloss_name, pair.glosses)) for pair in paper_pairs()}
    got = {sentence: str(translator().translate(WAYS_OF_TYPING[way](sentence))) for sentence in expected}
    assert got == expected


@pytest.mark.parametrize(
    ("text", "glosses"),
    [
        ("Hola, me llamo Ana. ¿Qué tal?", "HOLA MI NOMBRE A-N-A TÚ BIEN"),
        ("Me llamo Al.", "MI NOMBRE A-L"),
        ("Tengo treinta y cinco años", "YO EDAD 35"),
        ("Mi correo es eva@uc3m.es", "CORREO MI E-V-A ARROBA U-C 3 M PUNTO E-S"),
    ],
)
def test_names_are_spelled_and_numbers_counted(text: str, glosses: str) -> None:
    assert str(translator().translate(text)) == glosses


def test_words_that_no_list_holds_are_carried_over() -> None:
    glosses = str(translator().translate("Mañana compro un flinflú.")).split()
    assert "FLINFLÚ" in glosses or "F-L-I-N-F-L-U" in glosses


def test_what_makes_no_sentence_is_called_uncertain() -> None:
    (sentence,) = translator().translate("blim porque cuyo tras ñofu grabitón").sentences
    assert sentence.uncertain
