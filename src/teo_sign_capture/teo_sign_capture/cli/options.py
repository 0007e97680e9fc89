# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Options that several commands share: what each is called, takes and says of itself."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import typer

from teo_description.errors import DescriptionError
from teo_description.humanoid import load_humanoid
from teo_sign_languages import LanguageError, load_language
from teo_signs.errors import LutError

Bags = Annotated[
    list[Path] | None,
    typer.Argument(
        help="Video (mp4, mov, webm), bag of colour and depth images or of skeletons, or .pose file; several "
        "are takes of one sign. Or one folder of them (or of folders of takes), named after their glosses: "
        "GLOSS, or GLOSS_1, GLOSS_2."
    ),
]


def upper_case(gloss: str | None) -> str | None:
    """A gloss as it is written, however it was typed."""
    return gloss and gloss.upper()


def known_language(robot: str, language: str) -> str:
    """The language's code, if there are such a robot and language.

    Raises:
        LutError: "unknown_robot", "unknown_language" or what else is wrong with them.
    """
    try:
        load_humanoid(robot)
        return load_language(language).code
    except (DescriptionError, LanguageError) as error:
        raise LutError(error.code, str(error)) from error


Gloss = Annotated[str | None, typer.Option(help="Name of the sign; not with a folder.", callback=upper_case)]
Start = Annotated[float | None, typer.Option(help="Look at the recording from this second on.")]
End = Annotated[float | None, typer.Option(help="Look at the recording up to this second.")]
TableDirectory = Annotated[
    Path | None, typer.Option("--lut", help="Directory of the table; your own without it.")
]
RobotName = Annotated[str, typer.Option("--robot", help="Name of the robot.")]
LanguageCode = Annotated[str, typer.Option("--language", help="Code of the sign language.")]
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
# The licence of an entry of which nobody said one.
NOT_STATED = "not stated: ask the person who signs before passing it on"
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
Trial = Annotated[
    Path | None,
    typer.Option(help="Write entry and picture into this directory, to look at; the table stays as it is."),
]
Manifest = Annotated[
    Path | None, typer.Option(help="CSV with a row for each take: bag, gloss[, start, end, hands, person].")
]
Workers = Annotated[
    int | None, typer.Option("--jobs", min=1, help="Signs captured at a time; one for each core without it.")
]
Dask = Annotated[
    str | None, typer.Option(help="Address of a Dask scheduler that does the work: tcp://HOST:8786.")
]
AsJson = Annotated[
    bool,
    typer.Option("--json", help="Say progress and outcome as a JSON object a line, for programs."),
]
