# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`perform_scores`: sign scores as demonstrations, recorded by a depth camera of the synthetic signer."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import Annotated

import typer
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from teo_common.atomic_files import write_atomically
from teo_sign_authoring.cli.command import chosen_scores, errors, fail, output, run_command
from teo_sign_authoring.notation.performance import performance
from teo_sign_authoring.notation.score_file import default_scores_directory
from teo_sign_capture.entries.batch import workers
from teo_signs.errors import LutError
from teo_synthetic_signer.cli.synthesize_cli import parsed_size
from teo_synthetic_signer.errors import SyntheticError
from teo_synthetic_signer.take.take import Take, TakeOptions
from teo_synthetic_signer.take.take_files import write_take

# [Hz] The fastest wiggles of scores go to and fro 7 times a second at most.
_TWICE_A_SIGNS_FASTEST = 15.0
# [m] A hand that is nearer than this to its place is there.
_WORTH_SAYING = 0.02


def perform_scores(
    out: Annotated[Path, typer.Option(help="Directory for scripts and bags; made if it is not there.")],
    scores: Annotated[
        Path | None, typer.Option(help="Directory of scores (YAML); the package's without it.")
    ] = None,
    only: Annotated[
        list[str] | None, typer.Option(help="A gloss; may be given again. All without it.")
    ] = None,
    scripts_only: Annotated[
        bool, typer.Option("--scripts-only", help="Only the scripts, nobody performs them.")
    ] = False,
    truth_only: Annotated[
        bool, typer.Option("--truth-only", help="Bags without images: only the true keypoints.")
    ] = False,
    replace: Annotated[bool, typer.Option(help="Perform anew what has a bag already.")] = False,
    body: Annotated[
        str, typer.Option(help="Who performs; `synthesize --list` names them.")
    ] = "woman_average",
    sensor: Annotated[str, typer.Option(help="What records, likewise.")] = "d435",
    scene: Annotated[str, typer.Option(help="What is around, likewise.")] = "office",
    distance: Annotated[float, typer.Option(help="From the camera to the person [m].")] = 1.5,
    rate: Annotated[float, typer.Option(help="Images per second [Hz].")] = _TWICE_A_SIGNS_FASTEST,
    size: Annotated[str, typer.Option(help="Columns x rows of the images [px].")] = "640x480",
    seed: Annotated[int, typer.Option(min=0, help="Of the sensor's noise.")] = 0,
    jobs: Annotated[int, typer.Option(min=1, help="Performances at a time.")] = 1,
) -> None:
    """Have the synthetic signer perform sign scores: one script (YAML) and one RGB-D bag a sign.

    A sign that has its bag already is left as it is, so a run that was cut off goes on where it stopped.

    Exit status: 0 if all are there, 1 if some could not be made.
    """
    width, height = parsed_size(size)
    try:
        chosen = chosen_scores(scores or default_scores_directory(), only)
        out.mkdir(parents=True, exist_ok=True)
        for gloss, score in chosen.items():
            write_atomically(out / f"{gloss}.yaml", performance(score).text.encode())
    except LutError as error:
        fail(error)
    except OSError as error:
        fail(LutError("not_written", f"--out: expected a place to write to, got: {error}"))
    if scripts_only:
        output.print(f"{out}: {len(chosen)} scripts", soft_wrap=True)
        return
    open_ones = [gloss for gloss in chosen if replace or not (out / gloss).exists()]
    options = partial(
        TakeOptions,
        body=body,
        sensor=sensor,
        scene=scene,
        distance=distance,
        rate=rate,
        width=width,
        height=height,
        seed=seed,
    )
    failed = _performed(partial(_perform, out, options, truth_only), open_ones, jobs)
    for gloss, reason in failed.items():
        errors.print(f"not_performed: {gloss}: {reason}", soft_wrap=True, markup=False)
    kept = len(chosen) - len(open_ones)
    made = len(open_ones) - len(failed)
    output.print(f"{out}: {made} signs performed" + f", {kept} kept" * bool(kept), soft_wrap=True)
    if failed:
        raise typer.Exit(1)


def _performed(perform: Callable[[str], tuple[str, float]], glosses: list[str], jobs: int) -> dict[str, str]:
    """Perform signs, several at a time in as many processes. Returns what was in the way, by gloss."""
    columns = (TextColumn("performing"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    failed: dict[str, str] = {}
    with ExitStack() as stack, Progress(*columns, console=errors) as progress:
        task = progress.add_task("", total=len(glosses))
        performing = stack.enter_context(workers(jobs, None)).map if jobs > 1 else map
        for gloss, (reason, shortfall) in zip(glosses, performing(perform, glosses), strict=True):
            if reason:
                failed[gloss] = reason
            elif shortfall > _WORTH_SAYING:  # what a viewer of the recording should know
                said = f"{gloss}: hands stay up to {100.0 * shortfall:.0f} cm off places out of reach"
                errors.print(said, soft_wrap=True, markup=False)
            progress.advance(task)
    return failed


def _perform(
    out: Path, options: Callable[..., TakeOptions], truth_only: bool, gloss: str
) -> tuple[str, float]:
    """Perform one sign, in whatever process this is.

    Returns:
        What was in the way, empty if nothing was, and how far hands stay off their places at most [m].
    """
    bag, beside = out / gloss, out / f".{gloss}.{os.getpid()}"
    try:
        take = Take(options(script=str(out / f"{gloss}.yaml")))
        frames = (take.truth(i) if truth_only else take.frame(i) for i in range(len(take)))
        for _ in write_take(frames, beside, truth_only=truth_only, about=take.about_it):
            pass
        shutil.rmtree(bag, ignore_errors=True)
        beside.replace(bag)
    except SyntheticError as error:
        return error.sentence, 0.0
    except OSError as error:
        return str(error), 0.0
    finally:
        shutil.rmtree(beside, ignore_errors=True)
    return "", take.motion.shortfall


def main() -> None:
    """Run `perform_scores`."""
    run_command(perform_scores)


if __name__ == "__main__":
    main()
