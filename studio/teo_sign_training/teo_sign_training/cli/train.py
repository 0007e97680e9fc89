# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`train`: makes a model of the zoo from a corpus, or the published model from the paper's pairs."""

from __future__ import annotations

import dataclasses
from functools import partial
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console

from teo_sign_languages import DEFAULT_LANGUAGE, load_language
from teo_sign_training.cli.command import LanguageOption, run_command
from teo_sign_training.fitting.fitting import ZOO, TrainingConfig, network_config
from teo_sign_training.fitting.lstm256_fitting import SHIPPED_CONFIG, train_published
from teo_sign_training.fitting.network import named_device
from teo_sign_training.fitting.run import load_start, load_training_data, train_model
from teo_sign_translator.morphology import Morphology
from teo_sign_translator.pointer.config import POINTER
from teo_sign_translator.text.source_words import source_words

#: The published model; it needs no corpus.
PUBLISHED = "lstm256"
_NAMES = ", ".join((PUBLISHED, *ZOO))


def run(
    model: Annotated[str, typer.Argument(help=f"Which model: {_NAMES}.")] = POINTER,
    corpus: Annotated[
        Path, typer.Option(help="Folder that generate_corpus made; lstm256 needs none.")
    ] = Path("out/corpus"),
    out: Annotated[
        Path | None, typer.Option(help="Folder for model and card; the language's models by default.")
    ] = None,
    seed: Annotated[int, typer.Option(help="Of weights, order, dropout and typing noise.")] = 2019,
    epochs: Annotated[
        int | None, typer.Option(min=1, help="Passes over the pairs; the model's own number by default.")
    ] = None,
    batch_size: Annotated[
        int | None, typer.Option(min=1, help="Pairs per step; the model's own number by default.")
    ] = None,
    learning_rate: Annotated[
        float | None, typer.Option(help="Step size; the model's own by default.")
    ] = None,
    pairs: Annotated[
        int | None, typer.Option(min=1, help="Most training pairs; all by default. Not for lstm256.")
    ] = None,
    start: Annotated[
        Path | None,
        typer.Option(help="Folder of this model, to go on from instead of from nothing; its words stay."),
    ] = None,
    device: Annotated[
        str | None, typer.Option(help="Such as cpu or cuda; an accelerator if there is one.")
    ] = None,
    language: LanguageOption = DEFAULT_LANGUAGE,
) -> None:
    """Train a model and write its weights, with a card that says what made them and how good they are."""
    console = Console(stderr=True)
    chosen = {"epochs": epochs, "batch_size": batch_size, "learning_rate": learning_rate}
    given: dict[str, Any] = {option: value for option, value in chosen.items() if value is not None}
    signed = load_language(language)
    directory = out or signed.models
    command = " ".join(
        ["ros2 run teo_sign_translator train", model]
        + [f"--{option.replace('_', '-')} {value}" for option, value in (given | {"seed": seed}).items()]
        + ([f"--pairs {pairs}"] if pairs else [])
        + ([f"--language {language}"] if language != DEFAULT_LANGUAGE else [])
        + (["--start DIR"] if start else [])
    )
    if model == PUBLISHED:
        published = dataclasses.replace(SHIPPED_CONFIG, seed=seed, **given)
        if not train_published(model, directory, published, command, console):
            console.print("not all examples are known: train for more epochs")
            raise typer.Exit(1)
        return
    where = named_device(device)
    network = network_config(model)
    before = load_start(model, network, start) if start else None
    config = dataclasses.replace(TrainingConfig(seed=seed), **given)
    read = partial(source_words, morphology=Morphology.load(signed.text))
    with console.status("reading the corpus"):
        data = load_training_data(corpus, read, pairs, seed, signed)
    trained = train_model(model, network, config, data, read, directory, command, console, where, before)
    fit = trained.fit
    console.print(
        f"{directory / model}.safetensors: {fit.pairs} pairs ({fit.left_out} left out: a gloss that it "
        f"cannot say), best of {len(fit.losses)} epochs the {fit.best_epoch}., {fit.seconds:.0f} s, "
        f"{fit.pairs_per_second:.0f} pairs/s on {fit.device}",
        highlight=False,
    )
    for split, score in trained.scores.items():
        console.print(f"{split}: {score.exact:.1%} exact, BLEU {score.bleu:.1f} ({score.count} pairs)")
    if model == POINTER and trained.unknown:
        console.print(f"{len(trained.unknown)} ways of typing the paper's sentences come out wrong:")
        for line in trained.unknown:
            console.print(f"  {line}", markup=False, highlight=False)
        raise typer.Exit(1)


def main() -> None:
    """Run the command line."""
    run_command(run)
