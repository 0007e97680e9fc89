# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Models in files: the same after loading, and refused by name where they are damaged."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import safetensors.numpy
from refusals import refused
from small_language import fit_small, glosses_of, read, sentence_pairs, small_config, small_model

from teo_sign_training.fitting.fitting import Fit
from teo_sign_translator.model_files import available_models
from teo_sign_translator.pointer import load_sentence_model
from teo_sign_translator.pointer.config import POINTER
from teo_sign_translator.pointer.decoding import save_sentence_model
from teo_sign_translator.pointer.ensemble import member_weights
from teo_sign_translator.pointer.vocabulary import START_INDEX


@pytest.fixture(scope="module")
def trained() -> Fit:
    return fit_small(POINTER, sentence_pairs(50), epochs=2)


def _save(trained: Fit, directory: Path) -> None:
    save_sentence_model(
        "small",
        directory,
        config=small_config(POINTER),
        vocabulary=trained.vocabulary,
        weights=trained.weights,
        card={},
    )


def test_a_saved_model_says_the_same_after_loading(trained: Fit, tmp_path: Path) -> None:
    _save(trained, tmp_path)
    model = small_model(POINTER, trained)
    assert available_models(tmp_path) == ("small",)
    loaded = load_sentence_model("small", tmp_path)
    for pair in sentence_pairs(10):
        (expected,), (got,) = model.translate(read(pair.text)), loaded.translate(read(pair.text))
        assert glosses_of(expected) == glosses_of(got)
        assert expected.log_probability == pytest.approx(got.log_probability, abs=0.02)  # half precision
    assert sorted(path.name for path in tmp_path.iterdir()) == ["small.json", "small.safetensors"]


def test_two_networks_in_one_file_say_the_mean_of_what_each_says(trained: Fit, tmp_path: Path) -> None:
    other = fit_small(POINTER, sentence_pairs(50), epochs=1, seed=7)
    assert other.vocabulary == trained.vocabulary
    save_sentence_model(
        "both",
        tmp_path,
        config=dataclasses.replace(small_config(POINTER), members=2),
        vocabulary=trained.vocabulary,
        weights=member_weights([trained.weights, other.weights]),
        card={},
    )
    loaded = load_sentence_model("both", tmp_path)
    alone = [small_model(POINTER, each) for each in (trained, other)]
    for pair in sentence_pairs(10):
        words = read(pair.text)
        steps = []
        for model in (*alone, loaded):
            memory = model.arrays.encode([words])
            steps.append(model.arrays.step(memory, np.array([START_INDEX]), memory.first).probability)
        np.testing.assert_allclose(steps[2], (steps[0] + steps[1]) / 2, atol=2e-3)  # half precision
        assert loaded.translate(words, beam=3)[0].log_probability <= 0.0


def test_a_file_that_lacks_a_network_is_refused(trained: Fit, tmp_path: Path) -> None:
    config = dataclasses.replace(small_config(POINTER), members=2)
    weights = member_weights([trained.weights])
    save_sentence_model(
        "half", tmp_path, config=config, vocabulary=trained.vocabulary, weights=weights, card={}
    )
    with refused("invalid_model", "expected finite weights"):
        load_sentence_model("half", tmp_path)


@pytest.mark.parametrize("name", ["large", "../small", ""])
def test_an_unknown_model_is_refused_with_those_available(trained: Fit, tmp_path: Path, name: str) -> None:
    _save(trained, tmp_path)
    with refused("unknown_model", "small"):
        load_sentence_model(name, tmp_path)


def _cut(directory: Path) -> None:
    path = directory / "small.safetensors"
    path.write_bytes(path.read_bytes()[:-100])


def _no_card(directory: Path) -> None:
    (directory / "small.json").unlink()


def _spoil(text: str) -> Callable[[Path], None]:
    return lambda directory: (directory / "small.json").write_text(text, encoding="utf-8") and None


def _card(**values: object) -> Callable[[Path], None]:
    def change(directory: Path) -> None:
        path = directory / "small.json"
        path.write_text(json.dumps(json.loads(path.read_text("utf-8")) | values), encoding="utf-8")

    return change


def _not_a_number(directory: Path) -> None:
    path = directory / "small.safetensors"
    weights = safetensors.numpy.load_file(path)
    weights["output.bias"][0] = np.nan
    path.write_bytes(safetensors.numpy.save(weights))


@pytest.mark.parametrize(
    "damage",
    [
        _cut,
        _no_card,
        _not_a_number,
        _spoil("{"),
        _card(schema=99),
        _card(network={"hidden": 16}),
        _card(network={"width": 16}),
        _card(lexis={}),
    ],
)
def test_a_damaged_model_is_refused(trained: Fit, tmp_path: Path, damage: Callable[[Path], None]) -> None:
    _save(trained, tmp_path)
    damage(tmp_path)
    with refused("invalid_model"):
        load_sentence_model("small", tmp_path)
