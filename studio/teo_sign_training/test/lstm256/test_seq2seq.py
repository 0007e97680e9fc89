# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch
from refusals import refused

from teo_sign_training.corpus.paper_pairs import paper_pairs
from teo_sign_training.fitting.lstm256_fitting import EncoderDecoder, LstmTrainingConfig, Training, train
from teo_sign_training.lstm256.seq2seq import (
    END,
    MAX_OUTPUT,
    START,
    LstmModel,
    TokenList,
    load_model,
    published_tokens,
    save_model,
)

EXAMPLES = [(published_tokens(pair.sentence), pair.glosses) for pair in paper_pairs()[:8]]
INPUTS = TokenList.of_inputs(source for source, _ in EXAMPLES)
OUTPUTS = TokenList.of_outputs(target for _, target in EXAMPLES)


def _train(seed: int = 1, batch_size: int = 3, epochs: int = 25) -> Training:
    config = LstmTrainingConfig(
        hidden=32, learning_rate=0.01, epochs=epochs, batch_size=batch_size, seed=seed
    )
    return train(EXAMPLES[:6], EXAMPLES[6:], config)


def test_the_same_seed_gives_the_same_weights_and_another_seed_others() -> None:
    first, second, other = _train(epochs=2), _train(epochs=2), _train(seed=2, epochs=2)
    assert first.losses == second.losses
    for name, weights in first.weights.items():
        np.testing.assert_array_equal(weights, second.weights[name])
    assert first.losses != other.losses


def test_training_leaves_the_callers_settings_alone() -> None:
    torch.manual_seed(5)
    expected = torch.rand(1)
    torch.manual_seed(5)
    threads = torch.get_num_threads()
    _train(epochs=1)
    assert torch.rand(1) == expected
    assert torch.get_num_threads() == threads
    assert not torch.are_deterministic_algorithms_enabled()


def test_the_loss_of_a_batch_is_that_of_its_examples_one_by_one() -> None:
    # One step from the same weights: a batch pads its shorter sequences, which must not count.
    whole = train(EXAMPLES, EXAMPLES, LstmTrainingConfig(hidden=8, epochs=1, batch_size=8))
    parts = [
        train(EXAMPLES, [example], LstmTrainingConfig(hidden=8, epochs=1, batch_size=8))
        for example in EXAMPLES
    ]
    lengths = [len(target) + 1 for _, target in EXAMPLES]
    one_by_one = np.average([part.validation_losses[0] for part in parts], weights=lengths)
    assert whole.validation_losses[0] == pytest.approx(one_by_one, rel=1e-5)


def test_plain_arrays_say_what_pytorch_says() -> None:
    torch.manual_seed(3)
    network = EncoderDecoder(len(INPUTS), len(OUTPUTS), 16)
    with torch.no_grad():
        for parameter in network.parameters():
            parameter += 0.5 * torch.randn_like(parameter)
    model = LstmModel(INPUTS, OUTPUTS, network.weights())
    for source, _ in EXAMPLES:
        prediction = model.predict(source)
        one_hot = torch.eye(len(INPUTS))[INPUTS.indices(source)][None]
        _, state = network.encoder(one_hot)
        (said,) = OUTPUTS.indices([START])
        for token, probability in zip(prediction.tokens, prediction.probabilities, strict=True):
            hidden, state = network.decoder(torch.eye(len(OUTPUTS))[[said]][None], state)
            logits = network.output(hidden)[0, 0]
            logits[1] = -torch.inf  # START is never said
            (said,) = OUTPUTS.indices([token])
            assert int(logits.argmax()) == said
            assert probability == pytest.approx(float(torch.softmax(logits.detach(), 0)[said]), abs=1e-5)


def test_a_model_that_never_ends_is_stopped() -> None:
    weights = EncoderDecoder(len(INPUTS), len(OUTPUTS), 4).weights()
    weights["output.bias"][2] = 100.0
    prediction = LstmModel(INPUTS, OUTPUTS, weights).predict(EXAMPLES[0][0])
    assert len(prediction.tokens) == MAX_OUTPUT
    assert not prediction.complete


def test_no_tokens_and_unknown_tokens_are_refused() -> None:
    model = load_model("lstm256")
    for tokens, code in (([], "empty_text"), (["zzz"], "unknown_token")):
        with refused(code):
            model.predict(tokens)


@pytest.mark.parametrize(
    "change",
    [{"hidden": 0}, {"epochs": 0}, {"batch_size": 0}, {"learning_rate": float("nan")}, {"decay": 1.0}],
)
def test_a_configuration_that_cannot_train_is_refused(change: dict[str, float]) -> None:
    with refused("invalid_config"):
        LstmTrainingConfig(**change)  # type: ignore[arg-type]


@pytest.fixture(scope="module")
def trained() -> Training:
    return _train()


def test_the_loss_falls_and_what_was_taught_is_known_also_after_loading(
    trained: Training, tmp_path: Path
) -> None:
    assert len(trained.losses) == len(trained.validation_losses) == 25
    assert trained.losses[0] > 2
    assert trained.losses[-1] < 0.2
    save_model("small", tmp_path, inputs=INPUTS, outputs=OUTPUTS, weights=trained.weights, card={})
    loaded = load_model("small", tmp_path)
    for source, target in EXAMPLES[:6]:
        assert trained.model.predict(source).tokens == loaded.predict(source).tokens == target


@pytest.mark.parametrize(
    ("card", "weights"),
    [
        ({"schema": 99}, {}),
        ({"vocabulary": {}}, {}),
        ({"vocabulary": {"input": ["a"], "output": [END, START]}}, {}),
        ({"vocabulary": {"input": ["a", "a"], "output": [END, START]}}, {}),
        ({}, {"output.bias": np.full(len(OUTPUTS), np.nan, np.float32)}),
        ({}, {"encoder.weight_hh_l0": np.zeros((1, 1), np.float32)}),
    ],
)
def test_a_damaged_model_is_refused(
    trained: Training, tmp_path: Path, card: dict[str, object], weights: dict[str, Any]
) -> None:
    changed = trained.weights | weights
    save_model("small", tmp_path, inputs=INPUTS, outputs=OUTPUTS, weights=changed, card={})
    path = tmp_path / "small.json"
    path.write_text(json.dumps(json.loads(path.read_text("utf-8")) | card), encoding="utf-8")
    with refused("invalid_model"):
        load_model("small", tmp_path)
