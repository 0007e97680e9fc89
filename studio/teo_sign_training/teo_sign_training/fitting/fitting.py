# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The training of every model of the zoo."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
import torch
from numpy.typing import NDArray

from teo_common.text_folding import fold
from teo_sign_training.corpus import Pair
from teo_sign_training.corpus.paper_pairs import Reader
from teo_sign_training.fitting.batches import WordNumbers, batches
from teo_sign_training.fitting.examples import (
    VARIANTS,
    ExampleReader,
    Examples,
    Ints,
    Typing,
    WordTable,
    copies,
    typed_sayably,
    unsayable,
)
from teo_sign_training.fitting.network import Network, named_device, on_device, one_thread, seeded
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.pointer.config import POINTER, NetworkConfig, refuse
from teo_sign_translator.pointer.decoding import SPARE
from teo_sign_translator.pointer.vocabulary import Vocabulary, tag_key

#: By name, from the simplest on. The first ones are the layouts of Figure 1 of arXiv:1907.04198, then its
#: future work. All read the same words and readings, so that a row of `compare`, which trains one network of
#: each, differs from the next by its mechanism alone. The equal-length layout reads from both ends: its first
#: gloss stands at the first word, and may be said by the last.
ZOO = MappingProxyType(
    {
        "rnn_equal": NetworkConfig(cell="rnn", layout="equal_length", bidirectional=True),
        "lstm_equal": NetworkConfig(cell="lstm", layout="equal_length", bidirectional=True),
        "rnn": NetworkConfig(cell="rnn"),
        "gru": NetworkConfig(cell="gru"),
        "lstm": NetworkConfig(cell="lstm"),
        "lstm_stacked": NetworkConfig(cell="lstm", layers=2),
        "gru_attention": NetworkConfig(cell="gru", bidirectional=True, attention=True),
        "lstm_attention": NetworkConfig(cell="lstm", bidirectional=True, attention=True),
        "pointer_gru": NetworkConfig(cell="gru", bidirectional=True, attention=True, copy=True),
        POINTER: NetworkConfig(cell="lstm", bidirectional=True, attention=True, copy=True, members=2),
    }
)


def network_config(name: str) -> NetworkConfig:
    """The configuration of a model of the zoo.

    Raises:
        TranslationError: "unknown_model", with the names there are.
    """
    if name not in ZOO:
        raise TranslationError("unknown_model", f"expected a model of {', '.join(ZOO)}, got '{name}'")
    return ZOO[name]


@dataclass(frozen=True, kw_only=True, slots=True)
class TrainingConfig:
    """How a network is trained.

    Attributes:
        epochs: Most passes over the training pairs; three of 200,000 fit into that hour.
        patience: Epochs without a lower loss on the development pairs after which training ends.
        batch_size: Pairs per step.
        learning_rate: Highest step size of AdamW; rises over the first steps, then falls to zero in a line.
            0.003 trained without a jump of the loss.
        dropout: Part of each layer's input that is left out during training.
        rare_word: A word that occurs n times in the training pairs is shown as unknown with probability
            rare_word / (rare_word + n), so that words never seen are carried over too: a content word about
            every fifth time, a function word hardly ever.
        clean: Part of the pairs that is shown as written; the others as people type in haste
            (`examples.Typing`).
        attention_weight: Weight of the loss by which attention follows the pairs' alignment.
        by_heart: Part of a pass that is pairs of the paper and the project, each repeated equally often:
            they are few, must be known by heart, and are exceptions to the grammar of the others.
        written: Part of a pass that is pairs that no grammar made, likewise. Of a writer whose pairs were
            kept out 26 came out right without, 34, 35 and 33 with 0.05, 0.15 and 0.3 (one network each).
        seed: Of initial weights, order, dropout and noise.
    """

    epochs: int = 3
    patience: int = 3
    batch_size: int = 128
    learning_rate: float = 0.003
    dropout: float = 0.15
    rare_word: float = 30.0
    clean: float = 0.4
    attention_weight: float = 0.3
    by_heart: float = 0.05
    written: float = 0.15
    seed: int = 2019

    def __post_init__(self) -> None:
        """Refuse values that cannot train anything."""
        problems = [
            "epochs, patience and batch_size of at least 1"
            if min(self.epochs, self.patience, self.batch_size) < 1
            else "",
            "learning_rate in (0, 1)" if not 0 < self.learning_rate < 1 else "",
            "dropout in [0, 1)" if not 0 <= self.dropout < 1 else "",
            "clean in [0, 1]" if not 0 <= self.clean <= 1 else "",
            "by_heart and written in [0, 1)"
            if not (0 <= self.by_heart < 1 and 0 <= self.written < 1)
            else "",
            "rare_word and attention_weight of at least 0"
            if not min(self.rare_word, self.attention_weight) >= 0
            else "",
        ]
        refuse(problems, self)


