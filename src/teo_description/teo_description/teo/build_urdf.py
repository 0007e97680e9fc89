# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Command: write TEO's URDF from the tables of this package."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer

from teo_common.atomic_files import write_atomically
from teo_description.errors import DescriptionError
from teo_description.teo.hand_drives import DEFAULT_HAND_DRIVE, HAND_DRIVES
from teo_description.teo.urdf_writer import urdf


def _write(
    out: Annotated[Path | None, typer.Option(help="File to write; standard output without it.")] = None,
    hand_drive: Annotated[
        str, typer.Option(help=f"Gearmotors of the hands: {', '.join(HAND_DRIVES)}.")
    ] = DEFAULT_HAND_DRIVE,
) -> None:
    """Write TEO's URDF from the tables in teo_description/teo/data."""
    try:
        text = urdf(hand_drive)
    except DescriptionError as error:
        typer.echo(f"build_urdf: {error.code}: {error}", err=True)
        raise typer.Exit(1) from error
    if out is None:
        sys.stdout.write(text)
        return
    try:
        write_atomically(out, text.encode("utf-8"))
    except OSError as error:
        typer.echo(f"build_urdf: cannot write {out}: {error.strerror}", err=True)
        raise typer.Exit(1) from error


def main() -> None:
    """Entry point of ``build_urdf``."""
    typer.run(_write)
