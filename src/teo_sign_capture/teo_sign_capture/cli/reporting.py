# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What `lut capture` and `lut recognise` say: to a person at a terminal, or to a program in lines of JSON.

A program finds an object a line: on standard error what is going on ({"event": "progress", "what", "done",
"total"} or {"event": "camera", "state"}), on standard output how each sign ended (`Outcome`).
"""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any, NoReturn, Self, TextIO

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn
from rich.table import Table

from teo_sign_capture.entries.gates import most_of
from teo_signs.errors import LutError

if TYPE_CHECKING:  # they take a second to load, which the other commands of `lut` need not wait for
    from teo_sign_capture.entries.bag_capture import Outcome

# By their breadth nearly all hands are in the person's zone; that of their middles tells them apart.
_SAID_BY_ANOTHER = ("same_zone_percent",)

_output = Console(highlight=False)
_errors = Console(stderr=True, highlight=False)


class TerminalReporter:
    """Bars, tables and sentences; a context in which progress is shown."""

    def __init__(self) -> None:
        """Show nothing yet."""
        self._progress = Progress(
            TextColumn("{task.description}", markup=False),
            BarColumn(),
            MofNCompleteColumn(),
            TimeRemainingColumn(),
            console=_errors,
            transient=True,
            disable=not _errors.is_terminal,
        )
        self._task = self._progress.add_task("starting", total=None)

    def __enter__(self) -> Self:
        """Show the progress from here on."""
        self._progress.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Take the bar away."""
        self._progress.stop()

    def progress(self, what: str, done: int, total: int) -> None:
        """Say what is done, and how much of it."""
        self._progress.update(self._task, description=what, completed=done, total=total)

    def camera(self, state: str) -> None:
        """Say what the webcam does."""
        _errors.print(state)

    def captured(self, outcome: Outcome) -> None:
        """Say what was captured, how well, and where it is."""
        _output.print(f"{outcome.gloss}: {outcome.message}", soft_wrap=True)
        table = Table(box=None, show_header=False)
        for name, figure in outcome.quality.items():
            if name in _SAID_BY_ANOTHER:
                continue
            words = name.split("_")
            unit = {"deg": "°", "percent": "%", "times": "times", "count": ""}.get(words[-1], words[-1])
            most = most_of(name)
            verdict = "" if most is None else f"{'good' if figure <= most else 'BAD'}: at most {most:g}"
            table.add_row(" ".join(words[:-1]), f"{figure:g}", unit, verdict)
        _output.print(table)
        for note in filter(None, (outcome.notes, *outcome.warnings)):
            _output.print(f"note: {note}", markup=False, soft_wrap=True)
        if outcome.standing == "sketched":
            _output.print(
                "standing sketched: the executor spells the word until its least_standing is sketched; "
                "see --standing",
                soft_wrap=True,
            )
        for path in outcome.files:
            _output.print(f"wrote {path}", markup=False, soft_wrap=True)

    def one_of_many(self, outcome: Outcome) -> None:
        """Say how one sign of a folder ended, unless it is listed at the end."""
        if outcome.quality:
            palm, place = (
                outcome.quality[name] for name in ("palm_error_p95_deg", "seen_place_error_p95_mm")
            )
            words = "; ".join((f"palm {palm:.0f} deg, place {place:.0f} mm", *outcome.warnings))
            self._progress.console.print(f"{outcome.gloss}: {words}", markup=False, soft_wrap=True)

    def end(self, outcomes: Sequence[Outcome], table: Path) -> None:
        """Say how the signs of a folder ended."""
        from teo_sign_capture.entries.bag_capture import CAPTURED, failures

        failed = failures(outcomes)
        captured = sum(outcome.code == CAPTURED for outcome in outcomes)
        if failed:
            rows = Table("gloss", "code", "reason", title="not captured")
            for outcome in failed:
                rows.add_row(outcome.gloss, outcome.code, outcome.message)
            _output.print(rows)
        _output.print(
            f"{captured} captured, {len(outcomes) - captured - len(failed)} as before, {len(failed)} failed, "
            f"in {table}",
            soft_wrap=True,
        )

    def failed(self, gloss: str | None, error: LutError) -> None:  # noqa: ARG002  # the sentence names it
        """Say why there is no sign."""
        _errors.print(f"{error.code}: {error}", markup=False, soft_wrap=True)


class JsonReporter:
    """Lines of JSON, each as soon as it is known."""

    def __enter__(self) -> Self:
        """Nothing is kept open."""
        return self

    def __exit__(self, *_: object) -> None:
        """Nothing is left to close."""

    def progress(self, what: str, done: int, total: int) -> None:
        """Say what is done, and how much of it."""
        write_json({"event": "progress", "what": what, "done": done, "total": total}, sys.stderr)

    def camera(self, state: str) -> None:
        """Say what the webcam does."""
        write_json({"event": "camera", "state": state}, sys.stderr)

    def captured(self, outcome: Outcome) -> None:
        """Say what was captured, how well, and where it is."""
        write_json(asdict(outcome), sys.stdout)

    def one_of_many(self, outcome: Outcome) -> None:
        """Say how one sign of a folder ended."""
        write_json(asdict(outcome), sys.stdout)

    def end(self, outcomes: Sequence[Outcome], table: Path) -> None:
        """Nothing is left to say."""

    def failed(self, gloss: str | None, error: LutError) -> None:
        """Say why there is no sign."""
        from teo_sign_capture.entries.bag_capture import failed_outcome

        write_json(asdict(failed_outcome(gloss, error)), sys.stdout)


Reporter = TerminalReporter | JsonReporter


def write_json(value: dict[str, Any], stream: TextIO) -> None:
    """Write an object as a line."""
    print(json.dumps(value, ensure_ascii=False), file=stream, flush=True)


def fail(error: LutError) -> NoReturn:
    """Say what is wrong and end."""
    _errors.print(f"{error.code}: {error}", markup=False, soft_wrap=True)
    raise typer.Exit(1) from error
