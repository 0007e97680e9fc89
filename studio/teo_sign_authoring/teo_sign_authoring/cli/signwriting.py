# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`lut import --signwriting` and `draw_signwriting`: signs from a dictionary, and as it draws them."""

from __future__ import annotations

import json
import os
from collections import Counter
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from teo_sign_capture.cli.reporting import fail
from teo_signs.errors import LutError
from teo_signs.look_up_table import Lut, user_lut_directory

if TYPE_CHECKING:
    from teo_sign_authoring.signwriting.dictionary_import import ImportJob, ImportOutcome, ImportSettings

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
    from teo_sign_authoring.signwriting.dictionary_file import read_dictionary
    from teo_sign_authoring.signwriting.drawing import Pen, find_written, write_drawings

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
    from teo_sign_authoring.signwriting.drawing import named_term

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


_NO_LICENCE = "not stated"


def import_signwriting(
    file: Path,
    *,
    table: Path | None,
    scores: Path | None,
    replace: bool,
    source: str,
    licence: str | None,
    only: list[str],
    any_term: bool,
    jobs: int | None,
    report: Path | None,
) -> None:
    """Import a dictionary, with its progress, and say what became of it.

    Args:
        file: SPML, or term and FSW in a table of tab-separated values.
        table: Directory of the table; the user's own if None.
        scores: Directory for the scores as well.
        replace: Whether to make entries anew that are there and no better founded.
        source: What entries name as their source.
        licence: Terms of the dictionary; "not stated" if None.
        only: Glosses that are wanted; all if empty.
        any_term: Whether terms that are no Spanish words are taken as typed.
        jobs: Processes; one for each core if None.
        report: File for what became of each entry, .tsv or .json.
    """
    from teo_sign_authoring.signwriting.dictionary_file import GlossNames, read_dictionary
    from teo_sign_authoring.signwriting.dictionary_import import ImportSettings, find_jobs

    try:
        if report is not None and report.suffix not in (".tsv", ".json"):
            raise LutError("bad_arguments", f"--report: expected a file .tsv or .json, got {report.name}")
        found = find_jobs(read_dictionary(file), GlossNames(any_term=any_term), only)
        settings = ImportSettings(
            table=table or user_lut_directory(),
            scores=scores,
            replace=replace,
            source=source,
            licence=licence or _NO_LICENCE,
        )
        outcomes = _run(found, settings, jobs or os.cpu_count() or 1)
        if report is not None:
            _write_report(report, outcomes)
    except LutError as error:
        fail(error)
    _tell(outcomes, settings)
    if not any(outcome.result != "refused" for outcome in outcomes):
        raise typer.Exit(1)


def _run(found: list[ImportJob], settings: ImportSettings, jobs: int) -> list[ImportOutcome]:
    from teo_sign_authoring.signwriting.dictionary_import import run_import

    columns = (TextColumn("importing"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=_errors, transient=True, disable=not _errors.is_terminal) as progress:
        task = progress.add_task("", total=len(found))

        def done(_: ImportOutcome) -> None:
            progress.advance(task)

        return run_import(found, settings, jobs, done)


def _write_report(path: Path, outcomes: list[ImportOutcome]) -> None:
    from teo_common.atomic_files import write_atomically
    from teo_sign_authoring.signwriting.dictionary_import import report_lines

    if path.suffix == ".json":
        text = json.dumps([asdict(outcome) for outcome in outcomes], ensure_ascii=False, indent=1) + "\n"
    else:
        text = "\n".join(report_lines(outcomes)) + "\n"
    try:
        write_atomically(path, text.encode())
    except OSError as error:
        raise LutError("not_written", f"--report: expected a place to write to, got: {error}") from error


def _tell(outcomes: list[ImportOutcome], settings: ImportSettings) -> None:
    results = Counter(outcome.result for outcome in outcomes)
    reasons = Counter(outcome.code for outcome in outcomes if outcome.code)
    _output.print(
        f"{settings.table}: {results['whole']} compiled whole, {results['with_losses']} with losses, "
        f"{results['as_before']} as before, {results['refused']} refused of {len(outcomes)} entries",
        soft_wrap=True,
        markup=False,
    )
    for code, count in reasons.most_common():
        example = next(outcome for outcome in outcomes if outcome.code == code)
        line = f"  {count} {code}: {example.term}: {example.message}"
        _output.print(line, soft_wrap=True, markup=False)


def draw_main() -> None:
    """Run `draw_signwriting`."""
    app = typer.Typer(add_completion=False, pretty_exceptions_enable=False)
    app.command()(draw_signwriting)
    app()
