# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the commands share: running them, and tables and plots as files."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Annotated

import typer
from rich.console import Console

from teo_common.errors import CodedError

if TYPE_CHECKING:
    from matplotlib.axes import Axes


LanguageOption = Annotated[str, typer.Option("--language", help="Sign language, by its ISO 639-3 code.")]


def run_command(command: Callable[..., None]) -> None:
    """Run a command line; what it refuses is a sentence on standard error, and exit status 1."""
    try:
        typer.run(command)
    except (CodedError, OSError) as error:
        code = f"{error.code}: " if isinstance(error, CodedError) else ""
        Console(stderr=True, highlight=False).print(f"{code}{error}", markup=False, soft_wrap=True)
        raise SystemExit(1) from None


def csv_table(rows: Sequence[Sequence[str]]) -> str:
    """Rows, the head first, as CSV."""
    buffer = io.StringIO()
    csv.writer(buffer, lineterminator="\n").writerows(rows)
    return buffer.getvalue()


def markdown_table(rows: Sequence[Sequence[str]]) -> list[str]:
    """Rows, the head first, as lines of Markdown."""
    lines = ["| " + " | ".join(row) + " |" for row in rows]
    return [lines[0], "|" + " --- |" * len(rows[0]), *lines[1:]]


def plot_png(draw: Callable[[Axes], None], size: tuple[float, float]) -> bytes:
    """A plot as PNG.

    Args:
        draw: Draws it.
        size: Width and height [inch].
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg  # slow to import
    from matplotlib.figure import Figure

    figure = Figure(figsize=size, layout="constrained")
    FigureCanvasAgg(figure)
    draw(figure.subplots())
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", dpi=120)
    return buffer.getvalue()
