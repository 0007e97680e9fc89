# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Measure everything, one bench after the other, and print a table of each; or one bench alone.

`run.py NAME` runs one of the modules beside it, `run.py NAME --help` says with which options.
"""

from __future__ import annotations

import argparse
import inspect
import platform
import sys
from importlib import import_module

from rich.console import Console
from rich.progress import track
from rich.table import Table

BENCHES = (
    "planning",
    "lexicon",
    "photographs",
    "letters",
    "signs.robots",
    "signs.durations",
    "spelling",
    "lifting",
    "clips",
    "nodes.driver_rate",
    "nodes.driver_robustness",
    "nodes.driver_executed",
    "nodes.driver_physics",
    "nodes.console_page",
    "nodes.first_hour",
    "translation",
    "words",
    "nodes.text_to_trajectory",
    "nodes.stops",
    "nodes.faults",
    "nodes.machines",
    "retargeting",
    "recognition",
    "retriever_accuracy",
    "retriever_node",
    "camera_path",
)


def measure_all() -> None:
    """Print each bench's figures when it has them, and at the end which ones failed."""
    console = Console()
    console.print(f"{platform.machine()}, Python {platform.python_version()}")
    failed: list[str] = []
    for bench in track(BENCHES, "benches", console=console):
        try:
            figures = list(import_module(bench).measure())
        except Exception:  # an hour of other figures must not be lost
            console.print_exception()
            failed.append(bench)
            continue
        table = Table("what", "measured", title=bench, title_justify="left")
        for figure in figures:
            table.add_row(figure.what, figure.value)
        console.print(table)
    if failed:
        console.print(f"failed: {', '.join(failed)}")
        raise SystemExit(1)


def measure_one(bench: str, arguments: list[str]) -> None:
    """Print a bench's figures; the parameters of its `measure` are its options."""
    module = import_module(bench)
    parser = argparse.ArgumentParser(prog=bench, description=module.__doc__)
    for name, parameter in inspect.signature(module.measure).parameters.items():
        default = parameter.default
        parser.add_argument(f"--{name}", type=type(default), default=default, help=f"default: {default}")
    for figure in module.measure(**vars(parser.parse_args(arguments))):
        print(f"{figure.what}: {figure.value}", flush=True)


if __name__ == "__main__":
    if sys.argv[1:]:
        measure_one(sys.argv[1], sys.argv[2:])
    else:
        measure_all()
