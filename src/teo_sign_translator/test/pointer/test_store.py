# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Models in files: the same after loading, and refused by name where they are damaged."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import safetensors.numpy
from small_language import fit_small, glosses_of, read, sentence_pairs, small_config, small_model

from teo_sign_training.fitting.fitting import Fit
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.model_files import available_models
from teo_sign_translator.pointer import load_sentence_model
from teo_sign_translator.pointer.config import POINTER
from teo_sign_translator.pointer.decoding import save_sentence_model


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


@pytest.mark.parametrize("name", ["large", "../small", ""])
def test_an_unknown_model_is_refused_with_those_available(trained: Fit, tmp_path: Path, name: str) -> None:
    _save(trained, tmp_path)
    with pytest.raises(TranslationError, match="small") as error:
        load_sentence_model(name, tmp_path)
    assert error.value.code == "unknown_model"


def _cut(directory: Path) -> None:
    path = directory / "small.safetensors"
    path.write_bytes(path.read_bytes()[:-100])


def _no_weights(directory: Path) -> None:
    (directory / "small.safetensors").write_bytes(b"")


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
        _no_weights,
        _no_card,
        _not_a_number,
        _spoil("{"),
        _spoil("[]"),
        _card(schema=99),
        _card(network={"hidden": 16}),
        _card(network={"width": 16}),
        _card(network=None),
        _card(lexis={}),
        _card(lexis=[]),
    ],
)
def test_a_damaged_model_is_refused(trained: Fit, tmp_path: Path, damage: Callable[[Path], None]) -> None:
    _save(trained, tmp_path)
    damage(tmp_path)
    with pytest.raises(TranslationError) as error:
        load_sentence_model("small", tmp_path)
    assert error.value.code == "invalid_model"
