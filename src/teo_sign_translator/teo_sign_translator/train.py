"""`train`: makes the model that ships with the package."""

from __future__ import annotations

import dataclasses
import time
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import Progress

from teo_sign_translator.errors import TranslationError
from teo_sign_translator.model_store import DEFAULT_MODEL, load_model, save_model
from teo_sign_translator.pairs import training_data_hash, training_pairs
from teo_sign_translator.resources import models_directory
from teo_sign_translator.spanish_tokens import folded_tokens, mark_variants
from teo_sign_translator.training import Example, TrainingConfig, train
from teo_sign_translator.vocabulary import Vocabulary

#: The published model is trained with 20 % held out; what ships must know every sentence, so nothing is held
#: out. Batches of 8 keep the training short; there are more than 200 examples where the paper has 31.
SHIPPED_CONFIG = TrainingConfig(learning_rate=0.001, epochs=100, batch_size=8)


_DESCRIPTION = (
    "One-layer encoder-decoder LSTM, 256 hidden units, one-hot words, softmax output, trained with "
    "categorical "
    "cross-entropy and RMSprop as in arXiv:1907.04198. Unlike there nothing is held out: it is to know these "
    "sentences "
    "by heart, and knows hardly anything else. Accents are folded; each sentence is trained with its marks "
    "typed, left "
    "out or changed; names and numbers are slots."
)


def shipped_examples() -> list[Example]:
    """Every training pair in every likely way of typing its marks."""
    return [
        (tokens, pair.glosses)
        for pair in training_pairs()
        for tokens in mark_variants(folded_tokens(pair.sentence))
    ]


def run(
    out: Annotated[
        Path | None, typer.Option(help="Folder for model and card; the package's models by default.")
    ] = None,
    name: Annotated[str, typer.Option(help="Name of the model.")] = DEFAULT_MODEL,
    epochs: Annotated[int, typer.Option(min=1, help="Passes over the examples.")] = SHIPPED_CONFIG.epochs,
    learning_rate: Annotated[
        float, typer.Option(help="Step size of RMSprop.")
    ] = SHIPPED_CONFIG.learning_rate,
    batch_size: Annotated[int, typer.Option(min=1, help="Examples per step.")] = SHIPPED_CONFIG.batch_size,
    seed: Annotated[int, typer.Option(help="Of weights and order of examples.")] = SHIPPED_CONFIG.seed,
) -> None:
    """Train the published LSTM on all pairs of the package, and write it with a card that says how."""
    console = Console(stderr=True)
    directory = out or models_directory()
    config = TrainingConfig(epochs=epochs, learning_rate=learning_rate, batch_size=batch_size, seed=seed)
    examples = shipped_examples()
    inputs = Vocabulary.of_inputs(source for source, _ in examples)
    outputs = Vocabulary.of_outputs(target for _, target in examples)
    started = time.monotonic()
    with Progress(console=console) as progress:
        task = progress.add_task(f"training {name}", total=config.epochs)
        training = train(
            examples, [], inputs, outputs, config, lambda epoch: progress.update(task, completed=epoch)
        )
    seconds = time.monotonic() - started
    options = f"--epochs {epochs} --learning-rate {learning_rate} --batch-size {batch_size} --seed {seed}"
    save_model(
        name,
        directory,
        inputs=inputs,
        outputs=outputs,
        weights=training.weights,
        card={
            "description": _DESCRIPTION,
            "command": f"ros2 run teo_sign_translator train --name {name} {options}",
            "config": dataclasses.asdict(config),
            "data": {
                "files": ["data/paper_alignment.tsv", "data/project_pairs.tsv"],
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
    if exact < len(examples):
        console.print("not all examples are known: train for more epochs")
        raise typer.Exit(1)


def main() -> None:
    """Run the command line."""
    try:
        typer.run(run)
    except TranslationError as error:
        Console(stderr=True).print(f"{error.code}: {error}", markup=False)
        raise SystemExit(1) from None


if __name__ == "__main__":
    main()
