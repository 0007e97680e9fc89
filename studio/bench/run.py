# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Measure everything, one bench after the other, and print a table of each."""

from __future__ import annotations

import platform

from rich.console import Console
from rich.progress import track
from rich.table import Table

import camera_path
import clips
import letters
import lexicon
import lifting
import planning
import recognition
import retargeting
import retriever_accuracy
import retriever_node
import retriever_robustness
import retriever_unseen
import spelling
import translation
import words
from accuracy import limbs
from command_line import interrupts, playing, publishing_once, recording
from nodes import (
    console_page,
    driver_executed,
    driver_physics,
    driver_rate,
    driver_robustness,
    kills,
    machines,
    stops,
    text_to_trajectory,
)
from signs import robot_model, robots

BENCHES = (
    robot_model,
    planning,
    lexicon,
    letters,
    robots,
    spelling,
    lifting,
    clips,
    driver_rate,
    driver_robustness,
    driver_executed,
    driver_physics,
    console_page,
    translation,
    words,
    text_to_trajectory,
    stops,
    kills,
    machines,
    limbs,
    retargeting,
    recognition,
    retriever_accuracy,
    retriever_node,
    retriever_robustness,
    retriever_unseen,
    camera_path,
    playing,
    recording,
    publishing_once,
    interrupts,
)


def main() -> None:
    """Print each bench's figures when it has them, and at the end which ones failed."""
    console = Console()
    console.print(f"{platform.machine()}, Python {platform.python_version()}")
    failed: list[str] = []
    for bench in track(BENCHES, "benches", console=console):
        name = bench.__name__.replace(".", "/")
        try:
            figures = bench.measure()
        except Exception:  # an hour of other figures must not be lost
            console.print_exception()
            failed.append(name)
            continue
        table = Table("what", "measured", title=f"bench/{name}.py", title_justify="left")
        for figure in figures:
            table.add_row(figure.what, figure.value)
        console.print(table)
    if failed:
        console.print(f"failed: {', '.join(failed)}")
        raise SystemExit(1)


if __name__ == "__main__":
    main()
