# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Models in files: the same after loading, and refused by name where they are damaged."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import pytest
import safetensors.numpy
from made_models import VOCABULARY, made_weights, small_config
from numpy.typing import NDArray
from refusals import refused
from small_language import glosses_of, read

from teo_sign_translator.model_files import available_models
from teo_sign_translator.pointer import SentenceModel, load_sentence_model
from teo_sign_translator.pointer.array_model import ArrayModel
from teo_sign_translator.pointer.decoding import save_sentence_model
from teo_sign_translator.pointer.ensemble import member_weights
from teo_sign_translator.pointer.vocabulary import START_INDEX
from teo_sign_translator.text.source_word import SourceWord

TEXTS = ("Ana no come el pan .", "como los vasos .", "Zoraida lee")


def _save(directory: Path, name: str = "small", *, seeds: Sequence[int] = (1,), members: int = 1) -> None:
    config = small_config()
    weights = [made_weights(config, seed) for seed in seeds]
    save_sentence_model(
        name,
        directory,
        config=small_config(members=members),
        vocabulary=VOCABULARY,
        weights=weights[0] if members == 1 else member_weights(weights),
        card={},
    )


def _first_step(directory: Path, name: str, words: Sequence[SourceWord]) -> NDArray[np.float32]:
    """Probabilities of the first gloss."""
    arrays = load_sentence_model(name, directory).arrays
    memory = arrays.encode([words])
    return arrays.step(memory, np.array([START_INDEX]), memory.first).probability


def test_a_saved_model_says_the_same_after_loading(tmp_path: Path) -> None:
    _save(tmp_path)
    assert available_models(tmp_path) == ("small",)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["small.json", "small.safetensors"]
    config = small_config()
    made = SentenceModel("small", ArrayModel(config, VOCABULARY, made_weights(config)))
    loaded = load_sentence_model("small", tmp_path)
    for text in TEXTS:
        (expected,), (got,) = made.translate(read(text)), loaded.translate(read(text))
        assert glosses_of(expected) == glosses_of(got)
        assert expected.log_probability == pytest.approx(got.log_probability, abs=0.02)  # half precision


def test_two_networks_in_one_file_say_the_mean_of_what_each_says(tmp_path: Path) -> None:
    _save(tmp_path, "one", seeds=[1])
    _save(tmp_path, "other", seeds=[2])
    _save(tmp_path, "both", seeds=[1, 2], members=2)
    for text in TEXTS:
        one, other, both = (_first_step(tmp_path, name, read(text)) for name in ("one", "other", "both"))
        np.testing.assert_allclose(both, (one + other) / 2, atol=2e-3)  # half precision
    assert load_sentence_model("both", tmp_path).translate(read(TEXTS[0]), beam=3)[0].log_probability <= 0.0


def test_a_file_that_lacks_a_network_is_refused(tmp_path: Path) -> None:
    _save(tmp_path, seeds=[1], members=2)
    with refused("invalid_model", "expected finite weights"):
        load_sentence_model("small", tmp_path)


@pytest.mark.parametrize("name", ["large", "../small", ""])
def test_an_unknown_model_is_refused_with_those_available(tmp_path: Path, name: str) -> None:
    _save(tmp_path)
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
def test_a_damaged_model_is_refused(tmp_path: Path, damage: Callable[[Path], None]) -> None:
    _save(tmp_path)
    damage(tmp_path)
    with refused("invalid_model"):
        load_sentence_model("small", tmp_path)
