# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`compare`: trains every model of the zoo on the same pairs, and shows how they differ."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.console import Console
from rich.table import Table

from teo_common.atomic_files import write_atomically
from teo_sign_languages import DEFAULT_LANGUAGE, load_language
from teo_sign_training.cli.command import csv_table, markdown_table, plot_png, run_command
from teo_sign_training.fitting.fitting import ZOO, TrainingConfig, network_config
from teo_sign_training.fitting.network import named_device
from teo_sign_training.fitting.run import TrainedModel, load_training_data, train_model
from teo_sign_translator.morphology import Morphology
from teo_sign_translator.pointer.config import NetworkConfig
from teo_sign_translator.text.source_words import source_words

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def run(
    corpus: Annotated[Path, typer.Option(help="Folder that generate_corpus made.")] = Path("out/corpus"),
    out: Annotated[Path, typer.Option(help="Folder for models, table and plots.")] = Path("out/compare"),
    model: Annotated[
        list[str] | None, typer.Option(help="Model to train, repeatable; the whole zoo by default.")
    ] = None,
    # So that all of the zoo is trained in about half an hour on two cores.
    pairs: Annotated[int, typer.Option(min=1, help="Most training pairs, the same for all.")] = 40_000,
    epochs: Annotated[int, typer.Option(min=1, help="Passes over them.")] = TrainingConfig().epochs,
    seed: Annotated[int, typer.Option(help="Of weights, order, dropout and typing noise.")] = 2019,
    device: Annotated[
        str | None, typer.Option(help="Such as cpu or cuda; an accelerator if there is one.")
    ] = None,
) -> None:
    """Train models on the same pairs; write a table (CSV, Markdown) and plots (PNG)."""
    console = Console()
    where = named_device(device)
    language = load_language(DEFAULT_LANGUAGE)
    read = partial(source_words, morphology=Morphology.load(language.text))
    networks = {name: dataclasses.replace(network_config(name), members=1) for name in model or ZOO}
    config = TrainingConfig(seed=seed, epochs=epochs)
    data = load_training_data(corpus, read, pairs, seed, language)
    command = f"ros2 run teo_sign_translator compare --pairs {pairs} --epochs {epochs} --seed {seed}"
    trained = {
        name: train_model(name, network, config, data, read, out, command, console, where)
        for name, network in networks.items()
    }
    rows = _comparison(networks, trained)
    console.print(_table(trained, f"{len(data.train)} pairs, at most {epochs} epochs: exact matches"))
    write_atomically(out / "comparison.csv", csv_table(rows).encode())
    write_atomically(out / "comparison.md", "\n".join([*markdown_table(rows), ""]).encode())
    write_atomically(out / "loss.png", _loss_plot(trained))
    write_atomically(out / "exact.png", _exact_plot(trained))
    console.print(f"written to {out}", highlight=False)


def _comparison(
    networks: Mapping[str, NetworkConfig], trained: Mapping[str, TrainedModel]
) -> list[list[str]]:
    """The table, its head first: exact matches and BLEU of each model on each held-out split."""
    splits = list(next(iter(trained.values())).scores)
    head = ["model", "cell", "layers", "layout", "reads", "attention", "copy", "weights"]
    head += ["pairs/s", "loss", *(f"{split} exact / BLEU" for split in splits)]
    rows = [head]
    for name, each in trained.items():
        config = dataclasses.asdict(networks[name])
        rows.append(
            [
                name,
                config["cell"],
                str(config["layers"]),
                config["layout"],
                "both ways" if config["bidirectional"] else "forwards",
                "yes" if config["attention"] else "no",
                "yes" if config["copy"] else "no",
                f"{sum(weights.size for weights in each.fit.weights.values()) / 1e6:.1f} M",
                f"{each.fit.pairs_per_second:.0f}",
                f"{(each.fit.dev_losses or each.fit.losses)[each.fit.best_epoch - 1]:.3f}",
                *(f"{score.exact:.1%} / {score.bleu:.1f}" for score in each.scores.values()),
            ]
        )
    return rows


def _table(trained: Mapping[str, TrainedModel], title: str) -> Table:
    """What fits into a terminal of 80 columns; the files hold the rest."""
    splits = list(next(iter(trained.values())).scores)
    table = Table("model", "loss", *splits, title=title)
    for name, each in trained.items():
        loss = (each.fit.dev_losses or each.fit.losses)[each.fit.best_epoch - 1]
        table.add_row(name, f"{loss:.3f}", *(f"{score.exact:.1%}" for score in each.scores.values()))
    return table


def _loss_plot(trained: Mapping[str, TrainedModel]) -> bytes:
    """Loss on the development pairs after each epoch, one line a model, as PNG."""

    def draw(axes: Axes) -> None:
        for index, (name, each) in enumerate(trained.items()):
            losses = each.fit.dev_losses or each.fit.losses
            axes.plot(
                range(1, len(losses) + 1),
                losses,
                label=name,
                color=f"C{index % 10}",
                linestyle=("-", "--", ":")[index // 4 % 3],
                marker="o",
                markersize=3,
            )
        axes.set(xlabel="epoch", ylabel="cross-entropy per gloss, development pairs [nat]", yscale="log")
        axes.set_title("What each mechanism adds: loss over the epochs")
        axes.locator_params(axis="x", integer=True)
        axes.grid(alpha=0.3, which="both")
        axes.legend(ncols=2, fontsize="small")

    return plot_png(draw, size=(8, 5))


def _exact_plot(trained: Mapping[str, TrainedModel]) -> bytes:
    """Exact matches of each model on each held-out split, as PNG."""

    def draw(axes: Axes) -> None:
        splits = list(next(iter(trained.values())).scores)
        height = 0.8 / max(1, len(splits))
        for index, split in enumerate(splits):
            places = [place + index * height for place in range(len(trained))]
            values = [100 * each.scores[split].exact for each in trained.values()]
            axes.barh(places, values, height=height, label=split)
        axes.set_yticks([place + 0.4 - height / 2 for place in range(len(trained))], list(trained))
        axes.invert_yaxis()
        axes.set(xlabel="sentences translated exactly [%]", xlim=(0, 100))
        axes.set_title("Held-out sentences: of known templates and words, and of new ones")
        axes.grid(alpha=0.3, axis="x")
        axes.legend(loc="upper right", fontsize="small")

    return plot_png(draw, size=(8, 5))


def main() -> None:
    """Run the command line."""
    run_command(run)
