# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`draw_signwriting`: the signs of the look-up table as the dictionary that they are from writes them."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from teo_sign_authoring.signwriting.dictionary_file import read_dictionary
from teo_sign_authoring.signwriting.drawing import Pen, find_written, named_term, write_drawings
from teo_sign_capture.cli.reporting import fail
from teo_signs.errors import LutError
from teo_signs.look_up_table import Lut, user_lut_directory

_output = Console(highlight=False)
_errors = Console(stderr=True, highlight=False)


def draw_signwriting(
    dictionary: Annotated[
        Path, typer.Argument(help="SignPuddle's export (.spml), or term and FSW with a tab between.")
    ],
) -> None:
    """Draw signs in SignWriting for the console: those whose source is an entry of SignPuddle's dictionary.

    Writes signs.json and drawings.svg to teo/signwriting of the data home, in place of those of before.

    Exit status: 0 if any was drawn, 1 if none was.
    """
    folder = user_lut_directory().parent / "signwriting"
    try:
        entries = read_dictionary(dictionary)
        terms = _terms(Lut.open())
        found, missing = find_written(terms, entries)
        pen = Pen()
        drawings = {}
        for entry in found:
            try:
                drawings[entry] = pen.draw(entry)
            except LutError as error:
                missing[entry.gloss] = error.code
        for gloss, code in sorted(missing.items()):
            _errors.print(f'{code}: {gloss}: entry "{terms[gloss]}"', soft_wrap=True, markup=False)
        if not drawings:
            raise LutError(
                "nothing_drawn",
                f"{dictionary.name}: expected entries that the table names ({len(terms)}), got none of them",
            )
        write_drawings(folder, drawings)
    except LutError as error:
        fail(error)
    except OSError as error:
        fail(LutError("not_written", f"{folder}: expected a place to write to, got: {error}"))
    _output.print(
        f"{folder}: {len(drawings)} of {len(terms)} signs drawn that name an entry of the dictionary",
        soft_wrap=True,
        markup=False,
    )


def _terms(table: Lut) -> dict[str, str]:
    """Terms of the dictionary by the glosses whose sources they are; an entry that is not good is named."""
    terms = {}
    for gloss in table:
        try:
            term = named_term(table[gloss].provenance.source)
        except LutError as error:
            _errors.print(f"{error.code}: {error}", soft_wrap=True, markup=False)
            continue
        if term is not None:
            terms[gloss] = term
    return terms


def main() -> None:
    """Run `draw_signwriting`."""
    app = typer.Typer(add_completion=False, pretty_exceptions_enable=False)
    app.command()(draw_signwriting)
    app()


if __name__ == "__main__":
    main()
