# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Training the published model, an encoder-decoder LSTM, with PyTorch."""

from __future__ import annotations

import dataclasses
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch
from numpy.typing import NDArray
from rich.console import Console
from rich.progress import Progress
from torch import nn
from torch.nn import functional
from torch.nn.utils.rnn import pack_padded_sequence, pad_sequence

from teo_sign_training.corpus.paper_pairs import training_data_hash, training_pairs
from teo_sign_training.fitting.network import one_thread, seeded
from teo_sign_training.lstm256.seq2seq import (
    END,
    START,
    LstmModel,
    TokenList,
    folded_tokens,
    load_model,
    mark_variants,
    save_model,
)
from teo_sign_translator.errors import TranslationError

#: One input sequence and its output sequence.
Example = tuple[tuple[str, ...], tuple[str, ...]]

# Target of the padding behind a shorter sequence, which the loss leaves out.
_PADDING = -100


@dataclass(frozen=True, kw_only=True, slots=True)
class LstmTrainingConfig:
    """How a model is trained; the defaults are the paper's (arXiv:1907.04198) where it states them.

    Attributes:
        hidden: Units of the one LSTM layer of the encoder, and of the decoder.
        learning_rate: Step size of RMSprop; the paper compares 0.0001 and 0.001.
        decay: RMSprop's moving average of squared gradients (the paper's beta; PyTorch's alpha).
        epochs: Passes over the training examples.
        batch_size: Examples per step. Not stated; of 1, 4, 8 and 16, 1 comes closest to the paper's
            predictions at 0.0001.
        seed: Of initial weights and the order of examples.
    """

    hidden: int = 256
    learning_rate: float = 0.001
    decay: float = 0.9
    epochs: int = 100
    batch_size: int = 1
    seed: int = 2019

    def __post_init__(self) -> None:
        """Refuse values that cannot train anything."""
        if (
            min(self.hidden, self.epochs, self.batch_size) < 1
            or not 0 < self.learning_rate < 1
            or not 0 <= self.decay < 1
        ):
            raise TranslationError(
                "invalid_config",
                "expected hidden, epochs and batch_size of at least 1, learning_rate in (0, 1) and decay in "
                f"[0, 1), got {self}",
            )


@dataclass(frozen=True, slots=True)
class Training:
    """A trained model and how its loss went.

    Attributes:
        model: With the weights after the last epoch.
        weights: The same weights by name, as `LstmModel` takes them.
        losses: Mean cross-entropy per output token [nat] of each epoch, during the epoch, on the training
            examples.
        validation_losses: The same on the held-out examples after each epoch; empty if there are none.
    """

    model: LstmModel
    weights: dict[str, NDArray[np.float32]]
    losses: tuple[float, ...]
    validation_losses: tuple[float, ...]


def train(
    examples: Sequence[Example],
    held_out: Sequence[Example],
    config: LstmTrainingConfig,
    on_epoch: Callable[[int], None] | None = None,
) -> Training:
    """Train from nothing. The same arguments give the same weights on the same machine.

    Args:
        examples: To learn from; at least one.
        held_out: To measure the validation loss on; may be empty.
        config: See `LstmTrainingConfig`.
        on_epoch: Called after each epoch with its number from 1.

    Raises:
        TranslationError: "invalid_config" without examples.
    """
    if not examples:
        raise TranslationError("invalid_config", "expected at least one training example, got none")
    inputs = TokenList.of_inputs(source for source, _ in (*examples, *held_out))
    outputs = TokenList.of_outputs(target for _, target in (*examples, *held_out))
    with _deterministic(config.seed):
        network = EncoderDecoder(len(inputs), len(outputs), config.hidden)
        # 1e-7 keeps the division finite, as in the Keras library of the paper's time.
        optimiser = torch.optim.RMSprop(
            network.parameters(), config.learning_rate, alpha=config.decay, eps=1e-7
        )
        encoded = [_encode(example, inputs, outputs) for example in examples]
        encoded_held_out = [_encode(example, inputs, outputs) for example in held_out]
        losses: list[float] = []
        validation_losses: list[float] = []
        for epoch in range(1, config.epochs + 1):
            order = torch.randperm(len(encoded)).tolist()
            total, count = 0.0, 0
            for start in range(0, len(order), config.batch_size):
                batch = [encoded[i] for i in order[start : start + config.batch_size]]
                loss, tokens = network.loss(batch)
                optimiser.zero_grad()
                (loss / tokens).backward()  # type: ignore[no-untyped-call]
                optimiser.step()
                total, count = total + loss.item(), count + tokens
            losses.append(total / count)
            if encoded_held_out:
                with torch.no_grad():
                    loss, tokens = network.loss(encoded_held_out)
                validation_losses.append(loss.item() / tokens)
            if on_epoch is not None:
                on_epoch(epoch)
        weights = network.weights()
    return Training(LstmModel(inputs, outputs, weights), weights, tuple(losses), tuple(validation_losses))


