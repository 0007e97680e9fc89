# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`lut capture`: from recordings of a person to entries of the table."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal, NoReturn, cast

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn
from rich.table import Table

from teo_signs.errors import LutError
from teo_signs.look_up_table import user_lut_directory
from teo_skeleton_retriever.camera.synchroniser import DEFAULT_SLOP

if TYPE_CHECKING:  # they take a second to load, which the other commands of `lut` need not wait for
    from teo_sign_capture.entries.bag_capture import Job, Saved, Settings

_output = Console(highlight=False)
_errors = Console(stderr=True, highlight=False)

Bags = Annotated[
    list[Path] | None,
    typer.Argument(
        help="Video (mp4, mov, webm), bag of colour and depth images or of skeletons, or .pose file; several "
        "are takes of one sign. Or one folder of them (or of folders of takes), named after their glosses: "
        "GLOSS, or GLOSS_1, GLOSS_2."
    ),
]
Gloss = Annotated[str | None, typer.Option(help="Name of the sign; not with a folder.")]
Start = Annotated[float | None, typer.Option(help="Look at the recording from this second on.")]
End = Annotated[float | None, typer.Option(help="Look at the recording up to this second.")]
TableDirectory = Annotated[
    Path | None, typer.Option("--lut", help="Directory of the table; your own without it.")
]
Replace = Annotated[bool, typer.Option("--replace", help="Take the place of an entry that is there.")]
Person = Annotated[int | None, typer.Option(help="Id of the person; the signer without it.")]
Hands = Annotated[
    Literal["right", "left", "both"] | None,
    typer.Option(help="Hands that make the sign; those that leave rest without it."),
]
KindOption = Annotated[Literal["lexical", "letter", "number"], typer.Option("--kind", help="Kind of sign.")]
StandingOption = Annotated[
    Literal["recorded", "measured", "described", "sketched"] | None,
    typer.Option(
        "--standing",
        help="How well founded the form is. Without it: recorded, or sketched where a program drew the "
        "recording.",
    ),
]
Licence = Annotated[str, typer.Option(help="Terms of the recording, for the entry.")]
Notes = Annotated[str, typer.Option(help="What a reader must know, for the entry.")]
Accept = Annotated[
    bool,
    typer.Option("--accept", help="Take a sign beyond a gate as it is, one level less well founded."),
]
Camera = Annotated[
    int | None, typer.Option(min=0, help="Film the sign with this webcam first: 0 is the usual one.")
]
Seconds = Annotated[
    float, typer.Option(min=1.0, max=30.0, help="With --camera: how long it films after the countdown [s].")
]
Topic = Annotated[str | None, typer.Option(help="Topic of the skeletons; found by itself.")]
Slop = Annotated[
    float,
    typer.Option(
        min=0.0, max=1.0, help="Greatest difference between the stamps of colour and depth images [s]."
    ),
]
Cache = Annotated[
    Path | None, typer.Option(help="Where skeletons found in images are kept; the user's cache without it.")
]
Picture = Annotated[
    Path | None, typer.Option(help="Directory of the pictures; beside the entries without it.")
]
Draw = Annotated[bool, typer.Option("--draw/--no-draw", help="Draw demonstration and robot side by side.")]
Film = Annotated[bool, typer.Option("--film", help="Film them as well (MP4).")]
Manifest = Annotated[
    Path | None, typer.Option(help="CSV with a row for each take: bag, gloss[, start, end, hands, person].")
]
Workers = Annotated[
    int | None, typer.Option("--jobs", min=1, help="Signs captured at a time; one for each core without it.")
]
Dask = Annotated[
    str | None, typer.Option(help="Address of a Dask scheduler that does the work: tcp://HOST:8786.")
]


