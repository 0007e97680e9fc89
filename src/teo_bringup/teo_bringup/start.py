# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`start`: what signs, and the console if asked for, until it is told to end or one of them ends."""

from __future__ import annotations

import argparse
import signal
import sys
from collections.abc import Sequence
from pathlib import Path
from types import FrameType
from typing import NamedTuple, NoReturn

from ament_index_python.packages import get_package_share_directory

from teo_bringup.graph import Graph, GraphError


class _ToldToEndError(Exception):
    """A signal asked us to end."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.number = number


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the nodes that sign; exit with 0 when told to end, else with the status of the first that ended."""
    asked = parse(arguments)
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, _raise_told_to_end)
    try:
        status = _run(asked.for_nodes, view=asked.view)
    except GraphError as error:
        sys.exit(f"start: {error}")
    sys.exit(status)


class Asked(NamedTuple):
    """What the command line asks for."""

    for_nodes: list[str]
    """Arguments that every node gets."""
    view: bool
    """Whether the console is started too."""


def parse(arguments: Sequence[str] | None) -> Asked:
    """Read the command line.

    Args:
        arguments: Of the command line; None for the process's own.

    Raises:
        SystemExit: They are wrong; the parser has said how.
    """
    parser = _parser()
    given, ros_arguments = parser.parse_known_args(arguments)
    if ros_arguments and ros_arguments[0] != "--ros-args":
        parser.error(f"expected --ros-args before what the nodes get, got {' '.join(ros_arguments)}")
    for_nodes = ["--ros-args", "--params-file", str(given.params_file)]
    if given.namespace:
        for_nodes += ["-r", f"__ns:=/{given.namespace.strip('/')}"]
    if given.use_sim_time:
        for_nodes += ["-p", "use_sim_time:=true"]
    return Asked([*for_nodes, *ros_arguments], given.view)


def _run(arguments: Sequence[str], *, view: bool) -> int:
    with Graph() as graph:
        try:
            graph.start_nodes(arguments, view=view)
            name, status = graph.wait()
        except _ToldToEndError as told:
            graph.tell_to_end(signal.SIGTERM if told.number == signal.SIGHUP else told.number)
            return 0
        finally:
            # A second Ctrl-C must not keep us from stopping everything.
            for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
                signal.signal(number, signal.SIG_IGN)
        print(f"start: {name} ended with status {status}; stopping the others", file=sys.stderr, flush=True)
        return status if status >= 0 else 128 - status  # as a shell tells the death by a signal


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="start",
        description="Start translator, executor and driver, until Ctrl-C or until one ends.",
        epilog="Every node gets what follows --ros-args, as in --ros-args -p model:=lstm256.",
    )
    parser.add_argument(
        "--params-file",
        type=_existing_file,
        default=Path(get_package_share_directory("teo_bringup")) / "config" / "parameters.yaml",
        help="parameters of the nodes; those of teo_bringup if not given",
    )
    parser.add_argument(
        "--namespace", default="", help="before every topic, service and node: one for each robot"
    )
    parser.add_argument("--use-sim-time", action="store_true", help="take the time from the topic clock")
    parser.add_argument(
        "--view", action="store_true", help="start the console too, which says where its page is"
    )
    return parser


def _existing_file(text: str) -> Path:
    path = Path(text)
    if not path.is_file():
        raise argparse.ArgumentTypeError(f"expected a file of parameters, got {text}")
    return path


def _raise_told_to_end(number: int, _: FrameType | None) -> NoReturn:
    raise _ToldToEndError(number)