#: Fewer occurrences than these among the training pairs do not teach an embedding anything.
MIN_FORM, MIN_LEMMA = 10, 3
#: Occurrences that cannot be copied from which a gloss joins the closed list of a model that copies. Rarer
#: ones are mistakes of the corpus as a rule.
MIN_GLOSS = 3
#: Part of all steps in which the step size rises to its highest.
_WARM_UP = 0.05
#: Largest norm of a gradient; recurrent networks have a rare step far above it (Pascanu et al. 2013).
_MAX_NORM = 1.0


@dataclass(frozen=True, slots=True)
class TrainingProgress:
    """State of a training after an epoch.

    Attributes:
        epoch: Number of the pass, from 1.
        step: Steps done in it.
        steps: Steps that it has.
        loss: Mean over its glosses so far [nat].
        dev_loss: After the pass, on the development pairs as written [nat]; none before.
    """

    epoch: int
    step: int
    steps: int
    loss: float
    dev_loss: float | None


@dataclass(frozen=True, slots=True)
class Fit:
    """A trained network.

    Attributes:
        vocabulary: Its lists.
        weights: By name, of the best epoch.
        losses: Of each epoch, on the training pairs while it learned [nat per gloss].
        dev_losses: After each epoch, on the development pairs [nat per gloss].
        best_epoch: Whose weights these are, from 1.
        pairs: Pairs that were learned from.
        left_out: Pairs that were not, because the model cannot say a gloss of theirs.
        seconds: Duration [s].
        pairs_per_second: Speed of the passes.
        device: On which device.
    """

    vocabulary: Vocabulary
    weights: dict[str, NDArray[np.float32]]
    losses: tuple[float, ...]
    dev_losses: tuple[float, ...]
    best_epoch: int
    pairs: int
    left_out: int
    seconds: float
    pairs_per_second: float
    device: str


class Start(NamedTuple):
    """A network that a training goes on from.

    Attributes:
        vocabulary: Its lists, which stay: what they lack is read as unknown, and said if it is a copy.
        weights: By name.
    """

    vocabulary: Vocabulary
    weights: Mapping[str, NDArray[np.floating]]


