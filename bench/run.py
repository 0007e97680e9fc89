"""Measure everything, one bench after the other, and print one table."""

from __future__ import annotations

import platform

import camera_path
import driver_rate
import letters
import lexicon
import lifting
import limbs
import planning
import retargeting
import retriever_accuracy
import retriever_node
import retriever_robustness
import robot_model
import text_to_trajectory
import translation
from rich.console import Console
from rich.table import Table

BENCHES = (
    robot_model,
    planning,
    lexicon,
    letters,
    lifting,
    driver_rate,
    translation,
    text_to_trajectory,
    limbs,
    retargeting,
    retriever_accuracy,
    retriever_node,
    retriever_robustness,
    camera_path,
)


def main() -> None:
    """Print the figures, each under the bench that made it."""
    console = Console()
    table = Table(
        "bench", "what", "measured", title=f"{platform.machine()}, Python {platform.python_version()}"
    )
    for bench in BENCHES:
        name = bench.__name__
        with console.status(f"bench/{name}.py"):
            figures = bench.measure()
        for figure in figures:
            table.add_row(name, figure.what, figure.value)
        table.add_section()
    console.print(table)


if __name__ == "__main__":
    main()