class EncoderDecoder(nn.Module):
    """The trainable form of `seq2seq.LstmModel`."""

    def __init__(self, inputs: int, outputs: int, hidden: int) -> None:
        """Make the layers with Keras' initial weights.

        The paper states no initial weights; these (Glorot uniform, orthogonal, zero, forget gate 1) were the
        defaults of the libraries of its time, and learn these few sentences in fewer epochs than PyTorch's.
        """
        super().__init__()
        self.inputs = inputs
        self.outputs = outputs
        self.encoder = nn.LSTM(inputs, hidden, batch_first=True)
        self.decoder = nn.LSTM(outputs, hidden, batch_first=True)
        self.output = nn.Linear(hidden, outputs)
        for layer in (self.encoder, self.decoder):
            parameters = dict(layer.named_parameters())
            nn.init.xavier_uniform_(parameters["weight_ih_l0"])
            nn.init.orthogonal_(parameters["weight_hh_l0"])
            nn.init.zeros_(parameters["bias_hh_l0"])
            nn.init.zeros_(parameters["bias_ih_l0"])
            nn.init.ones_(parameters["bias_ih_l0"][hidden : 2 * hidden])
        nn.init.xavier_uniform_(self.output.weight)
        nn.init.zeros_(self.output.bias)

    def loss(self, batch: Sequence[_Encoded]) -> tuple[torch.Tensor, int]:
        """Cross-entropy of a batch; each token is predicted from the right ones before it (teacher forcing).

        Returns:
            The sum over all output tokens, END included [nat], and their number.
        """
        lengths = torch.tensor([len(example.source) for example in batch])
        source = functional.one_hot(
            pad_sequence([e.source for e in batch], batch_first=True), self.inputs
        ).float()
        packed = pack_padded_sequence(source, lengths, batch_first=True, enforce_sorted=False)
        _, state = self.encoder(packed)
        said = functional.one_hot(
            pad_sequence([e.said for e in batch], batch_first=True), self.outputs
        ).float()
        hidden, _ = self.decoder(said, state)
        target = pad_sequence([e.target for e in batch], batch_first=True, padding_value=_PADDING)
        total = functional.cross_entropy(
            self.output(hidden).flatten(0, 1), target.flatten(), ignore_index=_PADDING, reduction="sum"
        )
        return total, sum(len(example.target) for example in batch)

    def weights(self) -> dict[str, NDArray[np.float32]]:
        """The weights by name, as `LstmModel` takes them; PyTorch's two biases of a layer become one."""
        result: dict[str, NDArray[np.float32]] = {}
        for name, layer in (("encoder", self.encoder), ("decoder", self.decoder)):
            parameters = {key: value.detach().numpy() for key, value in layer.named_parameters()}
            result[f"{name}.weight_ih_l0"] = parameters["weight_ih_l0"].copy()
            result[f"{name}.weight_hh_l0"] = parameters["weight_hh_l0"].copy()
            result[f"{name}.bias"] = parameters["bias_ih_l0"] + parameters["bias_hh_l0"]
        result["output.weight"] = self.output.weight.detach().numpy().copy()
        result["output.bias"] = self.output.bias.detach().numpy().copy()
        return result


