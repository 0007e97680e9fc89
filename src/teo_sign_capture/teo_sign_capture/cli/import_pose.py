# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`lut import`: a sign from a clip in which a person's points were found, or a dictionary in SignWriting."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path
from typing import Annotated

import typer

from teo_common.installed_packages import NotOfferedError, offered_command
from teo_sign_capture.cli import options
from teo_sign_capture.cli.reporting import TerminalReporter, fail
from teo_sign_languages import DEFAULT_LANGUAGE
from teo_signs.errors import LutError

_DAY = "%Y-%m-%d"


def import_pose(
    file: Annotated[
        Path | None, typer.Argument(help="A .pose file: MediaPipe Holistic's or OpenPose's points.")
    ] = None,
    gloss: Annotated[
        str | None, typer.Option(help="Name of the sign in a .pose file.", callback=options.upper_case)
    ] = None,
    signwriting: Annotated[
        Path | None,
        typer.Option(help="A dictionary in SignWriting: SignPuddle's .spml, or a TSV of term and FSW."),
    ] = None,
    start: options.Start = None,
    end: options.End = None,
    lut: options.TableDirectory = None,
    replace: options.Replace = False,
    person: Annotated[int | None, typer.Option(help="Which of several people, from 0.")] = None,
    hands: options.Hands = None,
    kind: options.KindOption = "lexical",
    standing: options.StandingOption = None,
    recorded: Annotated[
        datetime | None, typer.Option(formats=[_DAY], help="Day of the recording, for the entry.")
    ] = None,
    licence: Annotated[
        str | None, typer.Option(help="Terms of the recording or the dictionary; 'not stated' without it.")
    ] = None,
    notes: options.Notes = "",
    accept: options.Accept = False,
    picture: options.Picture = None,
    draw: options.Draw = True,
    scores: Annotated[
        Path | None, typer.Option(help="SignWriting: directory for the scores that signs are compiled to.")
    ] = None,
    source: Annotated[
        str, typer.Option(help="SignWriting: the dictionary, for the entries.")
    ] = "SignPuddle LSE dictionary",
    only: Annotated[
        list[str] | None, typer.Option(help="SignWriting: a gloss; may be given again. All without it.")
    ] = None,
    any_term: Annotated[
        bool, typer.Option("--any-term", help="SignWriting: take terms that are no known words.")
    ] = False,
    jobs: Annotated[
        int | None, typer.Option(min=1, help="SignWriting: signs at a time; one for each core without it.")
    ] = None,
    report: Annotated[
        Path | None,
        typer.Option(
            help="SignWriting: JSON file of what became of each entry; where it is there, what it says is "
            "not tried again, except with --replace."
        ),
    ] = None,
    language: options.LanguageCode = DEFAULT_LANGUAGE,
    as_json: Annotated[bool, typer.Option("--json", help="SignWriting: tell a program.")] = False,
) -> None:
    """Capture a sign from a clip in which a person's points were found, lifted by the lengths of limbs.

    With --signwriting: compile every sign of a dictionary in SignWriting; what the table has stays as it is.

    Exit status: 0 captured, 1 not (code and reason on standard error), 2 wrong options.
    """
    if signwriting is not None:
        if file is not None or gloss is not None:
            fail(
                LutError("bad_arguments", "expected --signwriting FILE, or FILE.pose --gloss GLOSS, got both")
            )
        try:
            import_signwriting = offered_command("import_signwriting")
        except NotOfferedError as error:
            fail(LutError("not_installed", str(error)))
        import_signwriting(
            signwriting,
            language=language,
            table=lut,
            scores=scores,
            replace=replace,
            source=source,
            licence=licence,
            only=only or [],
            any_term=any_term,
            jobs=jobs,
            report=report,
            as_json=as_json,
        )
        return
    if file is None or gloss is None:
        fail(LutError("bad_arguments", "expected FILE.pose --gloss GLOSS, or --signwriting FILE"))

    from teo_sign_capture.cli.capture import capture_one
    from teo_sign_capture.entries.bag_capture import CaptureJob, Settings
    from teo_sign_capture.entries.take import Cut
    from teo_signs.look_up_table import user_lut_directory

    try:
        table = lut or user_lut_directory(language)
        settings = Settings(
            table=table,
            language=language,
            replace=replace,
            kind=kind,
            standing=standing,
            licence=licence or options.NOT_STATED,
            notes=notes,
            accept=accept,
            recorded=None if recorded is None else recorded.strftime(_DAY),
            pictures=(picture or table) if draw else None,
        )
        cut = Cut(start=start, end=end)
        job = CaptureJob(gloss=gloss, bags=(file,), cut=cut, handedness=hands, person=person)
        capture_one(job, settings, TerminalReporter())
    except LutError as error:
        fail(error)
