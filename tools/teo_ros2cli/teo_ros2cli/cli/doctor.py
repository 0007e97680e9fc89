# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`ros2 doctor`: what may be wrong with this machine's setup and with the graph."""

from __future__ import annotations

import argparse
import sys

from teo_ros2cli.cli.graph_view import known_graph, node_names
from teo_ros2cli.cli.options import add_graph_arguments


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    add_graph_arguments(parser)
    parser.add_argument("--report", "-r", action="store_true", help="Print all reports.")
    parser.add_argument(
        "--report-failed", "-rf", action="store_true", help="Print reports of failed checks only."
    )
    parser.add_argument(
        "--include-warnings", "-iw", action="store_true", help="Include warnings as failed checks."
    )


def run(options: argparse.Namespace) -> int:
    """Print the reports that are asked for, or without one how many checks passed and what is wrong."""
    from teo_ros2cli.graph import examination

    sections = [
        examination.examine_network(),
        examination.examine_platform(),
        examination.examine_middleware(),
    ]
    with known_graph(options, names=True) as node:
        sections += examination.examine_graph(node, node_names(node))
    failed = [
        section for section in sections if section.problems or (options.include_warnings and section.warnings)
    ]
    if options.report or options.report_failed:
        for section in sections if options.report else failed:
            print(f"\n   {section.title}")
            width = max((len(name) for name, _ in section.lines), default=0)
            for name, value in section.lines:
                print(f"{name.ljust(width)} : {value}")
        return 0
    for section in sections:
        for kind, sentences in (("ERROR", section.problems), ("WARNING", section.warnings)):
            for sentence in sentences:
                print(f"{section.name}: {kind}: {sentence}", file=sys.stderr)
    if failed:
        print(f"\n{len(failed)}/{len(sections)} check(s) failed\n")
        print("Failed modules:", *(section.name for section in failed))
    else:
        print(f"\nAll {len(sections)} checks passed\n")
    return 0
