# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Starting the nodes of the project on this machine: `up`, which keeps them up, and the launch files."""

from __future__ import annotations

import os
import signal
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING, Annotated, Literal, NoReturn

import typer

from teo_bringup.graph import NODES, SIGNING, Graph, GraphError
from teo_common.installed_packages import package_path
from teo_common.node_process import tell_supervisor
from teo_common.parameters import ROBOT

if TYPE_CHECKING:
    from launch import LaunchDescription

# What is no option of ours is taken for a node, so that the refusal can name --ros-args.
_app = typer.Typer(add_completion=False, rich_markup_mode=None, pretty_exceptions_enable=False)
_SETTINGS = {"ignore_unknown_options": True}

_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)

# Arguments that `up` and the launch files have in common, and what they mean.
_MEANINGS = {
    "params_file": "Parameters of the nodes.",
    "namespace": "Before every topic, service and node: one for each robot.",
    "robot": "Name of the robot, whatever the parameter file says.",
    "language": "Sign language by its ISO 639-3 code, whatever the parameter file says.",
    "use_sim_time": "Take the time from the topic clock.",
}


class _ToldToEndError(Exception):
    """A signal asked us to end."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.number = number


def main(arguments: Sequence[str] | None = None) -> None:
    """Run nodes; exit with 0 when told to end, else with the status of the first that ended for good."""
    ours = list(sys.argv[1:] if arguments is None else arguments)
    start = ours.index("--ros-args") if "--ros-args" in ours else len(ours)
    _app(ours[:start], prog_name="up", obj=ours[start:])


def _known(nodes: list[str] | None) -> list[str]:
    """The nodes to start, each once; what signs where none is named."""
    for name in nodes or ():
        if name not in NODES:
            raise typer.BadParameter(
                f"expected some of {', '.join(NODES)}, and --ros-args before what the nodes get; got {name}"
            )
    return list(dict.fromkeys(nodes or SIGNING))


def _shipped_parameters() -> Path:
    return package_path("teo_bringup", "config/parameters.yaml")


def _log_folder() -> Path:
    """A folder for this run where ROS keeps logs: `ROS_LOG_DIR`, else log/ in `ROS_HOME`, else ~/.ros/log."""
    home = Path(os.environ.get("ROS_HOME") or Path.home() / ".ros")
    logs = Path(os.environ.get("ROS_LOG_DIR") or home / "log")
    return logs / f"teo_{time.strftime('%Y-%m-%d_%H-%M-%S')}_{os.getpid()}"


@_app.command(
    context_settings=_SETTINGS, epilog="Every node gets what follows --ros-args: --ros-args -p model:=lstm256"
)
def _up(
    context: typer.Context,
    nodes: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="NODE",
            callback=_known,
            help=f"Of {', '.join(NODES)}; {', '.join(SIGNING)} if none is named.",
        ),
    ] = None,
    params_file: Annotated[
        Path,
        typer.Option(exists=True, dir_okay=False, help=_MEANINGS["params_file"], show_default=False),
    ] = _shipped_parameters(),  # noqa: B008 - where the installed file is does not change
    namespace: Annotated[str, typer.Option(help=_MEANINGS["namespace"])] = "",
    robot: Annotated[str, typer.Option(help=_MEANINGS["robot"])] = "",
    language: Annotated[str, typer.Option(help=_MEANINGS["language"])] = "",
    use_sim_time: Annotated[bool, typer.Option("--use-sim-time", help=_MEANINGS["use_sim_time"])] = False,
    restart: Annotated[
        Literal["on-failure", "no"],
        typer.Option(help="When a node that was ready ends is started again, five times a minute at most."),
    ] = "on-failure",
    log_folder: Annotated[
        Path | None,
        typer.Option(help="Where each node's log goes; a new one in ROS's log folder if not given."),
    ] = None,
) -> None:
    """Start nodes and keep them up, until Ctrl-C or until one ends for good."""
    for_nodes = ["--ros-args", "--params-file", str(params_file)]
    if namespace:
        for_nodes += ["-r", f"__ns:=/{namespace.strip('/')}"]
    if robot:
        for_nodes += ["-p", f"robot:={robot}"]
    if language:
        for_nodes += ["-p", f"language:={language}"]
    if use_sim_time:
        for_nodes += ["-p", "use_sim_time:=true"]
    status = _run(
        nodes=nodes or [],
        for_nodes=[*for_nodes, *context.obj],
        restarts=restart == "on-failure",
        log_folder=log_folder or _log_folder(),
    )
    raise typer.Exit(status)


def _run(*, nodes: list[str], for_nodes: list[str], restarts: bool, log_folder: Path) -> int:
    """Run nodes until told to end (0) or one ends for good (its status)."""
    for number in _SIGNALS:
        signal.signal(number, _raise_told_to_end)
    try:
        with Graph(log_folder, printed=True) as graph:
            return _keep_up(graph, log_folder, nodes, for_nodes, restarts=restarts)
    except GraphError as error:
        sys.exit(f"up: {error}")
    except OSError as error:  # of the log folder
        sys.exit(f"up: expected to write logs in {log_folder}: {error.strerror}; choose a --log-folder")


def _keep_up(
    graph: Graph, log_folder: Path, nodes: list[str], for_nodes: list[str], *, restarts: bool
) -> int:
    try:
        print(f"[up] each node's log is in {log_folder}/", file=sys.stderr, flush=True)
        graph.start_nodes(nodes, for_nodes)
        name, status = graph.keep_up(restarts=restarts, when_ready=_say_ready)
    except _ToldToEndError as told:
        graph.tell_to_end(signal.SIGTERM if told.number == signal.SIGHUP else told.number)
        return 0
    finally:
        # A second Ctrl-C must not keep us from stopping everything.
        for number in _SIGNALS:
            signal.signal(number, signal.SIG_IGN)
    print(f"[up] {name} ended with status {status}; stopping the others", file=sys.stderr, flush=True)
    return status if status >= 0 else 128 - status  # as a shell tells the death by a signal


def _say_ready() -> None:
    print("[up] every node is ready", file=sys.stderr, flush=True)
    tell_supervisor("READY=1")  # systemd's, where it started us


def _raise_told_to_end(number: int, _: FrameType | None) -> NoReturn:
    raise _ToldToEndError(number)


def launch_description(*nodes: str) -> LaunchDescription:
    """Describe nodes that start together, all in one namespace, and end together.

    The arguments `params_file`, `namespace`, `robot`, `language` and `use_sim_time` are declared for
    `ros2 launch`.

    Args:
        nodes: Of `NODES`.
    """
    # Here, as this package is installed where there is no `launch` too: `up` does without it.
    from launch import LaunchDescription
    from launch.actions import DeclareLaunchArgument, Shutdown
    from launch.substitutions import LaunchConfiguration
    from launch_ros.actions import Node

    from teo_sign_languages import DEFAULT_LANGUAGE

    defaults = {
        "params_file": str(_shipped_parameters()),
        "namespace": "",
        "robot": str(ROBOT.default),
        "language": DEFAULT_LANGUAGE,
        "use_sim_time": "false",
    }
    declared = [
        DeclareLaunchArgument(name, default_value=default, description=_MEANINGS[name])
        for name, default in defaults.items()
    ]
    of_all_nodes = {name: LaunchConfiguration(name) for name in ("robot", "language", "use_sim_time")}
    started = [
        Node(
            package=package,
            executable=executable,
            namespace=LaunchConfiguration("namespace"),
            parameters=[LaunchConfiguration("params_file"), of_all_nodes],
            output="screen",
            on_exit=Shutdown(reason=f"{executable} ended"),
        )
        for package, executable in (NODES[name] for name in nodes)
    ]
    return LaunchDescription([*declared, *started])
