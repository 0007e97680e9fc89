# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the commands share: consoles, how they run, how they refuse, and which scores they take."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

import typer
from rich.console import Console

from teo_common.errors import CodedError
from teo_signs.errors import LutError

if TYPE_CHECKING:  # they take a second to load, which the other commands of `lut` need not wait for
    from teo_sign_authoring.notation.score_schema import Score

output = Console(highlight=False)
errors = Console(stderr=True, highlight=False)


def run_command(command: Callable[..., None]) -> None:
    """Run a function as a command line."""
    app = typer.Typer(add_completion=False, pretty_exceptions_enable=False)
    app.command()(command)
    app()


def fail(error: CodedError) -> NoReturn:
    """Say what is wrong and end with status 1."""
    errors.print(f"{error.code}: {error}", markup=False, soft_wrap=True)
    raise typer.Exit(1) from error


def chosen_scores(directory: Path, only: Sequence[str] | None) -> dict[str, Score]:
    """The scores of a directory by gloss, or those of some glosses in their order.

    Raises:
        LutError: "unknown_sign" if one of them has none; as `read_scores`.
    """
    from teo_sign_authoring.notation.score_file import read_scores

    found = {score.gloss: score for score in read_scores(directory)}
    unknown = [gloss for gloss in only or [] if gloss not in found]
    if unknown:
        message = f"expected glosses with a score ({len(found)} there are), got {', '.join(unknown)}"
        raise LutError("unknown_sign", message)
    return {gloss: found[gloss] for gloss in only or found}
