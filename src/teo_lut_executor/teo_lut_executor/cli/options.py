# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the commands of `lut` share: options, and how they fail."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, NoReturn

import typer
from rich.console import Console

from teo_signs.errors import LutError

TableDirectory = Annotated[
    Path | None,
    typer.Option("--lut", help="Directory of the table; your own and, beneath it, the package's without it."),
]
Replace = Annotated[bool, typer.Option("--replace", help="Replace what is there already.")]

_errors = Console(stderr=True, highlight=False)


def fail(error: LutError) -> NoReturn:
    """Print an error's code and sentence and exit with status 1."""
    _errors.print(f"{error.code}: {error}", markup=False, soft_wrap=True)
    raise typer.Exit(1) from error
