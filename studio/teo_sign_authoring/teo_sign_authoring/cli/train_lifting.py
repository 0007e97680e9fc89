# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`train_lifting`: the networks that tell depths of arms and bends of fingers in a clip of one camera."""

from __future__ import annotations

from functools import partial
from multiprocessing import get_context
from pathlib import Path
from typing import Annotated

import numpy as np
import safetensors.numpy
import typer
from rich.progress import track

from teo_common.atomic_files import write_atomically
from teo_sign_authoring.cli.command import output
from teo_sign_authoring.notation.score_file import default_scores_directory, read_scores
from teo_sign_authoring.notation.score_schema import Score
from teo_sign_authoring.sight.fitting import arm_examples, fit, hand_examples
from teo_sign_authoring.sight.rendered_people import RenderedPerson, rendered_person
from teo_signs.errors import LutError
from teo_skeleton_retriever.lifting.network import FILE


def train_lifting(
    people: Annotated[int, typer.Option(min=10, help="How many are rendered: 9 s of one core each.")] = 600,
    examples: Annotated[
        Path, typer.Option(help="Directory that keeps them, so that a run that was cut off goes on.")
    ] = Path("out/rendered_people"),
    out: Annotated[Path, typer.Option(help="File of the networks.")] = FILE,
    jobs: Annotated[int, typer.Option(min=1, help="People rendered at a time.")] = 2,
) -> None:
    """Render people who sign, find their points and fit the networks of `teo_skeleton_retriever.lifting`."""
    shown = render(range(people), examples, jobs)
    weights = fit("arms", arm_examples(shown, np.random.default_rng(0))) | fit("hands", hand_examples(shown))
    write_atomically(out, safetensors.numpy.save(weights))
    output.print(f"{out}: networks of {len(shown)} people", soft_wrap=True)


def render(numbers: range, examples: Path, jobs: int) -> list[RenderedPerson]:
    """People of these numbers."""
    scores = [
        score for score in read_scores(default_scores_directory()) if score.kind == "lexical" and score.steps
    ]
    make = partial(_person, scores=scores, folder=examples)
    # MediaPipe's threads do not survive a fork.
    with get_context("spawn").Pool(jobs) as pool:
        found = track(pool.imap(make, numbers), "people", len(numbers), console=output)
        return [person for person in found if person is not None]


def _person(number: int, scores: list[Score], folder: Path) -> RenderedPerson | None:
    try:
        return rendered_person(number, scores, folder)
    except LutError:
        return None


def main() -> None:
    """Entry point."""
    typer.run(train_lifting)
