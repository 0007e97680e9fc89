# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from functools import cache

import pytest
from loaded import TEXT, morphology, read, translator

from teo_sign_training.corpus.generator import Generator
from teo_sign_training.corpus.paper_pairs import memorised_pairs
from teo_sign_training.fitting.fitting import ZOO
from teo_sign_translator.model_files import available_models, models_directory, read_card
from teo_sign_translator.pointer import load_sentence_model
from teo_sign_translator.pointer.config import POINTER, NetworkConfig
from teo_sign_translator.pointer.decoding import SentenceModel


@cache
def model() -> SentenceModel:
    return load_sentence_model(POINTER)


def _translated(sentence: str) -> str:
    return " ".join(gloss.gloss for gloss in model().translate(read(sentence))[0].glosses)


def test_the_default_model_is_the_pointer_of_the_zoo() -> None:
    assert translator().name == POINTER
    assert POINTER in available_models()
    assert NetworkConfig(**read_card(POINTER)["network"]) == ZOO[POINTER]


def test_the_projects_pairs_come_out_exactly() -> None:
    pairs = memorised_pairs(read)
    assert [pair.text for pair in pairs if _translated(pair.text) != " ".join(pair.glosses)] == []


@pytest.mark.slow
def test_the_scores_on_the_card_hold_for_sentences_made_anew() -> None:
    scores = read_card(POINTER)["result"]["scores"]
    pairs = Generator.load(TEXT / "grammar", morphology()).pairs(5000, seed=7)
    made = [pair for pair in pairs if pair.split in scores]
    claimed = sum(scores[pair.split]["exact"] for pair in made)
    right = sum(_translated(pair.text) == " ".join(pair.glosses) for pair in made)
    # Three standard deviations of a share of 0.94.
    assert len(made) == 350
    assert right > claimed - 13


def test_all_models_together_are_under_twenty_megabytes() -> None:
    assert sum(path.stat().st_size for path in models_directory().iterdir()) < 20e6
