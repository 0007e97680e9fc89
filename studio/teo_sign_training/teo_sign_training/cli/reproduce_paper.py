# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`reproduce_paper`: trains the published model on the published pairs, and shows how it compares."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.console import Console
from rich.progress import Progress
from rich.table import Table

from teo_common.atomic_files import write_atomically
from teo_sign_training.cli.command import csv_table, markdown_table, plot_png, run_command
from teo_sign_training.corpus.paper_pairs import PublishedPair, paper_pairs, paper_predictions
from teo_sign_training.fitting.lstm256_fitting import Example, LstmTrainingConfig, Training, train
from teo_sign_training.lstm256.seq2seq import published_tokens

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: The two step sizes that the paper compares; its predictions are made with the first.
_LEARNING_RATES = (0.0001, 0.001)
#: Part of the pairs that is held out to measure the validation loss.
_HELD_OUT = 0.2


@dataclass(frozen=True, slots=True)
class _Run:
    """One training, the glosses that it predicts for each pair, and the time that it took [s]."""

    config: LstmTrainingConfig
    training: Training
    predictions: tuple[tuple[str, ...], ...]
    seconds: float


def _split(pairs: list[PublishedPair]) -> tuple[list[PublishedPair], list[PublishedPair]]:
    """The pairs to train on, and the last 20 % (rounded up) held out: 31 and 8 of 39."""
    count = len(pairs) - math.ceil(_HELD_OUT * len(pairs))
    return pairs[:count], pairs[count:]


def _reproduce(config: LstmTrainingConfig, progress: Progress) -> _Run:
    pairs = paper_pairs()
    examples: list[Example] = [(published_tokens(pair.sentence), pair.glosses) for pair in pairs]
    count = len(_split(pairs)[0])
    task = progress.add_task(f"learning rate {config.learning_rate}", total=config.epochs)
    started = time.monotonic()
    training = train(
        examples[:count], examples[count:], config, lambda epoch: progress.update(task, completed=epoch)
    )
    seconds = time.monotonic() - started
    return _Run(
        config, training, tuple(training.model.predict(source).tokens for source, _ in examples), seconds
    )


def run(
    out: Annotated[Path, typer.Option(help="Folder for curves and tables; made if it is missing.")],
    epochs: Annotated[int, typer.Option(min=1, help="Passes over the pairs; the paper's are 100.")] = 100,
    batch_size: Annotated[int, typer.Option(min=1, help="Pairs per step; the paper states none.")] = 1,
    seed: Annotated[
        int, typer.Option(help="Of initial weights and order of pairs.")
    ] = LstmTrainingConfig().seed,
) -> None:
    """Train the published LSTM at both learning rates; write loss curves and the table of predictions."""
    console = Console()
    with Progress(console=console) as progress:
        runs = [
            _reproduce(
                LstmTrainingConfig(learning_rate=rate, epochs=epochs, batch_size=batch_size, seed=seed),
                progress,
            )
            for rate in _LEARNING_RATES
        ]
    out.mkdir(parents=True, exist_ok=True)
    for each in runs:
        stem = f"loss_{each.config.learning_rate}"
        write_atomically(out / f"{stem}.csv", _loss_csv(each.training).encode())
        write_atomically(out / f"{stem}.png", _loss_png(each))
    rows = _rows(runs)
    remarks = _differences(runs)
    write_atomically(out / "predictions.csv", csv_table(rows).encode())
    write_atomically(out / "predictions.md", _markdown(rows, remarks).encode())
    table = Table(*rows[0], title="Predictions for the paper's first ten sentences")
    for row in rows[1:]:
        table.add_row(*row)
    console.print(table)
    for remark in remarks:
        console.print(f"- {remark}", highlight=False)
    console.print(f"written to {out}", highlight=False)


def _differences(runs: list[_Run]) -> list[str]:
    """What came out, what differs from the paper, and why, in sentences."""
    pairs = paper_pairs()
    shown = paper_predictions()
    paper_right = sum(p.glosses == pair.glosses for p, pair in zip(shown, pairs, strict=False))
    return [
        f"The paper's model predicts {paper_right} of its first {len(shown)} sentences as they were taught.",
        *(_outcome(each) for each in runs),
        *_deviations(runs[0]),
        "With the options' defaults and seven seeds, 6 to 8 of the ten come out right at 0.0001, as 7 do in "
        "the paper; which ones does not agree. Ours misses sentences whose first gloss is rare ('Me "
        "llamo…'), the paper's those with 'Colegio'. Inputs padded with zeros to one length, as programs of "
        "that time often did, were tried: they move the errors to 'Colegio' too, so unstated details of that "
        "kind are the likely reason.",
        _unseen_words(),
        "Not stated in the description that this follows, and so chosen here: batch size "
        f"({runs[0].config.batch_size}), initial weights (Keras' defaults), the held-out part (the last "
        "pairs, so that the ten sentences shown are learned ones), the form of the input (lower case, "
        "accents kept, opening marks and commas left out), teacher forcing, and one vocabulary from all "
        "pairs.",
    ]


