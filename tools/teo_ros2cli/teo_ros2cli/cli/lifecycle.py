# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`ros2 lifecycle`: the states of managed nodes, and taking them from one to the next."""

from __future__ import annotations

import argparse
import sys
from typing import Any

from teo_ros2cli.bags.selection import is_hidden
from teo_ros2cli.cli.options import (
    add_graph_arguments,
    add_node_listing_arguments,
    full_name,
    known_graph,
    print_nodes,
)
from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.graph.cli_node import call
from teo_ros2cli.graph.discovery import node_names

# Time that a node gets to answer [s], as for parameters.
_TIMEOUT = 5.0
# Time that a transition gets [s]: a node loads a model or a table of signs in it.
_TRANSITION_TIMEOUT = 60.0
# Why hidden nodes need no option where one is named.
_NAMED = "Accepted; a node that is named is found, hidden or not"
# A node is managed if it serves this.
_GET_STATE = ("get_state", "lifecycle_msgs/srv/GetState")


add_nodes_arguments = add_node_listing_arguments


def run_nodes(options: argparse.Namespace) -> int:
    """Print the managed nodes of the graph."""
    with known_graph(options, names=True) as node:
        managed = _managed(node, hidden=options.all)
    print_nodes(options, managed)
    return 0


def add_get_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `get`."""
    add_graph_arguments(parser)
    parser.add_argument("node_name", nargs="?", help="Name of the ROS node (default: all)")
    parser.add_argument("--include-hidden-nodes", action="store_true", help="Consider hidden nodes as well")


def run_get(options: argparse.Namespace) -> int:
    """Print the state of one managed node, or of all.

    Raises:
        Ros2CliError: `node_unknown`, `service_unavailable`, `no_answer`.
    """
    with known_graph(options, names=True) as node:
        if options.node_name:
            print(_state(node, _known(node, options.node_name)))
            return 0
        for name in _managed(node, hidden=options.include_hidden_nodes):
            try:
                print(f"{name}: {_state(node, name)}")
            except Ros2CliError as error:
                print(f"{name}: {error}", file=sys.stderr)
    return 0


def add_list_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `list`."""
    add_graph_arguments(parser)
    parser.add_argument("node_name", help="Name of the ROS node")
    parser.add_argument(
        "-a", "--all", action="store_true", help="Show all existing transitions, also from other states"
    )
    parser.add_argument("--include-hidden-nodes", action="store_true", help=_NAMED)


def run_list(options: argparse.Namespace) -> int:
    """Print the transitions that a node can make now, or all that it knows.

    Raises:
        Ros2CliError: As of `run_get`.
    """
    with known_graph(options, names=True) as node:
        service = "get_transition_graph" if options.all else "get_available_transitions"
        found = _transitions(node, _known(node, options.node_name), service)
    for description in found:
        print(f"- {description.transition.label} [{description.transition.id}]")
        print(f"\tStart: {description.start_state.label}")
        print(f"\tGoal: {description.goal_state.label}")
    return 0


def add_set_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `set`."""
    add_graph_arguments(parser)
    parser.add_argument("node_name", help="Name of the ROS node")
    parser.add_argument("transition", help="The lifecycle transition, by name or number")
    parser.add_argument("--include-hidden-nodes", action="store_true", help=_NAMED)


def run_set(options: argparse.Namespace) -> int:
    """Let a node make a transition; exit status 1 unless it succeeds.

    Raises:
        Ros2CliError: `transition_unknown`, `transition_failed`, or as of `run_get`.
    """
    from lifecycle_msgs.msg import Transition

    with known_graph(options, names=True) as node:
        name = _known(node, options.node_name)
        available = [d.transition for d in _transitions(node, name, "get_available_transitions")]
        wanted = next((t for t in available if options.transition in (t.label, str(t.id))), None)
        if wanted is None:
            listed = "".join(f"\n- {t.label} [{t.id}]" for t in available)
            raise Ros2CliError(
                "transition_unknown", f"Unknown transition requested, available ones are:{listed}"
            )
        transition = Transition(id=wanted.id, label=wanted.label)
        answer = _call(
            node, name, "ChangeState", "change_state", timeout=_TRANSITION_TIMEOUT, transition=transition
        )
        if not answer.success:
            raise Ros2CliError("transition_failed", "Transitioning failed")
    print("Transitioning successful")
    return 0


def _managed(node: Any, *, hidden: bool) -> list[str]:
    service, kind = _GET_STATE
    served = {name for name, kinds in node.get_service_names_and_types() if kind in kinds}
    names = sorted(name for name in set(node_names(node)) if f"{name}/{service}" in served)
    return [name for name in names if hidden or not is_hidden(name)]


def _known(node: Any, name: str) -> str:
    full = full_name(name)
    if full not in node_names(node):
        raise Ros2CliError("node_unknown", "Node not found")
    if full not in _managed(node, hidden=True):
        raise Ros2CliError("node_unmanaged", f"Node '{full}' has no lifecycle")
    return full


def _state(node: Any, name: str) -> str:
    state = _call(node, name, "GetState", "get_state").current_state
    return f"{state.label} [{state.id}]"


def _transitions(node: Any, name: str, service: str) -> list[Any]:
    return list(_call(node, name, "GetAvailableTransitions", service).available_transitions)


def _call(node: Any, name: str, kind: str, service: str, *, timeout: float = _TIMEOUT, **request: Any) -> Any:
    """Call a managed node's service, such as `get_state`, of a type of lifecycle_msgs/srv."""
    from lifecycle_msgs import srv

    return call(node, getattr(srv, kind), f"{name}/{service}", timeout=timeout, **request)