def capture(
    bags: Bags = None,
    gloss: Gloss = None,
    start: Start = None,
    end: End = None,
    lut: TableDirectory = None,
    replace: Replace = False,
    person: Person = None,
    hands: Hands = None,
    kind: KindOption = "lexical",
    standing: StandingOption = None,
    licence: Licence = "not stated: ask the person who signs before passing it on",
    notes: Notes = "",
    accept: Accept = False,
    camera: Camera = None,
    seconds: Seconds = 5.0,
    topic: Topic = None,
    slop: Slop = DEFAULT_SLOP,
    cache: Cache = None,
    picture: Picture = None,
    draw: Draw = True,
    film: Film = False,
    manifest: Manifest = None,
    jobs: Workers = None,
    dask: Dask = None,
) -> None:
    """Capture a sign from recordings of a person, or every sign of a folder of recordings.

    Exit status: 0 captured, 1 not (code and reason on standard error), 2 wrong options.
    """
    from teo_sign_capture.entries.bag_capture import Job, Settings, check_free
    from teo_sign_capture.entries.batch import find_jobs, read_manifest
    from teo_sign_capture.entries.take import Cut
    from teo_sign_capture.recordings.recording import default_cache, is_bag

    try:
        table = lut or user_lut_directory()
        settings = Settings(
            table=table,
            replace=replace,
            kind=kind,
            standing=standing,
            licence=licence,
            notes=notes,
            accept=accept,
            topic=topic,
            slop=slop,
            cache=cache or default_cache(),
            pictures=(picture or table) if draw else None,
            film=film,
        )
        cut = Cut(start=start, end=end)
        if camera is not None:
            if gloss is None or bags or manifest is not None:
                raise LutError("bad_arguments", "expected --camera NUMBER --gloss GLOSS, and no recording")
            check_free(gloss, settings)
            bags = [_filmed(camera, gloss, seconds)]
        if gloss is not None and bags and manifest is None:
            job = Job(gloss=gloss, bags=tuple(bags), cut=cut, handedness=hands, person=person)
            _capture_one(job, settings)
            return
        one_folder = bags is not None and len(bags) == 1 and bags[0].is_dir() and not is_bag(bags[0])
        if gloss is not None or one_folder == (manifest is not None) or (bags and not one_folder):
            raise LutError(
                "bad_arguments",
                "expected RECORDING ... --gloss GLOSS, one folder of recordings, or --manifest FILE",
            )
        if cut != Cut() or hands is not None or person is not None:
            raise LutError(
                "bad_arguments", "--start, --end, --hands and --person are for one sign: see --manifest"
            )
        found = read_manifest(manifest) if manifest is not None else find_jobs(cast(list[Path], bags)[0])
        _capture_all(found, settings, jobs or os.cpu_count() or 1, dask)
    except LutError as error:
        fail(error)


def fail(error: LutError) -> NoReturn:
    """Say what is wrong and end."""
    _errors.print(f"{error.code}: {error}", markup=False, soft_wrap=True)
    raise typer.Exit(1) from error


def tell(saved: Saved) -> None:
    """Say what was captured, how well, and where it is."""
    sign = saved.captured.sign
    span = saved.captured.take.span
    _output.print(
        f"{sign.gloss}: {sign.handedness}, {sign.duration:.2f} s in {len(sign.times)} knots, from "
        f"{span.start:.2f} to {span.end:.2f} s of {saved.captured.take.source}",
        soft_wrap=True,
    )
    table = Table(box=None, show_header=False)
    for name, figure in sign.quality.items():
        words = name.split("_")
        unit = {"deg": "°", "percent": "%", "times": "times", "count": ""}.get(words[-1], words[-1])
        table.add_row(" ".join(words[:-1]), f"{figure:g}", unit)
    _output.print(table)
    for note in filter(None, (saved.captured.sign.provenance.notes, *saved.warnings)):
        _output.print(f"note: {note}", markup=False, soft_wrap=True)
    if sign.provenance.standing == "sketched":
        _output.print(
            "standing sketched: the executor spells the word until its least_standing is sketched; "
            "see --standing",
            soft_wrap=True,
        )
    for path in filter(None, (saved.path, saved.picture)):
        _output.print(f"wrote {path}", markup=False, soft_wrap=True)


def _filmed(camera: int, gloss: str, seconds: float) -> Path:
    """Film a sign with a webcam, counting down, and return the film, which is kept."""
    from teo_sign_capture.recordings.recording import default_cache
    from teo_sign_capture.recordings.webcam import film_name, film_webcam

    out = film_name(default_cache().parent / "recordings", gloss)
    return film_webcam(camera, out, seconds=seconds, on_state=lambda state: _errors.print(state))


def _capture_one(job: Job, settings: Settings) -> None:
    from teo_description.robot import Robot
    from teo_sign_capture.entries.bag_capture import capture_bags

    with _progress() as progress:
        task = progress.add_task("capturing", total=None)

        def told(what: str, done: int, total: int) -> None:
            progress.update(task, description=what, completed=done, total=total)

        saved = capture_bags(Robot.load(), job, settings, told)
    tell(saved)


def _capture_all(jobs: list[Job], settings: Settings, count: int, dask: str | None) -> None:
    from teo_sign_capture.entries.batch import CAPTURED, Outcome, failures, run_jobs, workers

    with workers(count, dask) as executor, _progress() as progress:
        task = progress.add_task("capturing", total=len(jobs))

        def done(outcome: Outcome) -> None:
            progress.advance(task)
            if outcome.code == CAPTURED:
                progress.console.print(f"{outcome.gloss}: {outcome.message}", markup=False)

        outcomes = run_jobs(executor, jobs, settings, done)
    failed = failures(outcomes)
    captured = sum(outcome.code == CAPTURED for outcome in outcomes)
    if failed:
        table = Table("gloss", "code", "reason", title="not captured")
        for outcome in failed:
            table.add_row(outcome.gloss, outcome.code, outcome.message)
        _output.print(table)
    _output.print(
        f"{captured} captured, {len(outcomes) - captured - len(failed)} as before, {len(failed)} failed, "
        f"in {settings.table}",
        soft_wrap=True,
    )
    if failed:
        raise typer.Exit(1)


def _progress() -> Progress:
    return Progress(
        TextColumn("{task.description}", markup=False),
        BarColumn(),
        MofNCompleteColumn(),
        TimeRemainingColumn(),
        console=_errors,
        transient=True,
        disable=not _errors.is_terminal,
    )
