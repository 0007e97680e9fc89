# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`lut list`: a line for every sign of a table. `lut nearest`: the signs that look most alike."""

from __future__ import annotations

import json
from collections import Counter
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
from teo_signs.likeness import Difference, Handshapes, nearest_pairs
from teo_signs.look_up_table import Lut
from teo_signs.sign import Sign, motion_hash
from teo_signs.sign_schema import STANDINGS

_output = Console(highlight=False)
# Narrowest column of sources [characters]: their names are not cut on a screen of 80.
_SOURCE_WIDTH = 17
# [characters] More than any line of the list takes.
_WIDEST = 1000


def list_signs(
    lut: TableDirectory = None,
    robot: RobotName = DEFAULT_ROBOT,
    language: LanguageCode = DEFAULT_LANGUAGE,
    kind: Annotated[str | None, typer.Option(help="lexical, letter or number.")] = None,
    as_json: AsJson = False,
) -> None:
    """One line a sign: gloss, kind, hands, duration, knots, standing, source; and how many of each."""
    table = open_table(lut, robot, language)
    signs, unreadable = _read(table)
    chosen = [sign for sign in signs if kind is None or sign.kind == kind]
    if as_json:
        print(json.dumps(_as_json(table, signs, chosen, unreadable), ensure_ascii=False))
    else:
        _print_signs(table, chosen, unreadable)


def _read(table: Lut) -> tuple[list[Sign], dict[str, LutError]]:
    """The signs of a table, and why others cannot be read."""
    signs, unreadable = [], {}
    for gloss in table.glosses():
        try:
            signs.append(table[gloss])
        except LutError as error:
            unreadable[gloss] = error
    return signs, unreadable


def _as_json(
    table: Lut, signs: list[Sign], chosen: list[Sign], unreadable: dict[str, LutError]
) -> dict[str, Any]:
    handshapes = Handshapes(signs)
    return {
        "place": table.place,
        "signs": [
            {
                "gloss": sign.gloss,
                "language": table.language.code,
                "kind": sign.kind,
                "handedness": sign.handedness,
                "duration": sign.duration,
                "standing": sign.provenance.standing,
                "source": sign.provenance.source,
                "licence": sign.provenance.licence,
                "handshapes": handshapes.of(sign),
                "motion_hash": motion_hash(sign),
            }
            for sign in chosen
        ],
        "unreadable": [
            {"gloss": gloss, "code": error.code, "message": str(error)} for gloss, error in unreadable.items()
        ],
    }


def _print_signs(table: Lut, chosen: list[Sign], unreadable: dict[str, LutError]) -> None:
    rows = Table(box=None)
    for name in ("gloss", "kind", "hands", "duration [s]", "knots", "standing"):
        rows.add_column(name, no_wrap=True)
    rows.add_column("source", min_width=_SOURCE_WIDTH)
    lines: dict[str, tuple[str, ...]] = {
        gloss: ("[red]not valid[/red]", "", "", "", "", error.code) for gloss, error in unreadable.items()
    }
    for sign in chosen:
        standing, source = sign.provenance.standing, sign.provenance.source.partition(",")[0]
        figures = (f"{sign.duration:.2f}", str(len(sign.times)))
        lines[sign.gloss] = (sign.kind, sign.handedness, *figures, standing, source)
    for gloss in sorted(lines):
        rows.add_row(gloss, *lines[gloss])
    # A narrow terminal cuts no name: let the lines run on.
    least = _output.measure(rows, options=_output.options.update(max_width=_WIDEST)).minimum
    Console(highlight=False, width=max(_output.width, least)).print(rows)
    standings = Counter(sign.provenance.standing for sign in chosen)
    counts = ", ".join(f"{standings[standing]} {standing}" for standing in STANDINGS if standings[standing])
    _output.print(
        f"{len(chosen)} signs in {table.place}: {counts}"
        + (f"; {len(unreadable)} entries not valid" if unreadable else ""),
        soft_wrap=True,
    )


def nearest(
    glosses: Annotated[
        list[str] | None, typer.Argument(help="Only pairs with one of these.", show_default=False)
    ] = None,
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
    known = {sign.gloss for sign in signs}
    if unknown := [gloss for gloss in glosses or () if gloss not in known]:
        fail(LutError("unknown_sign", f"expected signs of the kind {kind}, got {', '.join(unknown)}"))
    pairs = nearest_pairs(Robot.load(robot), signs, of=glosses)
    if as_json:
        near = _of_each(pairs, count)
        print(json.dumps({gloss: near.get(gloss, []) for gloss in glosses or near}, ensure_ascii=False))
    else:
        _print_pairs(pairs[:count])


def _of_each(pairs: list[Difference], count: int) -> dict[str, list[dict[str, Any]]]:
    """For each gloss those most like it, the nearest first, with the difference that is seen."""
    found: dict[str, list[dict[str, Any]]] = {}
    for pair in pairs:
        for one, other in ((pair.first, pair.second), (pair.second, pair.first)):
            near = found.setdefault(one, [])
            if len(near) < count:
                near.append({"gloss": other, "seen": round(pair.seen, 3)})
    return found


def _print_pairs(pairs: list[Difference]) -> None:
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
