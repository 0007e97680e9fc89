# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Trains the published model, `lstm256`, on all pairs of the package."""

from __future__ import annotations

import dataclasses
import time
from pathlib import Path

from rich.console import Console
from rich.progress import Progress

from teo_sign_training.corpus.aligned_pairs import training_pairs
from teo_sign_training.corpus.paper_pairs import training_data_hash
from teo_sign_training.fitting.lstm256_fitting import Example, LstmTrainingConfig, train
from teo_sign_training.lstm256.store import load_model, save_model
from teo_sign_training.lstm256.tokens import folded_tokens, mark_variants

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

    Args:
        name: Of the model's files.
        directory: Where they go.
        config: How it is trained.
        command: Goes into the card.
        console: Shows progress and result.

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
