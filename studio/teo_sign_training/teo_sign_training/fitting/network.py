# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The trainable form of the models, and the device that trains it.

`array_model.py` of the translator runs the weights without PyTorch.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor, nn
from torch.nn import functional

from teo_sign_training.fitting.batches import Batch
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.pointer.config import NetworkConfig
from teo_sign_translator.pointer.vocabulary import END_INDEX, READINGS, Vocabulary, tag_parts

_CELLS = {"rnn": nn.RNN, "gru": nn.GRU, "lstm": nn.LSTM}
#: Log-probability of what cannot be; a finite number, whose gradient is 0 and not NaN.
_NEVER = -1e9


def on_device(batch: Batch[NDArray[Any]], device: torch.device) -> Batch[Tensor]:
    """A batch on the device that trains."""
    return Batch(*(torch.from_numpy(getattr(batch, each.name)).to(device) for each in fields(batch)))


@dataclass(frozen=True, slots=True)
class _Said:
    """What a network would say at each step.

    Attributes:
        log_probability: Of the closed glosses, then of the candidates (if it copies). Shape (B, T, V + C).
        attention: On the words; empty without attention. Shape (B, T, W).
    """

    log_probability: Tensor
    attention: Tensor


class Network(nn.Module):
    """Embeddings, encoder, decoder, attention and pointer, as far as the configuration has them."""

    tag_parts: Tensor

    def __init__(self, config: NetworkConfig, vocabulary: Vocabulary, dropout: float = 0.0) -> None:
        """Make the layers.

        Args:
            config: Which there are.
            vocabulary: Sizes of the embeddings, and which parts each tag has.
            dropout: Part of each layer's input that is left out during training.
        """
        super().__init__()
        size, hidden = config.embedding, config.hidden
        self.config = config
        self.dropout = nn.Dropout(dropout)
        self.form = nn.Embedding(len(vocabulary.forms), size)
        self.capital = nn.Embedding(2, size)
        self.lemma = nn.Embedding(len(vocabulary.lemmas), size, padding_idx=0)
        self.tag = nn.Embedding(len(vocabulary.tags), size, padding_idx=0)
        self.part = nn.Parameter(torch.randn(len(vocabulary.parts), size))
        self.rank = nn.Parameter(torch.ones(READINGS, size))
        with torch.no_grad():
            for table in (
                self.form.weight,
                self.capital.weight,
                self.lemma.weight,
                self.tag.weight,
                self.part,
            ):
                table.mul_(0.3)  # several are added up: their sum is to be of the order of 1
        places = {part: place for place, part in enumerate(vocabulary.parts)}
        parts = torch.zeros(len(vocabulary.tags), len(vocabulary.parts))
        for row, key in enumerate(vocabulary.tags):
            for part in tag_parts(key):
                parts[row, places[part]] = 1
        self.register_buffer("tag_parts", parts, persistent=False)

        self.encoder = _recurrent(config, 2 * size, config.bidirectional, dropout)
        memory = hidden * (1 + config.bidirectional)
        glosses = len(vocabulary.glosses)
        if config.layout == "equal_length":
            self.output = nn.Linear(memory, glosses)
            return
        self.start = nn.Linear(memory, hidden * config.layers)
        self.said = nn.Embedding(glosses, size)
        self.decoder = _recurrent(config, size, False, dropout)
        self.output = nn.Linear(hidden, glosses)
        if config.attention:
            self.key = nn.Linear(memory, hidden)
            self.readout = nn.Linear(hidden + memory, hidden)
        if config.copy:
            self.copy_memory = nn.Linear(memory, hidden)
            self.copy_reading = nn.Linear(size, hidden, bias=False)
            self.said_memory = nn.Linear(memory, size)
            self.said_reading = nn.Linear(size, size, bias=False)

    def forward(self, batch: Batch[Tensor]) -> _Said:
        """Log-probabilities of every gloss, given the right ones before it (teacher forcing)."""
        tags = self.tag(batch.tags) + (self.tag_parts @ self.part)[batch.tags]
        readings = self.lemma(batch.lemmas) + tags
        form = self.form(batch.forms) + self.capital(batch.capitals)
        words = self.dropout(torch.cat([form, (readings * self.rank).sum(dim=2)], dim=-1))
        memory, _ = self.encoder(words)
        none = memory.new_zeros(0)
        if self.config.layout == "equal_length":
            return _Said(torch.log_softmax(self.output(self.dropout(memory)), dim=-1), none)

        said = self.said(batch.said.clamp(min=0))
        if self.config.copy:
            candidates = self.said_memory(memory)[:, :, None] + self.said_reading(readings)
            candidates = candidates.flatten(1, 2)
            place = batch.said_copy[..., None].expand(-1, -1, candidates.shape[-1])
            said = torch.where(batch.said[..., None] < 0, candidates.gather(1, place), said)
        hidden, _ = self.decoder(self.dropout(said), self._first_state(memory))
        if not self.config.attention:
            return _Said(torch.log_softmax(self.output(self.dropout(hidden)), dim=-1), none)

        scores = hidden @ self.key(memory).transpose(1, 2) * self.config.hidden**-0.5
        attention = torch.softmax(scores, dim=-1)
        seen = torch.cat([hidden, attention @ memory], dim=-1)
        thought = self.dropout(torch.tanh(self.readout(self.dropout(seen))))
        logits = self.output(thought)
        if self.config.copy:
            keys = torch.tanh(self.copy_memory(memory)[:, :, None] + self.copy_reading(readings))
            pointer = thought @ keys.flatten(1, 2).transpose(1, 2)
            pointer = pointer.masked_fill((batch.lemmas.flatten(1) == 0)[:, None], _NEVER)
            logits = torch.cat([logits, pointer], dim=-1)
        return _Said(torch.log_softmax(logits, dim=-1), attention)

    def losses(self, batch: Batch[Tensor]) -> tuple[Tensor, Tensor]:
        """Both losses of a batch, summed over glosses [nat]: of the glosses, and of where attention lies.

        Where a gloss can be said in several ways, the sum of their probabilities counts.
        """
        said = self(batch)
        target, weight, ways = batch.target, batch.weight, batch.ways
        if self.config.layout == "equal_length":
            # One output at each position: behind the glosses it is END; glosses that find no room are lost.
            positions = said.log_probability.shape[1]
            room = max(positions - target.shape[1], 0)
            target = functional.pad(target.clamp(min=END_INDEX), (0, room), value=END_INDEX)[:, :positions]
            weight = torch.ones_like(target, dtype=torch.float32)
        closed = said.log_probability.gather(-1, target.clamp(min=0)[..., None])[..., 0]
        closed = closed.masked_fill(target < 0, _NEVER)
        if self.config.copy:
            count = self.output.out_features
            copied = said.log_probability[..., count:].masked_fill(~ways, _NEVER)
            closed = torch.logaddexp(closed, torch.logsumexp(copied, dim=-1))
        loss = -(closed * weight).sum()
        if not self.config.attention:
            return loss, loss.new_zeros(())
        looked = -(batch.looks * torch.log(said.attention + 1e-6)).sum(dim=-1)
        return loss, (looked * weight).sum()

    def weights(self) -> dict[str, NDArray[np.float32]]:
        """The weights by name, in PyTorch's layout."""
        return {name: value.detach().cpu().numpy().copy() for name, value in self.state_dict().items()}

    def take(self, weights: Mapping[str, NDArray[np.floating]]) -> None:
        """Take over the weights of a network of the same layers and vocabulary."""
        self.load_state_dict(
            {name: torch.from_numpy(value.astype(np.float32)) for name, value in weights.items()}
        )

    def _first_state(self, memory: Tensor) -> Tensor | tuple[Tensor, Tensor]:
        """The decoder's state before the first gloss, from the last state of each direction."""
        hidden = self.config.hidden
        last = memory[:, -1, :hidden]
        if self.config.bidirectional:
            last = torch.cat([last, memory[:, 0, hidden:]], dim=-1)
        state = torch.tanh(self.start(last))
        state = state.view(-1, self.config.layers, hidden).transpose(0, 1).contiguous()
        return (state, state) if self.config.cell == "lstm" else state


