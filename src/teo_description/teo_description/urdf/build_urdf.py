# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Command: write TEO's URDF from the tables of this package."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer

from teo_common.atomic_files import write_atomically
from teo_description.urdf.urdf_writer import urdf


def _write(
    out: Annotated[Path | None, typer.Option(help="File to write; standard output without it.")] = None,
) -> None:
    """Write TEO's URDF from the tables in teo_description/data."""
    if out is None:
        sys.stdout.write(urdf())
        return
    try:
        write_atomically(out, urdf().encode("utf-8"))
    except OSError as error:
        typer.echo(f"build_urdf: cannot write {out}: {error.strerror}", err=True)
        raise typer.Exit(1) from error


def main() -> None:
    """Entry point of ``build_urdf``."""
    typer.run(_write)
