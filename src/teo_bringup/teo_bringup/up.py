# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`up`: nodes of the project on this machine, kept up until they are told to end."""

from __future__ import annotations

import argparse
import os
import signal
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from types import FrameType
from typing import NamedTuple, NoReturn

from ament_index_python.packages import get_package_share_directory

from teo_bringup.graph import NODES, SIGNING, Graph, GraphError
from teo_common.node_process import tell_supervisor


class _ToldToEndError(Exception):
    """A signal asked us to end."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.number = number


def main(arguments: Sequence[str] | None = None) -> None:
    """Run nodes; exit with 0 when told to end, else with the status of the first that ended for good."""
    asked = parse(arguments)
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, _raise_told_to_end)
    try:
        status = _run(asked)
    except GraphError as error:
        sys.exit(f"up: {error}")
    except OSError as error:  # of the log folder
        sys.exit(f"up: expected to write logs in {asked.log_folder}: {error.strerror}; choose a --log-folder")
    sys.exit(status)


class Asked(NamedTuple):
    """What the command line asks for."""

    nodes: list[str]
    """Names of nodes."""
    for_nodes: list[str]
    """Arguments that every node gets."""
    restarts: bool
    """Whether a node that fails is started again."""
    log_folder: Path
    """Where each node's output is kept."""


def parse(arguments: Sequence[str] | None) -> Asked:
    """Read the command line.

    Args:
        arguments: Of the command line; None for the process's own.

    Raises:
        SystemExit: They are wrong; the parser has said how.
    """
    ours = list(sys.argv[1:] if arguments is None else arguments)
    start = ours.index("--ros-args") if "--ros-args" in ours else len(ours)
    ours, ros_arguments = ours[:start], ours[start:]
    given = _parser().parse_args(ours)
    for_nodes = ["--ros-args", "--params-file", str(given.params_file)]
    if given.namespace:
        for_nodes += ["-r", f"__ns:=/{given.namespace.strip('/')}"]
    if given.robot:
        for_nodes += ["-p", f"robot:={given.robot}"]
    if given.language:
        for_nodes += ["-p", f"language:={given.language}"]
    if given.use_sim_time:
        for_nodes += ["-p", "use_sim_time:=true"]
    return Asked(
        nodes=list(dict.fromkeys(given.nodes or SIGNING)),
        for_nodes=[*for_nodes, *ros_arguments],
        restarts=given.restart == "on-failure",
        log_folder=given.log_folder or _log_folder(),
    )


def _run(asked: Asked) -> int:
    with Graph(asked.log_folder, printed=True) as graph:
        try:
            print(f"[up] each node's log is in {asked.log_folder}/", file=sys.stderr, flush=True)
            graph.start_nodes(asked.nodes, asked.for_nodes)
            name, status = graph.keep_up(restarts=asked.restarts, when_ready=_say_ready)
        except _ToldToEndError as told:
            graph.tell_to_end(signal.SIGTERM if told.number == signal.SIGHUP else told.number)
            return 0
        finally:
            # A second Ctrl-C must not keep us from stopping everything.
            for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
                signal.signal(number, signal.SIG_IGN)
        print(f"[up] {name} ended with status {status}; stopping the others", file=sys.stderr, flush=True)
        return status if status >= 0 else 128 - status  # as a shell tells the death by a signal


def _say_ready() -> None:
    print("[up] every node is ready", file=sys.stderr, flush=True)
    tell_supervisor("READY=1")  # systemd's, where it started us


def _log_folder() -> Path:
    """A folder for this run where ROS keeps logs: `ROS_LOG_DIR`, else log/ in `ROS_HOME`, else ~/.ros/log."""
    home = Path(os.environ.get("ROS_HOME") or Path.home() / ".ros")
    logs = Path(os.environ.get("ROS_LOG_DIR") or home / "log")
    return logs / f"teo_{time.strftime('%Y-%m-%d_%H-%M-%S')}_{os.getpid()}"


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="up",
        description="Start nodes and keep them up, until Ctrl-C or until one ends for good.",
        epilog="Every node gets what follows --ros-args, as in --ros-args -p model:=lstm256.",
    )
    parser.add_argument(
        "nodes",
        nargs="*",
        type=_known_node,
        metavar="NODE",
        help=f"of {', '.join(NODES)}; {', '.join(SIGNING)} if none is named",
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
    parser.add_argument(
        "--robot", default="", help="name of the robot; that of the parameter file if not given"
    )
    parser.add_argument(
        "--language",
        default="",
        help="sign language by its ISO 639-3 code; that of the parameter file if not given",
    )
    parser.add_argument("--use-sim-time", action="store_true", help="take the time from the topic clock")
    parser.add_argument(
        "--restart",
        choices=("on-failure", "no"),
        default="on-failure",
        help="whether a node that was ready and fails is started again, five times a minute at most",
    )
    parser.add_argument(
        "--log-folder",
        type=Path,
        help="where each node's log goes; a new one in ROS's log folder if not given",
    )
    return parser


def _known_node(text: str) -> str:
    if text not in NODES:
        raise argparse.ArgumentTypeError(
            f"expected some of {', '.join(NODES)}, and --ros-args before what the nodes get; got {text}"
        )
    return text


def _existing_file(text: str) -> Path:
    path = Path(text)
    if not path.is_file():
        raise argparse.ArgumentTypeError(f"expected a file of parameters, got {text}")
    return path


def _raise_told_to_end(number: int, _: FrameType | None) -> NoReturn:
    raise _ToldToEndError(number)
