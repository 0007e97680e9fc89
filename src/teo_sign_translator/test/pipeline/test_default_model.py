# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the default model must do whatever it has learned: paper, names, numbers, any typing."""

from __future__ import annotations

from collections.abc import Sequence

import pytest
from loaded import TEXT, morphology, read, translator
from small_language import glosses_of
from ways_of_typing import WAYS_OF_TYPING

from teo_sign_training.corpus import Pair
from teo_sign_training.corpus.generator import Generator
from teo_sign_training.corpus.paper_pairs import memorised_pairs, paper_pairs
from teo_sign_training.fitting.fitting import ZOO
from teo_sign_translator.model_files import available_models, models_directory, read_card
from teo_sign_translator.morphology import gloss_name
from teo_sign_translator.pointer import load_sentence_model
from teo_sign_translator.pointer.config import POINTER, NetworkConfig


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


def _right(pairs: Sequence[Pair]) -> int:
    """How many pairs the model alone translates exactly."""
    said = load_sentence_model(POINTER).translate_all([read(pair.text) for pair in pairs])
    return sum(glosses_of(best) == pair.glosses for pair, (best, *_) in zip(pairs, said, strict=True))


def test_the_default_model_is_the_pointer_of_the_zoo() -> None:
    assert translator().name == POINTER
    assert POINTER in available_models()
    assert NetworkConfig(**read_card(POINTER)["network"]) == ZOO[POINTER]


def test_the_projects_pairs_come_out_exactly() -> None:
    pairs = memorised_pairs(read)
    assert _right(pairs) == len(pairs)


@pytest.mark.slow
def test_the_scores_on_the_card_hold_for_sentences_made_anew() -> None:
    scores = read_card(POINTER)["result"]["scores"]
    pairs = Generator.load(TEXT / "grammar", morphology()).pairs(5000, seed=7)
    made = [pair for pair in pairs if pair.split in scores]
    claimed = sum(scores[pair.split]["exact"] for pair in made)
    # Three standard deviations of a share of 0.94.
    assert len(made) == 350
    assert _right(made) > claimed - 13


def test_all_models_together_are_under_twenty_megabytes() -> None:
    assert sum(path.stat().st_size for path in models_directory().iterdir()) < 20e6
