# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`lut recognise`: which signs of the table a demonstration may be."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.table import Table

from teo_sign_capture.cli.capture import Cache, End, Hands, Person, Start, Topic, fail
from teo_signs.errors import LutError

_output = Console(highlight=False)
_errors = Console(stderr=True, highlight=False)


def recognise(
    recording: Annotated[
        Path,
        typer.Argument(help="Bag of images or of skeletons, or a .pose file, in which one sign is shown."),
    ],
    count: Annotated[int, typer.Option(min=1, help="How many signs to name.")] = 5,
    lut: Annotated[
        Path | None,
        typer.Option(
            "--lut", help="Directory of the table; your own and, beneath it, the package's without it."
        ),
    ] = None,
    start: Start = None,
    end: End = None,
    hands: Hands = None,
    person: Person = None,
    topic: Topic = None,
    cache: Cache = None,
) -> None:
    """Name the signs of the table that look most like a demonstration, with their distances.

    Exit status: 0, 1 if the recording shows no sign (code and reason on standard error), 2 wrong options.
    """
    from teo_description.robot import Robot
    from teo_sign_capture.entries.bag_capture import Settings, recorded_track
    from teo_sign_capture.recognition.appearance import recording_appearance
    from teo_sign_capture.recognition.sign_index import SignIndex
    from teo_sign_capture.recordings.recording import default_cache, open_recording
    from teo_signs.look_up_table import Lut, user_lut_directory

    robot = Robot.load()
    try:
        signs = Lut.open(lut)
        if not signs:
            raise LutError("empty_table", f"expected a table with signs, got none in {signs.place}")
        with _errors.status(f"looking at {recording.name}"):
            settings = Settings(table=user_lut_directory(), topic=topic, cache=cache or default_cache())
            track, _ = recorded_track(open_recording(recording), settings, person=person)
            shown = recording_appearance(robot, track, start=start, end=end, handedness=hands)
            matches = SignIndex.of_signs(robot, signs.values()).nearest(shown, count)
    except LutError as error:
        fail(error)
    table = Table("sign", "distance", box=None)
    for match in matches:
        table.add_row(match.gloss, f"{match.distance:.2f}")
    _output.print(table)
    _output.print("distance: 1 is two differences that are just seen, all through the sign", soft_wrap=True)
