# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`lut nearest`: the signs of a table that look most alike."""

from __future__ import annotations

import json
from typing import Annotated, Any

import numpy as np
import typer
from rich.console import Console
from rich.table import Table

from teo_description.humanoid import DEFAULT_ROBOT
from teo_lut_executor.cli.options import (
    AsJson,
    LanguageCode,
    RobotName,
    TableDirectory,
    fail,
    open_table,
    signs_of_kind,
)
from teo_sign_languages import DEFAULT_LANGUAGE
from teo_signs.errors import LutError
from teo_signs.likeness import Difference, nearest_pairs

_output = Console(highlight=False)


def nearest(
    count: Annotated[
        int, typer.Option(help="How many pairs, or with --json how many of each sign.", min=1)
    ] = 15,
    kind: Annotated[str, typer.Option(help="lexical, letter or number.")] = "letter",
    lut: TableDirectory = None,
    robot: RobotName = DEFAULT_ROBOT,
    language: LanguageCode = DEFAULT_LANGUAGE,
    as_json: AsJson = False,
) -> None:
    """The pairs of signs that look most alike; with --json, for each sign those most like it."""
    from teo_description.robot import Robot

    signs = signs_of_kind(open_table(lut, robot, language), kind)
    if as_json and not signs:
        fail(LutError("unknown_sign", f"--kind: expected a kind that the table has, got {kind!r}"))
    pairs = nearest_pairs(Robot.load(robot), signs)
    if as_json:
        print(json.dumps(_of_each(pairs, count), ensure_ascii=False))
    else:
        _print(pairs[:count])


def _of_each(pairs: list[Difference], count: int) -> dict[str, list[dict[str, Any]]]:
    """For each gloss those most like it, the nearest first, with the difference that is seen."""
    found: dict[str, list[dict[str, Any]]] = {}
    for pair in pairs:
        for one, other in ((pair.first, pair.second), (pair.second, pair.first)):
            near = found.setdefault(one, [])
            if len(near) < count:
                near.append({"gloss": other, "seen": round(pair.seen, 3)})
    return found


def _print(pairs: list[Difference]) -> None:
    # Rich takes "[mm]" for markup.
    columns = (r"handshape \[mm]", r"orientation \[deg]", r"movement \[mm]", r"place \[mm]")
    table = Table("pair", "seen", *columns, box=None)
    for pair in pairs:
        table.add_row(
            f"{pair.first} {pair.second}",
            f"{pair.seen:.1f}",
            f"{1000.0 * pair.handshape:.0f}",
            f"{np.degrees(pair.orientation):.0f}",
            f"{1000.0 * pair.movement:.0f}",
            f"{1000.0 * pair.place:.0f}",
        )
    _output.print(table)
    _output.print(
        "seen: the largest difference, in finger thicknesses (15 mm), 15 deg or neighbouring places on the "
        "face (28 mm); below 1 they look alike",
        soft_wrap=True,
    )
