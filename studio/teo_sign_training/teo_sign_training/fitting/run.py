# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A training from a corpus folder to a model's files, with everything that made it in its card."""

from __future__ import annotations

import dataclasses
import platform
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import torch
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

from teo_sign_languages import Language
from teo_sign_training.corpus import Pair
from teo_sign_training.corpus.pairs import corpus_hash, read_splits, sample, without
from teo_sign_training.corpus.paper_pairs import Reader, memorised_pairs, not_memorised, written_pairs
from teo_sign_training.fitting.fitting import Fit, Start, TrainingConfig, TrainingProgress, fit
from teo_sign_training.fitting.metrics import Score, score
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.model_files import Weights, read_model
from teo_sign_translator.pointer.config import NetworkConfig
from teo_sign_translator.pointer.decoding import (
    SCHEMA,
    SentenceModel,
    load_sentence_model,
    save_sentence_model,
)
from teo_sign_translator.pointer.ensemble import member_weights, of_member
from teo_sign_translator.pointer.vocabulary import Vocabulary

#: Pairs of a held-out split that are translated to score a model: 2,000 give a standard error of 1 % at most.
_SCORED = 2000


@dataclass(frozen=True, slots=True)
class TrainingData:
    """Pairs that models are trained and scored on.

    Attributes:
        train: To learn from; none is typed like one of `by_heart`, whose glosses may differ.
        held_out: By split, the others.
        by_heart: The paper's and the project's pairs.
        written: Pairs that no grammar made.
        corpus: Where they come from.
        sha256: Of the corpus files.
        language: That is learned.
    """

    train: list[Pair]
    held_out: dict[str, list[Pair]]
    by_heart: tuple[Pair, ...]
    written: tuple[Pair, ...]
    corpus: Path
    sha256: str
    language: Language


@dataclass(frozen=True, slots=True)
class TrainedModel:
    """A model after its training, with its scores.

    Attributes:
        model: As loaded from its files.
        fit: How the training went.
        scores: Of the loaded model, by held-out split.
        unknown: Sentences of the paper that do not come out as published.
    """

    model: SentenceModel
    fit: Fit
    scores: dict[str, Score]
    unknown: tuple[str, ...]


def load_training_data(
    corpus: Path, read: Reader, pairs: int | None, seed: int, language: Language
) -> TrainingData:
    """Read a corpus.

    Args:
        corpus: Folder or file.
        read: How sentences become words.
        pairs: Most training pairs, chosen at random; all by default.
        seed: Of that choice.
        language: Of the corpus.

    Raises:
        TranslationError: "invalid_data".
    """
    splits = read_splits(corpus)
    by_heart = memorised_pairs(read, language.text)
    train = without(splits.pop("train"), (pair.text for pair in by_heart))
    written = tuple(without(list(written_pairs(read, language.text)), (pair.text for pair in by_heart)))
    train = sample(train, pairs, seed)
    return TrainingData(train, splits, by_heart, written, corpus, corpus_hash(corpus), language)


@dataclass(frozen=True, slots=True)
class StartModel:
    """A model that a training goes on from.

    Attributes:
        members: Its networks.
        command: That made it.
    """

    members: tuple[Start, ...]
    command: str


def load_start(name: str, network: NetworkConfig, directory: Path) -> StartModel:
    """Read the model that a training is to go on from.

    Args:
        name: Of its files.
        network: What is to be trained.
        directory: Folder of its files.

    Raises:
        TranslationError: "unknown_model"; "invalid_model" if it is another network, too.
    """

    def build(card: dict[str, Any], weights: Weights) -> StartModel:
        found = NetworkConfig(**card["network"])
        if found != network:
            raise TranslationError("invalid_model", f"expected {network} to go on from, got {found}")
        vocabulary = Vocabulary.from_dict(card["lexis"])
        members = range(network.members)
        own = [of_member(member, weights) if network.members > 1 else weights for member in members]
        return StartModel(tuple(Start(vocabulary, each) for each in own), card["command"])

    return read_model(name, SCHEMA, directory, build)