@dataclass(frozen=True, slots=True)
class _Encoded:
    """An example as indices: what is read, what the decoder is told was said, what it should say."""

    source: torch.Tensor
    said: torch.Tensor
    target: torch.Tensor


def _encode(example: Example, inputs: TokenList, outputs: TokenList) -> _Encoded:
    source, target = example
    return _Encoded(
        torch.tensor(inputs.indices(source)),
        torch.tensor(outputs.indices([START, *target])),
        torch.tensor(outputs.indices([*target, END])),
    )


@contextmanager
def _deterministic(seed: int) -> Iterator[None]:
    """Seeded, on one thread, in PyTorch's deterministic mode; gives back the caller's settings."""
    before = torch.are_deterministic_algorithms_enabled()
    torch.use_deterministic_algorithms(True)
    try:
        with seeded(seed), one_thread():  # sums in one order, and no slower for matrices this small
            yield
    finally:
        torch.use_deterministic_algorithms(before)


#: The published model is trained with 20 % held out; what ships must know every sentence, so nothing is held
#: out. Batches of 8 keep the training short; there are more than 200 examples where the paper has 31.
SHIPPED_CONFIG = LstmTrainingConfig(learning_rate=0.001, epochs=100, batch_size=8)


_DESCRIPTION = (
    "One-layer encoder-decoder LSTM, 256 hidden units, one-hot words, softmax output, trained with "
    "categorical cross-entropy and RMSprop as in arXiv:1907.04198. Unlike there nothing is held out: it is "
    "to know these sentences by heart, and knows hardly anything else. Accents are folded; each sentence is "
    "trained with its marks typed, left out or changed; names and numbers are slots."
)


def shipped_examples() -> list[Example]:
    """Every training pair in every likely way of typing its marks."""
    return [
        (tokens, pair.glosses)
        for pair in training_pairs()
        for tokens in mark_variants(folded_tokens(pair.sentence))
    ]


def train_published(
    name: str, directory: Path, config: LstmTrainingConfig, command: str, console: Console
) -> bool:
    """Train and write the model with a card that says how.

    Returns:
        Whether all examples are known afterwards.
    """
    examples = shipped_examples()
    started = time.monotonic()
    with Progress(console=console) as progress:
        task = progress.add_task(f"training {name}", total=config.epochs)
        training = train(examples, [], config, lambda epoch: progress.update(task, completed=epoch))
    seconds = time.monotonic() - started
    save_model(
        name,
        directory,
        inputs=training.model.inputs,
        outputs=training.model.outputs,
        weights=training.weights,
        card={
            "description": _DESCRIPTION,
            "command": command,
            "config": dataclasses.asdict(config),
            "data": {
                "files": ["text/paper_alignment.tsv", "text/project_pairs.tsv"],
                "sha256": training_data_hash(),
                "pairs": len(training_pairs()),
                "examples": len(examples),
                "held_out": 0,
            },
            "result": {"training_loss": round(training.losses[-1], 6), "seconds": round(seconds, 1)},
            "weights": "half precision; gates in PyTorch's order; each layer's two biases added",
            "licence": "Apache-2.0",
        },
    )
    model = load_model(name, directory)
    exact = sum(model.predict(source).tokens == target for source, target in examples)
    lowest = min(min(model.predict(source).probabilities) for source, _ in examples)
    console.print(
        f"{directory / name}.safetensors: {exact} of {len(examples)} examples exact, "
        f"lowest probability {lowest:.4f}, loss {training.losses[-1]:.5f}, {seconds:.0f} s"
    )
    return exact == len(examples)
