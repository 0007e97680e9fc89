# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`perform_scores`: sign scores as demonstrations, recorded by a depth camera of the synthetic signer."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from teo_common.atomic_files import write_atomically
from teo_sign_authoring.notation.performance import performance
from teo_sign_authoring.notation.score_file import default_scores_directory, read_scores
from teo_sign_authoring.notation.score_schema import Score
from teo_signs.errors import LutError

_SYNTHESIZE = "teo_synthetic_signer.cli.synthesize_cli"
_SAYS = "synthesize: "
# [Hz] The fastest wiggles of scores go to and fro 7 times a second at most.
_TWICE_A_SIGNS_FASTEST = 15.0
_LAST_WORDS = 300

_output = Console(highlight=False)
_errors = Console(stderr=True, highlight=False)


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
    try:
        chosen = _chosen(scores, only)
        out.mkdir(parents=True, exist_ok=True)
        for score in chosen:
            write_atomically(out / f"{score.gloss}.yaml", performance(score).text.encode())
    except LutError as error:
        _errors.print(f"{error.code}: {error}", soft_wrap=True)
        raise typer.Exit(1) from error
    except OSError as error:
        _errors.print(f"not_written: --out: expected a place to write to, got: {error}", soft_wrap=True)
        raise typer.Exit(1) from error
    if scripts_only:
        _output.print(f"{out}: {len(chosen)} scripts", soft_wrap=True)
        return
    options = ["--body", body, "--sensor", sensor, "--scene", scene, "--size", size]
    options += ["--distance", f"{distance:g}", "--rate", f"{rate:g}", "--seed", str(seed)]
    options += ["--truth-only"] if truth_only else []
    open_ones = [score.gloss for score in chosen if replace or not (out / score.gloss).exists()]
    failed = _performed(out, open_ones, options, jobs)
    for gloss, reason in failed.items():
        _errors.print(f"not_performed: {gloss}: {reason}", soft_wrap=True, markup=False)
    kept = len(chosen) - len(open_ones)
    made = len(open_ones) - len(failed)
    _output.print(f"{out}: {made} signs performed" + f", {kept} kept" * bool(kept), soft_wrap=True)
    if failed:
        raise typer.Exit(1)


def _chosen(directory: Path | None, only: list[str] | None) -> list[Score]:
    found = {score.gloss: score for score in read_scores(directory or default_scores_directory())}
    unknown = [gloss for gloss in only or [] if gloss not in found]
    if unknown:
        message = f"expected glosses with a score ({len(found)} there are), got {', '.join(unknown)}"
        raise LutError("unknown_sign", message)
    return [found[gloss] for gloss in only or found]


def _performed(out: Path, glosses: list[str], options: list[str], jobs: int) -> dict[str, str]:
    """Perform signs. Returns what was in the way, by gloss."""
    columns = (TextColumn("performing"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    failed: dict[str, str] = {}
    with ThreadPoolExecutor(jobs) as pool, Progress(*columns, console=_errors) as progress:
        task = progress.add_task("", total=len(glosses))
        running = {pool.submit(_synthesize, out, gloss, options): gloss for gloss in glosses}
        try:
            for done in as_completed(running):
                reason = done.result()
                if reason:
                    failed[running[done]] = reason
                progress.advance(task)
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise
    return failed


def _synthesize(out: Path, gloss: str, options: list[str]) -> str:
    """Run `synthesize` as a process of its own. Returns what it complained about, nothing if it did not."""
    bag, beside = out / gloss, out / f".{gloss}.{os.getpid()}"
    script = out / f"{gloss}.yaml"
    command = [sys.executable, "-m", _SYNTHESIZE, "--script", str(script), "--out", str(beside), *options]
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode:
            complaint = " ".join(_without_frames(done.stderr)).rpartition("Invalid value: ")[2]
            return complaint[-_LAST_WORDS:] or f"exit status {done.returncode}"
        shutil.rmtree(bag, ignore_errors=True)
        beside.replace(bag)
        for line in done.stderr.splitlines():
            if line.startswith(_SAYS):  # what a viewer of the recording should know
                _errors.print(f"{gloss}: {line.removeprefix(_SAYS)}", soft_wrap=True, markup=False)
    except OSError as error:
        return str(error)
    finally:
        shutil.rmtree(beside, ignore_errors=True)
    return ""


def _without_frames(said: str) -> Iterable[str]:
    """Words of a complaint, without the lines that are drawn round it."""
    return "".join(
        letter if letter.isprintable() and letter not in "╭╮╰╯─│━" else " " for letter in said
    ).split()


def main() -> None:
    """Run `perform_scores`."""
    app = typer.Typer(add_completion=False, pretty_exceptions_enable=False)
    app.command()(perform_scores)
    app()


if __name__ == "__main__":
    main()