def train_model(
    name: str,
    network: NetworkConfig,
    config: TrainingConfig,
    data: TrainingData,
    read: Reader,
    out: Path,
    command: str,
    console: Console,
    device: torch.device | None = None,
    start: StartModel | None = None,
) -> TrainedModel:
    """Train, write the files, load them again and score what was loaded.

    Args:
        name: Of the model's files.
        network: What is trained.
        config: How.
        data: On what.
        read: How sentences become words.
        out: Folder of the files.
        command: Goes into the card.
        console: Shows the progress.
        device: Where; an accelerator if there is one by default.
        start: What to go on from; nothing by default.

    Raises:
        TranslationError: "invalid_config", "invalid_data".
    """
    dev = sample(data.held_out["dev"], _SCORED, config.seed)
    columns = (TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn(), TimeRemainingColumn())
    with Progress(*columns, console=console) as bar:
        task = bar.add_task(name, total=config.epochs * network.members)
        fits: list[Fit] = []

        def show(progress: TrainingProgress) -> None:
            done = len(fits) * config.epochs + progress.epoch - 1 + progress.step / progress.steps
            text = f"{name}: member {len(fits) + 1}, epoch {progress.epoch}, loss {progress.loss:.4f}"
            bar.update(task, completed=done, description=text)
            if progress.step == progress.steps and progress.dev_loss is not None:
                bar.console.print(f"{text}, dev loss {progress.dev_loss:.4f}", highlight=False)

        for member in range(network.members):
            own = dataclasses.replace(config, seed=config.seed + member)
            fits.append(
                fit(
                    data.train,
                    dev,
                    data.by_heart,
                    read,
                    network,
                    own,
                    written=data.written,
                    start=start.members[member] if start else None,
                    device=device,
                    on_progress=show,
                )
            )
    fitted = fits[0]
    card = {
        "description": f"Reads {data.language.spoken.name} words with their readings, says "
        f"{data.language.names.short} glosses; see pointer/config.py.",
        "language": data.language.code,
        "command": f"{start.command}, then {command}" if start else command,
        "training": dataclasses.asdict(config),
        "data": {
            "sha256": data.sha256,
            "pairs": fitted.pairs,
            "left_out": fitted.left_out,
            "by_heart": len(data.by_heart),
            "written": len(data.written),
        },
        "made_by": {
            "commit": _commit(),
            "python": platform.python_version(),
            "torch": torch.__version__,
            "numpy": np.__version__,
            "device": fitted.device,
        },
    }
    result = {
        "losses": [_rounded(each.losses) for each in fits],
        "dev_losses": [_rounded(each.dev_losses) for each in fits],
        "best_epoch": [each.best_epoch for each in fits],
        "seconds": round(sum(each.seconds for each in fits), 1),
        "pairs_per_second": round(fitted.pairs_per_second),
    }

    def save() -> None:
        save_sentence_model(
            name,
            out,
            config=network,
            vocabulary=fitted.vocabulary,
            weights=member_weights([each.weights for each in fits]) if len(fits) > 1 else fitted.weights,
            card={**card, "result": result},
        )

    save()
    model = load_sentence_model(name, out)
    scores = {
        split: _score_model(model, sample(pairs, _SCORED, config.seed), read)
        for split, pairs in data.held_out.items()
        if pairs
    }
    # Half precision counts: the figures are those of the files.
    result["scores"] = {split: dataclasses.asdict(each) for split, each in scores.items()}
    unknown = not_memorised(model, read) if data.by_heart else ()
    if data.by_heart:
        result["paper_sentences_wrong"] = len(unknown)
    save()
    return TrainedModel(model, fitted, scores, unknown)


def _score_model(model: SentenceModel, pairs: Sequence[Pair], read: Reader) -> Score:
    got = model.translate_all([read(pair.text) for pair in pairs])
    return score(
        [pair.glosses for pair in pairs],
        [tuple(gloss.gloss for gloss in hypotheses[0].glosses) for hypotheses in got],
    )


def _commit() -> str:
    """The commit of the source tree; "unknown" for an installed package."""
    try:
        done = subprocess.run(
            ["git", "describe", "--always", "--dirty", "--abbrev=12"],
            cwd=Path(__file__).parent,
            capture_output=True,
            text=True,
            check=True,
            timeout=10,
        )
    except (OSError, subprocess.SubprocessError):
        return "unknown"
    return done.stdout.strip()


def _rounded(losses: Sequence[float]) -> list[float]:
    return [round(loss, 5) for loss in losses]
