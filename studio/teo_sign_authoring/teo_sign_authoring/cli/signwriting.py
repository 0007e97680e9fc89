# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`lut import --signwriting` and `draw_signwriting`: signs from a dictionary, and as it draws them."""

from __future__ import annotations

import os
import sys
import time
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from teo_sign_authoring.cli.command import errors, fail, output, run_command
from teo_sign_capture.cli.reporting import JsonReporter, Reporter, TerminalReporter, write_json
from teo_signs.errors import LutError
from teo_signs.look_up_table import Lut, holding_tables, user_lut_directory

if TYPE_CHECKING:
    from teo_sign_authoring.signwriting.dictionary_import import ImportJob, ImportOutcome, ImportSettings


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
            errors.print(f'{code}: {gloss}: entry "{terms[gloss]}"', soft_wrap=True, markup=False)
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
    output.print(
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
            errors.print(f"{error.code}: {error}", soft_wrap=True, markup=False)
            continue
        if term is not None:
            terms[gloss] = term
    return terms


_NO_LICENCE = "not stated"


# [s] A report is written so often: what is refused meanwhile is tried again if the machine fails.
_REPORT_EVERY = 10.0


def import_signwriting(
    file: Path,
    *,
    language: str,
    table: Path | None,
    scores: Path | None,
    replace: bool,
    source: str,
    licence: str | None,
    only: list[str],
    any_term: bool,
    jobs: int | None,
    report: Path | None,
    as_json: bool,
) -> None:
    """Import a dictionary, with its progress, and say what became of it.

    Args:
        file: SPML, or term and FSW in a table of tab-separated values.
        language: Code of the language whose signs they are.
        table: Directory of the table; the user's own if None.
        scores: Directory for the scores as well.
        replace: Whether to make entries anew that are there and no better founded.
        source: What entries name as their source.
        licence: Terms of the dictionary; "not stated" if None.
        only: Glosses that are wanted; all if empty.
        any_term: Whether terms that are no known words are taken as typed.
        jobs: Processes; one for each core if None.
        report: File for what became of each entry; what it says of before is not tried again.
        as_json: Whether to tell a program: an object a line.
    """
    from teo_sign_authoring.signwriting.dictionary_file import GlossNames, read_dictionary
    from teo_sign_authoring.signwriting.dictionary_import import ImportSettings, find_jobs, known_outcomes

    reporter: Reporter = JsonReporter() if as_json else TerminalReporter()
    try:
        table = table or user_lut_directory(language)
        if table.is_dir():
            Lut.open(table, language=language)  # refuses one of another language before hours are spent
        found = find_jobs(read_dictionary(file), GlossNames(language=language, any_term=any_term), only)
        settings = ImportSettings(
            table=table,
            holding=holding_tables(table, language=language),
            language=language,
            scores=scores,
            replace=replace,
            source=source,
            licence=licence or _NO_LICENCE,
        )
        known = {} if report is None else known_outcomes(report, found, settings)
        with reporter:
            outcomes = _run(found, known, settings, jobs or os.cpu_count() or 1, report, reporter)
    except LutError as error:
        fail(error)
    _tell(outcomes, settings, as_json)
    if not any(outcome.result in ("whole", "with_losses", "as_before") for outcome in outcomes):
        raise typer.Exit(1)


def _run(
    found: list[ImportJob],
    known: dict[int, ImportOutcome],
    settings: ImportSettings,
    jobs: int,
    report: Path | None,
    reporter: Reporter,
) -> list[ImportOutcome]:
    """Import what is not known yet; the report has what was done, however it ends."""
    from teo_sign_authoring.signwriting.dictionary_import import run_import, write_report

    outcomes = dict(known)
    written = time.monotonic()

    def write() -> None:
        if report is not None:
            write_report(report, [outcomes[number] for number in sorted(outcomes)])

    def done(outcome: ImportOutcome) -> None:
        nonlocal written
        outcomes[outcome.number] = outcome
        reporter.progress("importing", len(outcomes), len(found))
        if time.monotonic() - written > _REPORT_EVERY:
            write()
            written = time.monotonic()

    try:
        run_import([job for job in found if job.entry.number not in known], settings, jobs, done)
    finally:
        write()
    return [outcomes[number] for number in sorted(outcomes)]


def _tell(outcomes: list[ImportOutcome], settings: ImportSettings, as_json: bool) -> None:
    results = Counter(outcome.result for outcome in outcomes)
    reasons = Counter((outcome.result, outcome.code) for outcome in outcomes if outcome.code)
    if as_json:
        counts = {name: results[name] for name in ("whole", "with_losses", "as_before")}
        refused, skipped = (
            {code: count for (result, code), count in reasons.most_common() if result == wanted}
            for wanted in ("refused", "skipped")
        )
        written = {"table": str(settings.table), "entries": len(outcomes), **counts}
        write_json({**written, "refused": refused, "skipped": skipped}, sys.stdout)
        return
    output.print(
        f"{settings.table}: of {len(outcomes)} entries {results['whole']} compiled whole, "
        f"{results['with_losses']} with losses, {results['as_before']} as before, "
        f"{results['refused']} refused, {results['skipped']} skipped",
        soft_wrap=True,
        markup=False,
    )
    for (result, code), count in reasons.most_common():
        example = next(outcome for outcome in outcomes if outcome.code == code)
        line = f"  {result}: {count} {code}: {example.term}: {example.message}"
        output.print(line, soft_wrap=True, markup=False)


def draw_main() -> None:
    """Run `draw_signwriting`."""
    run_command(draw_signwriting)