def _outcome(result: _Run) -> str:
    """Figures of one run in a sentence or two."""
    pairs, shown = paper_pairs(), paper_predictions()
    known = len(_split(pairs)[0])
    right = [p == pair.glosses for p, pair in zip(result.predictions, pairs, strict=True)]
    same = sum(ours == theirs.glosses for ours, theirs in zip(result.predictions, shown, strict=False))
    losses, validation = result.training.losses, result.training.validation_losses
    best = validation.index(min(validation))
    return (
        f"At learning rate {result.config.learning_rate} ours predicts {sum(right[: len(shown)])} of them as "
        f"taught, {sum(right[:known])} of the {known} sentences it learned from and {sum(right[known:])} of "
        f"the {len(pairs) - known} held out; {same} of {len(shown)} predictions are the paper's. In "
        f"{result.config.epochs} epochs ({result.seconds:.0f} s) the training loss goes from {losses[0]:.2f} "
        f"to {losses[-1]:.3f}; the validation loss is lowest in epoch {best + 1} ({validation[best]:.2f}) "
        f"and ends at {validation[-1]:.2f}."
    )


def _deviations(result: _Run) -> list[str]:
    """The sentences whose predictions are not the paper's."""
    differing = [
        f"'{theirs.sentence}' (paper: {' '.join(theirs.glosses)}; ours: {' '.join(ours) or 'nothing'})"
        for theirs, ours in zip(paper_predictions(), result.predictions, strict=False)
        if ours != theirs.glosses
    ]
    rate = result.config.learning_rate
    return [f"At {rate} these differ from the paper's: {'; '.join(differing)}."] if differing else []


def _unseen_words() -> str:
    """Why the held-out sentences cannot come out right."""
    learned, held_out = _split(paper_pairs())
    words = {word for pair in learned for word in published_tokens(pair.sentence)}
    glosses = {gloss for pair in learned for gloss in pair.glosses}
    unseen = sum(not set(published_tokens(pair.sentence)) <= words for pair in held_out)
    unsaid = sum(not set(pair.glosses) <= glosses for pair in held_out)
    return (
        f"The validation loss rises while the training loss falls: of the {len(held_out)} held-out sentences "
        f"{unseen} hold a word, and {unsaid} a gloss, that occurs in none of the {len(learned)} others. "
        "Nothing can be learned about those from so few pairs; the model memorises and does not generalise."
    )


def _rows(runs: list[_Run]) -> list[list[str]]:
    head = [
        "Spanish",
        "taught",
        "paper at 0.0001",
        *(f"ours at {each.config.learning_rate}" for each in runs),
    ]
    rows = [head]
    for index, (pair, theirs) in enumerate(zip(paper_pairs(), paper_predictions(), strict=False)):
        cells = [pair.glosses, theirs.glosses, *(each.predictions[index] for each in runs)]
        rows.append([pair.sentence, *(" ".join(glosses) or "(nothing)" for glosses in cells)])
    return rows


def _loss_csv(training: Training) -> str:
    losses = zip(training.losses, training.validation_losses, strict=True)
    rows = [[str(epoch), f"{a:.6f}", f"{b:.6f}"] for epoch, (a, b) in enumerate(losses, start=1)]
    return csv_table([["epoch", "training_loss", "validation_loss"], *rows])


def _markdown(rows: list[list[str]], remarks: list[str]) -> str:
    lines = ["# Predictions for the paper's first ten sentences", ""]
    lines += markdown_table(rows)
    return "\n".join([*lines, "", "## What differs, and why", "", *(f"- {remark}" for remark in remarks), ""])


def _loss_png(result: _Run) -> bytes:
    """Both losses over the epochs, as a picture."""
    learned, held_out = _split(paper_pairs())
    training = result.training

    def draw(axes: Axes) -> None:
        epochs = range(1, len(training.losses) + 1)
        axes.plot(epochs, training.losses, label=f"training ({len(learned)} pairs)")
        axes.plot(epochs, training.validation_losses, label=f"validation ({len(held_out)} pairs)")
        axes.set(
            title=f"Encoder-decoder LSTM, 256 units, RMSprop, learning rate {result.config.learning_rate}",
            xlabel="epoch",
            ylabel="cross-entropy per token [nat]",
            xlim=(1, max(2, len(epochs))),
            ylim=(0, None),
        )
        axes.grid(alpha=0.3)
        axes.legend()

    return plot_png(draw, size=(7, 4.5))


def main() -> None:
    """Run the command line."""
    run_command(run)
