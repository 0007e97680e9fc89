# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`evaluate`: how good a model of the zoo is on the pairs of a corpus."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import track
from rich.table import Table

from teo_common.atomic_files import write_atomically
from teo_sign_languages import DEFAULT_LANGUAGE, load_language
from teo_sign_training.cli.command import LanguageOption, run_command
from teo_sign_training.corpus import Pair
from teo_sign_training.corpus.pairs import read_splits, sample
from teo_sign_training.corpus.paper_pairs import Reader
from teo_sign_training.fitting.metrics import Score, score
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.morphology import Morphology
from teo_sign_translator.pointer.decoding import SentenceModel, load_sentence_model
from teo_sign_translator.text.source_words import source_words

# Sentences translated between two moves of the progress bar.
_CHUNK = 512


@dataclass(frozen=True, slots=True)
class _Outcome:
    """A pair and the glosses that came out, with the log probability that the model gives them [nat]."""

    pair: Pair
    glosses: tuple[str, ...]
    log_probability: float

    @property
    def right(self) -> bool:
        return self.glosses == self.pair.glosses


def _outcomes(
    model: SentenceModel, pairs: Sequence[Pair], read: Reader, beam: int, console: Console
) -> list[_Outcome]:
    result: list[_Outcome] = []
    starts = range(0, len(pairs), _CHUNK)
    hidden = not console.is_terminal
    for start in track(starts, "translating", console=console, transient=True, disable=hidden):
        some = pairs[start : start + _CHUNK]
        translated = model.translate_all([read(pair.text) for pair in some], beam=beam)
        for pair, (best, *_) in zip(some, translated, strict=True):
            result.append(_Outcome(pair, tuple(gloss.gloss for gloss in best.glosses), best.log_probability))
    return result


def _scores_by(results: Sequence[_Outcome], key: str) -> dict[str, Score]:
    """Scores of all outcomes with the same `split`, or of the same family of rules (`rule`)."""
    groups: defaultdict[str, list[_Outcome]] = defaultdict(list)
    for each in results:
        groups[each.pair.split if key == "split" else each.pair.rule.partition(".")[0]].append(each)
    return {
        name: score([each.pair.glosses for each in group], [each.glosses for each in group])
        for name, group in groups.items()
    }


def run(
    model: Annotated[str, typer.Argument(help="Name of the model.")],
    corpus: Annotated[Path, typer.Argument(help="Corpus file, or folder that generate_corpus made.")],
    models: Annotated[
        Path | None, typer.Option(help="Folder of the models; the language's by default.")
    ] = None,
    split: Annotated[
        list[str] | None, typer.Option(help="Split to measure on, repeatable; all but train by default.")
    ] = None,
    beam: Annotated[int, typer.Option(min=1, help="Hypotheses kept; 1 takes the likeliest gloss.")] = 1,
    pairs: Annotated[int, typer.Option(min=1, help="Most pairs of each split, chosen at random.")] = 2000,
    seed: Annotated[int, typer.Option(help="Of that choice.")] = 2019,
    worst: Annotated[int, typer.Option(min=0, help="Wrong translations shown, the surest first.")] = 10,
    out: Annotated[Path | None, typer.Option(help="File for all wrong translations (TSV).")] = None,
    language: LanguageOption = DEFAULT_LANGUAGE,
) -> None:
    """Print exact matches and BLEU (sacreBLEU over glosses, tokenisation "none") by split and by rule."""
    console = Console()
    signed = load_language(language)
    read = partial(source_words, morphology=Morphology.load(signed.text))
    loaded = load_sentence_model(model, models or signed.models)
    splits = read_splits(corpus)
    wanted = split or [name for name in splits if name != "train"]
    unknown = [name for name in wanted if name not in splits]
    if unknown:
        raise TranslationError("invalid_data", f"expected splits of {', '.join(splits)}, got {unknown}")
    chosen = [pair for name in wanted for pair in sample(splits[name], pairs, seed)]
    results = _outcomes(loaded, chosen, read, beam, console)
    by_rule = _scores_by(results, "rule")
    console.print(_table(f"{model}, beam {beam}", "split", _scores_by(results, "split")))
    console.print(
        _table("by rule, worst first", "rule", dict(sorted(by_rule.items(), key=lambda item: item[1].exact)))
    )
    wrong = sorted((each for each in results if not each.right), key=lambda each: -each.log_probability)
    for each in wrong[:worst]:
        console.print(
            f"{each.pair.text}\n  expected {' '.join(each.pair.glosses)}\n  got      "
            f"{' '.join(each.glosses)}  ({each.log_probability:.2f} nat, {each.pair.rule})",
            markup=False,
            highlight=False,
        )
    if out is not None:
        lines = ["split\trule\ttext\texpected\tgot\tlog_probability"]
        lines += (
            f"{each.pair.split}\t{each.pair.rule}\t{each.pair.text}\t{' '.join(each.pair.glosses)}\t"
            f"{' '.join(each.glosses)}\t{each.log_probability:.3f}"
            for each in wrong
        )
        out.parent.mkdir(parents=True, exist_ok=True)
        write_atomically(out, ("\n".join(lines) + "\n").encode())


def _table(title: str, first: str, scores: dict[str, Score]) -> Table:
    table = Table(first, "pairs", "exact", "BLEU", title=title)
    for column in table.columns[1:]:
        column.justify = "right"
    for name, each in scores.items():
        table.add_row(name, str(each.count), f"{each.exact:.1%}", f"{each.bleu:.1f}")
    return table


def main() -> None:
    """Run the command line."""
    run_command(run)
