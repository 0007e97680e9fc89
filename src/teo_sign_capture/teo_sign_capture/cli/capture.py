# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`lut capture`: from recordings of a person to entries of the table."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, cast

import typer

from teo_description.humanoid import DEFAULT_ROBOT
from teo_sign_capture.cli import options
from teo_sign_capture.cli.reporting import JsonReporter, Reporter, TerminalReporter
from teo_sign_languages import DEFAULT_LANGUAGE
from teo_signs.errors import LutError
from teo_signs.look_up_table import user_lut_directory
from teo_skeleton_retriever.camera.synchroniser import DEFAULT_SLOP

if TYPE_CHECKING:  # they take a second to load, which the other commands of `lut` need not wait for
    from teo_sign_capture.entries.bag_capture import CaptureJob, Outcome, Settings


def capture(
    bags: options.Bags = None,
    gloss: options.Gloss = None,
    start: options.Start = None,
    end: options.End = None,
    robot: options.RobotName = DEFAULT_ROBOT,
    language: options.LanguageCode = DEFAULT_LANGUAGE,
    lut: options.TableDirectory = None,
    replace: options.Replace = False,
    person: options.Person = None,
    hands: options.Hands = None,
    kind: options.KindOption = "lexical",
    standing: options.StandingOption = None,
    licence: options.Licence = options.NOT_STATED,
    notes: options.Notes = "",
    accept: options.Accept = False,
    camera: options.Camera = None,
    seconds: options.Seconds = 5.0,
    topic: options.Topic = None,
    slop: options.Slop = DEFAULT_SLOP,
    cache: options.Cache = None,
    picture: options.Picture = None,
    draw: options.Draw = True,
    film: options.Film = False,
    trial: options.Trial = None,
    manifest: options.Manifest = None,
    jobs: options.Workers = None,
    dask: options.Dask = None,
    as_json: options.AsJson = False,
) -> None:
    """Capture a sign from recordings of a person, or every sign of a folder of recordings.

    Exit status: 0 captured, 1 not (code and reason on standard error), 2 wrong options.
    """
    reporter = JsonReporter() if as_json else TerminalReporter()
    from teo_sign_capture.entries.bag_capture import CaptureJob, Settings, check_free
    from teo_sign_capture.entries.batch import find_jobs, read_manifest
    from teo_sign_capture.entries.take import Cut
    from teo_sign_capture.recordings.recording import default_cache, is_bag

    try:
        language = options.known_language(robot, language)
        table = lut or user_lut_directory(language, robot)
        settings = Settings(
            table=table,
            robot=robot,
            language=language,
            replace=replace,
            kind=kind,
            standing=standing,
            licence=licence,
            notes=notes,
            accept=accept,
            topic=topic,
            slop=slop,
            cache=cache or default_cache(),
            pictures=(picture or trial or table) if draw else None,
            film=film,
            trial=trial,
        )
        cut = Cut(start=start, end=end)
        if camera is not None:
            if gloss is None or bags or manifest is not None:
                raise LutError("bad_arguments", "expected --camera NUMBER --gloss GLOSS, and no recording")
            check_free(gloss, settings)
            bags = [_filmed(camera, gloss, seconds, reporter)]
        if gloss is not None and bags and manifest is None:
            job = CaptureJob(gloss=gloss, bags=tuple(bags), cut=cut, handedness=hands, person=person)
            capture_one(job, settings, reporter)
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
        _capture_all(found, settings, jobs or os.cpu_count() or 1, dask, reporter)
    except LutError as error:
        reporter.failed(gloss, error)
        raise typer.Exit(1) from error


def _filmed(camera: int, gloss: str, seconds: float, reporter: Reporter) -> Path:
    """Film a sign with a webcam, counting down, and return the film, which is kept."""
    from teo_sign_capture.entries.bag_capture import default_recordings
    from teo_sign_capture.recordings.video import film_name, film_webcam

    out = film_name(default_recordings(), gloss)
    film_webcam(camera, out, seconds=seconds, on_state=reporter.camera)
    return out


def capture_one(job: CaptureJob, settings: Settings, reporter: Reporter) -> None:
    """Capture a sign and say how well it was captured."""
    from teo_description.robot import Robot
    from teo_sign_capture.entries.bag_capture import capture_bags, captured_outcome

    with reporter:
        saved = capture_bags(Robot.load(settings.robot), job, settings, reporter.progress)
    reporter.captured(captured_outcome(saved))


def _capture_all(
    jobs: list[CaptureJob], settings: Settings, count: int, dask: str | None, reporter: Reporter
) -> None:
    from teo_sign_capture.entries.bag_capture import failures
    from teo_sign_capture.entries.batch import run_jobs, workers

    ended: list[Outcome] = []

    def done(outcome: Outcome) -> None:
        ended.append(outcome)
        reporter.one_of_many(outcome)
        reporter.progress("capturing", len(ended), len(jobs))

    with workers(count, dask) as executor, reporter:
        reporter.progress("capturing", 0, len(jobs))
        outcomes = run_jobs(executor, jobs, settings, done)
    reporter.end(outcomes, settings.table)
    if failures(outcomes):
        raise typer.Exit(1)
