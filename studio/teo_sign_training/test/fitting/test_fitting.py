# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Training a network: the same for the same seed, ended in time, and refused where it makes no sense."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest
import torch
from refusals import refused
from small_language import NOUNS, fit_small, read, sentence_pairs, small_config

from teo_sign_training.corpus import Pair
from teo_sign_training.fitting.fitting import Start, TrainingConfig, fit
from teo_sign_training.fitting.network import named_device, one_thread
from teo_sign_translator.pointer.config import POINTER, NetworkConfig


def test_the_same_seed_gives_the_same_weights_and_another_seed_others() -> None:
    pairs = sentence_pairs(60)
    noisy = {"epochs": 2, "dropout": 0.2, "rare_word": 5.0, "clean": 0.3}
    first, second = fit_small(POINTER, pairs, **noisy), fit_small(POINTER, pairs, **noisy)
    other = fit_small(POINTER, pairs, **noisy, seed=7)
    assert first.losses == second.losses != other.losses
    for name, weights in first.weights.items():
        np.testing.assert_array_equal(weights, second.weights[name])


def test_training_stops_when_the_development_pairs_get_no_better() -> None:
    pairs = sentence_pairs(20)
    unlike = [
        dataclasses.replace(pair, glosses=pair.glosses[::-1], alignment=pair.alignment[::-1])
        for pair in pairs
    ]
    config = TrainingConfig(epochs=60, patience=2, batch_size=8, learning_rate=0.01, clean=1.0, rare_word=0.0)
    trained = fit(pairs, unlike, [], read, small_config(POINTER), config)
    assert len(trained.dev_losses) == trained.best_epoch + 2 < 60
    assert trained.dev_losses[trained.best_epoch - 1] == min(trained.dev_losses)


def test_a_training_goes_on_from_the_weights_of_a_network_and_keeps_its_words() -> None:
    pairs = sentence_pairs(60)
    before = fit_small(POINTER, pairs, epochs=12)
    few = TrainingConfig(epochs=1, batch_size=16, learning_rate=0.001, dropout=0.0, clean=1.0, rare_word=0.0)
    start = Start(before.vocabulary, before.weights)
    # Fewer pairs, with fewer words than the network knows.
    after = fit(pairs[:20], [], [], read, small_config(POINTER), few, start=start)
    assert after.vocabulary == before.vocabulary
    assert after.losses[0] < 0.2 * fit_small(POINTER, pairs, epochs=1).losses[0]
    assert any(not np.array_equal(after.weights[name], weights) for name, weights in before.weights.items())


def test_a_gloss_that_is_always_a_copy_has_no_place_in_the_closed_list() -> None:
    trained = fit_small(POINTER, sentence_pairs(50), epochs=1)
    assert set(trained.vocabulary.glosses) == {"<end>", "<start>", "YO", "TÚ"}
    assert set(NOUNS) <= {
        gloss.lower() for gloss in fit_small("lstm", sentence_pairs(80), epochs=1).vocabulary.glosses
    }


def test_pairs_that_cannot_be_said_are_counted_and_left_out() -> None:
    strange = Pair("como el pan .", ("YO", "BOCADILLO", "COMER"), ((0,), (2,), (0,)), "paper", "train")
    trained = fit_small(POINTER, [*sentence_pairs(50), strange], epochs=1)
    assert (trained.pairs, trained.left_out) == (50, 1)


@pytest.mark.parametrize(
    ("pairs", "code"),
    [([], "invalid_config"), ([Pair("como .", ("YO",), ((5,),), "paper", "train")], "invalid_data")],
)
def test_no_pairs_and_an_alignment_outside_the_sentence_are_refused(pairs: list[Pair], code: str) -> None:
    with refused(code):
        fit_small(POINTER, pairs, epochs=1)


@pytest.mark.parametrize(
    "change",
    [{"cell": "transformer"}, {"hidden": 0}, {"layout": "equal_length", "attention": True}, {"copy": True}],
)
def test_a_network_that_cannot_be_built_is_refused(change: dict[str, Any]) -> None:
    with refused("invalid_config"):
        NetworkConfig(**change)


@pytest.mark.parametrize(
    "change", [{"epochs": 0}, {"learning_rate": float("nan")}, {"dropout": 1.0}, {"clean": -0.1}]
)
def test_a_training_that_cannot_be_done_is_refused(change: dict[str, Any]) -> None:
    with refused("invalid_config"):
        TrainingConfig(**change)


@pytest.mark.parametrize("name", ["gpu", "", "cuda:99", "meta:x"])
def test_a_device_that_is_not_there_is_refused_with_its_name(name: str) -> None:
    with refused("invalid_config", f"got '{name}'"):
        named_device(name)


def test_threads_are_given_back_after_a_training_that_fails() -> None:
    before = torch.get_num_threads()
    with pytest.raises(ValueError, match="on purpose"), one_thread():
        assert torch.get_num_threads() == 1
        raise ValueError("on purpose")
    assert torch.get_num_threads() == before