def fit(
    train: Sequence[Pair],
    dev: Sequence[Pair],
    by_heart: Sequence[Pair],
    read: Reader,
    network_config: NetworkConfig,
    config: TrainingConfig,
    *,
    written: Sequence[Pair] = (),
    start: Start | None = None,
    device: torch.device | None = None,
    on_progress: Callable[[TrainingProgress], None] | None = None,
) -> Fit:
    """Train a network. The same arguments give the same weights on the same machine.

    Args:
        train: Pairs to learn from.
        dev: Pairs that say when to stop; if empty, the last epoch's weights are kept.
        by_heart: Pairs that each pass repeats, see `TrainingConfig`.
        read: How sentences become words.
        network_config: What is trained.
        config: How.
        written: Pairs that each pass repeats as well.
        start: What to go on from; nothing by default.
        device: Where; an accelerator if there is one by default.
        on_progress: Called now and then.

    Raises:
        TranslationError: "invalid_config" without pairs, "invalid_data" for an alignment that does not fit.
    """
    if not train and not by_heart:
        raise TranslationError("invalid_config", "expected at least one training pair, got none")
    started = time.monotonic()
    device = device or named_device(None)
    reader = ExampleReader(read)
    pairs = reader.examples([*train, *written, *by_heart])
    development = reader.examples(dev)
    table = reader.table()
    vocabulary = (
        start.vocabulary
        if start
        else make_vocabulary(pairs, table, len(train) + len(written), copy=network_config.copy)
    )
    numbers = WordNumbers.of(table, vocabulary, pairs)
    closed = numbers.glosses >= 0
    lost = unsayable(pairs, table, closed, network_config.copy)
    made, given = len(train), len(train) + len(written)
    known = max(len(by_heart), _repeated(made, config.by_heart))
    chosen = np.concatenate(
        [
            np.arange(made),
            _in_turn(made, given, _repeated(made, config.written)),
            _in_turn(given, len(pairs), known),
        ]
    )
    learned = pairs.take(chosen[~lost[chosen]])
    measured = np.flatnonzero(~unsayable(development, table, closed, network_config.copy))
    development = development.take(measured)
    if not len(learned):
        raise TranslationError("invalid_config", "expected pairs whose glosses can be said, got none")

    with seeded(config.seed), one_thread():
        random = np.random.default_rng(config.seed)
        network = Network(network_config, vocabulary, config.dropout)
        if start:
            network.take(start.weights)
        network.to(device)
        optimiser = torch.optim.AdamW(network.parameters(), config.learning_rate, weight_decay=0.01)
        steps = max(1, len(learned) // config.batch_size)
        schedule = torch.optim.lr_scheduler.LambdaLR(optimiser, _schedule(steps * config.epochs))
        spare = SPARE if network_config.layout == "equal_length" else 0
        losses: list[float] = []
        dev_losses: list[float] = []
        best, best_epoch = network.weights(), 0
        passing = 0.0
        for epoch in range(1, config.epochs + 1):
            began = time.monotonic()
            network.train()
            typing = Typing.draw(len(learned), config.clean, random)
            passed = typed_sayably(learned, table, typing, closed, network_config.copy)
            total, count = 0.0, 0.0
            all_batches = batches(
                passed,
                table,
                numbers,
                config.batch_size,
                random=random,
                rare_word=config.rare_word,
                spare=spare,
            )
            for step, batch in enumerate(all_batches, start=1):
                tensors = on_device(batch, device)
                gloss_loss, look_loss = network.losses(tensors)
                glosses = float(batch.weight.sum())
                optimiser.zero_grad()
                ((gloss_loss + config.attention_weight * look_loss) / glosses).backward()  # type: ignore[no-untyped-call]
                torch.nn.utils.clip_grad_norm_(network.parameters(), _MAX_NORM)
                optimiser.step()
                schedule.step()
                total, count = total + gloss_loss.item(), count + glosses
                if on_progress is not None and step % 10 == 0:
                    on_progress(TrainingProgress(epoch, step, max(steps, step), total / count, None))
            losses.append(total / count)
            passing += time.monotonic() - began
            if len(development):
                dev_losses.append(_mean_loss(network, development, table, numbers, spare, device))
            if not dev_losses or dev_losses[-1] <= min(dev_losses):
                best, best_epoch = network.weights(), epoch
            if on_progress is not None:
                last = dev_losses[-1] if dev_losses else None
                on_progress(TrainingProgress(epoch, step, step, losses[-1], last))
            if epoch - best_epoch >= config.patience:
                break
    return Fit(
        vocabulary,
        best,
        tuple(losses),
        tuple(dev_losses),
        best_epoch,
        len(pairs) - int(lost.sum()),
        int(lost.sum()),
        time.monotonic() - started,
        len(learned) * len(losses) / passing,
        str(device),
    )


def make_vocabulary(pairs: Examples, table: WordTable, by_heart: int, *, copy: bool) -> Vocabulary:
    """The lists of a model, from its training pairs.

    Args:
        pairs: The training pairs as written.
        table: Their words.
        by_heart: From which of them on every gloss must be sayable, however rare.
        copy: Whether the model can copy; if so, a gloss that is a copy wherever it occurs has no place in the
            closed list, so that the model learns to copy.
    """
    # Every way of typing counts: a lemma of "como" without its accent is as good as one of "cómo".
    typed = np.bincount(table.variants[pairs.words].ravel(), minlength=len(table.words))
    forms: Counter[str] = Counter()
    lemmas: Counter[str] = Counter()
    tags: Counter[str] = Counter()
    for word, count in zip(table.words, typed.tolist(), strict=True):
        if word is None or not count:
            continue
        forms[fold(word.form)] += count
        for reading in word.readings:
            lemmas[reading.lemma] += count
            tags[tag_key(reading)] += count
    occurrences = np.ones(len(pairs.glosses), np.bool_)
    if copy:
        occurrences[pairs.link_gloss[copies(pairs, table).any(axis=1)]] = False
    said = np.bincount(pairs.glosses[occurrences], minlength=len(table.glosses))
    first = pairs.gloss_start[by_heart]
    known = pairs.glosses[first:][occurrences[first:]]
    said[known] = np.maximum(said[known], MIN_GLOSS)
    least = MIN_GLOSS if copy else 1
    return Vocabulary.of(
        _frequent(forms, MIN_FORM * VARIANTS),
        _frequent(lemmas, MIN_LEMMA * VARIANTS),
        _frequent(tags, 1),
        sorted(table.glosses[gloss] for gloss in np.flatnonzero(said >= least)),
    )


def _repeated(others: int, part: float) -> int:
    """How many pairs are `part` of a pass that has so many others."""
    return round(part / (1 - part) * others)


def _in_turn(first: int, last: int, count: int) -> Ints:
    """The pairs from `first` to before `last`, again and again until there are so many; none of none."""
    return np.resize(np.arange(first, last), count if first < last else 0)


def _frequent(counts: Counter[str], least: int) -> list[str]:
    return sorted(each for each, count in counts.items() if count >= least)


def _schedule(steps: int) -> Callable[[int], float]:
    """Learning rate of a step, as a part of the highest."""
    warm_up = max(1, round(_WARM_UP * steps))
    return lambda step: min((step + 1) / warm_up, max(0.0, (steps - step) / max(1, steps - warm_up)))


def _mean_loss(
    network: Network,
    examples: Examples,
    table: WordTable,
    numbers: WordNumbers,
    spare: int,
    device: torch.device,
) -> float:
    network.eval()
    total, count = 0.0, 0.0
    with torch.no_grad():
        for batch in batches(examples, table, numbers, 512, spare=spare):
            loss, _ = network.losses(on_device(batch, device))
            total, count = total + loss.item(), count + float(batch.weight.sum())
    return total / count