def _recurrent(config: NetworkConfig, inputs: int, bidirectional: bool, dropout: float) -> nn.RNNBase:
    """Recurrent layers; an LSTM begins with open forget gates, to keep what it reads (Jozefowicz 2015)."""
    layers: nn.RNNBase = _CELLS[config.cell](
        inputs,
        config.hidden,
        num_layers=config.layers,
        batch_first=True,
        dropout=dropout if config.layers > 1 else 0.0,
        bidirectional=bidirectional,
    )
    if config.cell == "lstm":
        with torch.no_grad():
            for name, values in layers.named_parameters():
                if name.startswith("bias_ih"):
                    values[config.hidden : 2 * config.hidden] = 1
    return layers


def named_device(name: str | None) -> torch.device:
    """The device of a name as PyTorch has it; if None, an accelerator if there is one, else the CPU.

    Raises:
        TranslationError: "invalid_config" if this machine has no such device.
    """
    if name is None:
        return torch.device("cuda" if torch.cuda.is_available() else "cpu")
    try:
        device = torch.device(name)
        torch.empty(0, device=device)
    except (RuntimeError, AssertionError) as error:  # the latter is how PyTorch says "built without CUDA"
        raise TranslationError(
            "invalid_config", f"expected a device of this machine such as cpu or cuda, got '{name}': {error}"
        ) from error
    return device


@contextmanager
def one_thread() -> Iterator[None]:
    """Let PyTorch use one thread of the CPU inside the `with`, and as many as before behind it.

    The products of a batch are small. One thread needs 0.9 ms of an AMD EPYC for a pair; two, on a machine
    that others use as well, 10.6 ms, since each waits for the other and burns its core meanwhile.
    """
    before = torch.get_num_threads()
    torch.set_num_threads(1)
    try:
        yield
    finally:
        torch.set_num_threads(before)


@contextmanager
def seeded(seed: int) -> Iterator[None]:
    """PyTorch's random numbers from a seed; the caller's go on afterwards."""
    with torch.random.fork_rng():
        torch.manual_seed(seed)
        yield
