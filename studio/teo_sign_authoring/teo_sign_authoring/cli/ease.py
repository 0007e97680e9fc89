# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`lut ease`: gives words of a table postures with which sentences take less time."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import track

from teo_signs.errors import LutError

_output = Console(highlight=False)
_errors = Console(stderr=True, highlight=False)


def ease(
    context: typer.Context,
    glosses: Annotated[
        list[str] | None, typer.Argument(metavar="[GLOSS]...", help="Which words; all without it.")
    ] = None,
    lut: Annotated[Path | None, typer.Option(help="Directory of the table; your own without it.")] = None,
) -> None:
    """Give words another posture that shows the same and is quicker to reach; the planner chooses."""
    from teo_description.robot import Robot
    from teo_sign_authoring.easing.easy_table import EasyTable
    from teo_signs.look_up_table import Lut
    from teo_signs.sign_file import save_sign

    eased = 0
    try:
        directory = context.obj()[0] if lut is None else lut
        table = Lut.open(directory)
        # A table of a few signs stands among those of the package.
        easy = EasyTable(Robot.load(), dict(Lut.open()) | dict(table))
        chosen = [table[gloss] for gloss in glosses or table]
        for sign in track(chosen, description="easing", console=_errors, transient=True):
            if sign.kind != "lexical":
                continue
            easier = easy.eased(sign)
            save_sign(directory, easier, replace=True)
            eased += bool(easier.alternatives)
    except LutError as error:
        _errors.print(f"{error.code}: {error}", markup=False)
        raise typer.Exit(1) from error
    _output.print(f"{directory}: {eased} of {len(chosen)} signs have an easier posture")
