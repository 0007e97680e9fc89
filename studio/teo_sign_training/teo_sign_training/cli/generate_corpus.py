# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`generate_corpus`: writes the pairs that the translator is trained and tested on."""

from __future__ import annotations

import time
from itertools import chain
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import track

from teo_sign_languages import DEFAULT_LANGUAGE, load_language
from teo_sign_training.cli.command import LanguageOption, run_command
from teo_sign_training.corpus.generator import Generator
from teo_sign_training.corpus.pairs import SPLITS, write_pairs
from teo_sign_training.corpus.paper_pairs import own_pairs
from teo_sign_translator.morphology import Morphology

FILE_NAME = "pairs.tsv"


def run(
    out: Annotated[Path, typer.Option(help="Folder for pairs.tsv.")] = Path("out/corpus"),
    pairs: Annotated[int, typer.Option(min=100, help="How many, about.")] = 300_000,
    seed: Annotated[int, typer.Option(min=0, help="The same seed gives the same pairs.")] = 1,
    leave_out: Annotated[
        list[Path] | None,
        typer.Option(help="File of sentences, one a line, that must not occur: of a test. Repeatable."),
    ] = None,
    hold_out_constructions: Annotated[
        bool, typer.Option(help="Keep the constructions of held_out.yaml for a split of their own.")
    ] = False,
    language: LanguageOption = DEFAULT_LANGUAGE,
) -> None:
    """Write sentence pairs of a language's grammar, and those it must know by heart, to DIR/pairs.tsv."""
    console = Console(stderr=True)
    started = time.monotonic()
    text = load_language(language).text
    morphology = Morphology.load(text)
    generator = Generator.load(text / "grammar", morphology)
    own = list(own_pairs(morphology))
    unwanted = [line for path in leave_out or () for line in path.read_text(encoding="utf-8").splitlines()]
    # The grammar would translate some of the paper's sentences otherwise than the paper does.
    unwanted += [pair.text for pair in own]
    made = generator.pairs(pairs, seed, unwanted, hold_out_constructions=hold_out_constructions)
    every = chain(own, made)
    hidden = not console.is_terminal
    written = list(track(every, "generating", total=pairs, console=console, disable=hidden))
    write_pairs(out / FILE_NAME, written)
    counts = {split: sum(pair.split == split for pair in written) for split in SPLITS}
    rules = len({pair.rule for pair in written})
    seconds = time.monotonic() - started
    console.print(
        f"{out / FILE_NAME}: {len(written)} pairs of {rules} templates in {seconds:.0f} s: "
        + ", ".join(f"{split} {count}" for split, count in counts.items() if count)
    )


def main() -> None:
    """Run the command line."""
    run_command(run)
