# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`lut recognise`: which signs of the table a demonstration may be."""

from __future__ import annotations

import sys
from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.table import Table

from teo_description.errors import DescriptionError
from teo_description.humanoid import DEFAULT_ROBOT
from teo_sign_capture.cli import options
from teo_sign_capture.cli.reporting import JsonReporter, TerminalReporter, write_json
from teo_sign_languages import DEFAULT_LANGUAGE
from teo_signs.errors import LutError

_output = Console(highlight=False)


def recognise(
    recording: Annotated[
        Path,
        typer.Argument(
            help="Video, bag of images or of skeletons, or .pose file, in which one sign is shown."
        ),
    ],
    count: Annotated[int, typer.Option(min=1, help="How many signs to name.")] = 5,
    lut: Annotated[
        Path | None,
        typer.Option(
            "--lut", help="Directory of the table; your own and, beneath it, the package's without it."
        ),
    ] = None,
    robot_name: options.RobotName = DEFAULT_ROBOT,
    language: options.LanguageCode = DEFAULT_LANGUAGE,
    start: options.Start = None,
    end: options.End = None,
    hands: options.Hands = None,
    person: options.Person = None,
    topic: options.Topic = None,
    cache: options.Cache = None,
    meant: Annotated[
        str | None, typer.Option(help="Gloss that was meant: also say what differs from its sign.")
    ] = None,
    as_json: options.AsJson = False,
) -> None:
    """Name the signs of the table that look most like a demonstration, with their distances.

    Exit status: 0, 1 if the recording shows no sign (code and reason on standard error), 2 wrong options.
    """
    from teo_description.robot import Robot
    from teo_sign_capture.recognition import (
        COUNT,
        SignIndex,
        compare,
        recording_appearance,
        sign_appearance,
        stands_out,
    )
    from teo_sign_capture.recordings.recording import default_cache, open_recording, track_of
    from teo_signs.look_up_table import Lut

    reporter = JsonReporter() if as_json else TerminalReporter()
    try:
        robot = Robot.load(robot_name)
        signs = Lut.open(lut, language=language, robot=robot_name)
        if not signs:
            raise LutError("empty_table", f"expected a table with signs, got none in {signs.place}")
        wanted = None if meant is None else sign_appearance(robot, signs[meant])  # unknown: say so at once
        with reporter:
            track, _ = track_of(
                open_recording(recording),
                cache=cache or default_cache(),
                topic=topic,
                person=person,
                on_progress=lambda done, total: reporter.progress(
                    f"looking for keypoints in {recording.name}", done, total
                ),
            )
            reporter.progress("comparing", 0, len(signs))
            shown = recording_appearance(robot, track, start=start, end=end, handedness=hands)
            nearest = SignIndex.of_signs(robot, signs.values()).nearest(shown, max(count, COUNT))
        matches, sure = nearest[:count], stands_out(nearest)
        compared = None if meant is None or wanted is None else compare(meant, shown, wanted)
    except (LutError, DescriptionError) as error:
        reporter.failed(None, LutError(error.code, str(error)))
        raise typer.Exit(1) from error
    if as_json:
        found = [asdict(match) for match in matches]
        told: dict[str, object] = {
            "code": "recognised",
            "recording": recording.name,
            "matches": found,
            "sure": sure,
        }
        if compared is not None:
            told["compared"] = asdict(compared)
        write_json(told, sys.stdout)
        return
    table = Table("sign", "distance", box=None)
    for match in matches:
        table.add_row(match.gloss, f"{match.distance:.2f}")
    _output.print(table)
    _output.print("distance: a person's sign is 2 to 4 from its own entry", soft_wrap=True)
    said = f"surely {matches[0].gloss}" if sure else "none stands out: one of these, or none of the table"
    _output.print(said, soft_wrap=True)
    if compared is not None:
        parts = ("handshape", "orientation", "place", "movement")
        differences = ", ".join(f"{part} {getattr(compared, part):.2f}" for part in parts)
        other = "" if compared.hands else "; another number of hands"
        _output.print(f"beside {compared.gloss}: {differences}{other}", soft_wrap=True)
