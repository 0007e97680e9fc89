# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`ros2 action`: which actions there are, and sending goals."""

from __future__ import annotations

import argparse
import signal
import textwrap
from typing import Any

from teo_ros2cli.cli.options import (
    NamesAndTypes,
    add_graph_arguments,
    add_listing_arguments,
    add_values_argument,
    full_name,
    given_values,
    known_graph,
    print_names,
    print_types,
)
from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.graph.cli_node import cli_node, wait_for
from teo_ros2cli.interfaces import interface_class
from teo_ros2cli.messages.fill import fill_from_text
from teo_ros2cli.messages.tree import dump, message_tree

# Numbers of action_msgs/msg/GoalStatus.
_STATUS = {
    0: "UNKNOWN",
    1: "ACCEPTED",
    2: "EXECUTING",
    3: "CANCELING",
    4: "SUCCEEDED",
    5: "CANCELED",
    6: "ABORTED",
}
_SUCCEEDED = 4


def add_list_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `list`."""
    add_listing_arguments(parser, "action", hidden=False)


def run_list(options: argparse.Namespace) -> int:
    """Print the actions of the graph."""
    with known_graph(options) as node:
        return print_names(options, _actions(node))


def add_type_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `type`."""
    add_graph_arguments(parser)
    parser.add_argument("action_name", help="Name of the ROS action to get type (e.g. '/fibonacci')")


def run_type(options: argparse.Namespace) -> int:
    """Print the types of an action; exit status 1 if there is no such action."""
    with known_graph(options) as node:
        return print_types(lambda: _actions(node), options.action_name)


def _actions(node: Any) -> NamesAndTypes:
    from rclpy.action import get_action_names_and_types

    return list(get_action_names_and_types(node))


def add_info_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `info`."""
    add_graph_arguments(parser)
    parser.add_argument("action_name", help="Name of the ROS action to get info (e.g. '/fibonacci')")
    parser.add_argument("-t", "--show-types", action="store_true", help="Additionally show the action types")
    parser.add_argument(
        "-c", "--count", action="store_true", help="Only display the number of clients and servers"
    )


def run_info(options: argparse.Namespace) -> int:
    """Print who serves an action and who uses it."""
    from rclpy.action import (
        get_action_client_names_and_types_by_node,
        get_action_server_names_and_types_by_node,
    )

    action = full_name(options.action_name)
    print(f"Action: {action}")
    with known_graph(options, names=True) as node:
        own = node.get_name()
        nodes = {entry for entry in node.get_node_names_and_namespaces() if entry[0] != own}
        for noun, find in (
            ("clients", get_action_client_names_and_types_by_node),
            ("servers", get_action_server_names_and_types_by_node),
        ):
            found = [
                (f"{namespace.rstrip('/')}/{name}", types)
                for name, namespace in sorted(nodes)
                for entry, types in find(node, name, namespace)
                if entry == action
            ]
            print(f"Action {noun}: {len(found)}")
            if not options.count:
                for name, types in found:
                    print(f"    {name} [{', '.join(types)}]" if options.show_types else f"    {name}")
    return 0


def add_send_goal_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `send_goal`."""
    parser.add_argument("action_name", help="Name of the ROS action (e.g. '/fibonacci')")
    parser.add_argument(
        "action_type", help="Type of the ROS action (e.g. 'example_interfaces/action/Fibonacci')"
    )
    add_values_argument(parser, "goal", "Goal request values in YAML format (e.g. '{order: 10}')")
    parser.add_argument("-f", "--feedback", action="store_true", help="Echo feedback messages for the goal")


def run_send_goal(options: argparse.Namespace) -> int:
    """Send a goal and wait for its result; SIGINT cancels it. Exit status 1 unless it succeeds.

    Raises:
        Ros2CliError: `invalid_type`, `invalid_yaml`, `invalid_field`, `goal_rejected`.
    """
    cls = interface_class(options.action_type, "action")
    goal = cls.Goal()
    fill_from_text(goal, given_values(options, "goal"))

    from rclpy.action import ActionClient

    # SIGINT is to cancel the goal, which takes a context that lives on.
    with cli_node(own_signals=True) as node:
        client = ActionClient(node, cls, options.action_name)
        print("Waiting for an action server to become available...")
        client.wait_for_server()
        print(f"Sending goal:\n{_indented(goal)}")
        on_feedback = (
            (lambda message: print(f"Feedback:\n{_indented(message.feedback)}")) if options.feedback else None
        )
        handle = wait_for(node, client.send_goal_async(goal, feedback_callback=on_feedback))
        if not handle.accepted:
            raise Ros2CliError("goal_rejected", "Goal was rejected.")
        print(f"Goal accepted with ID: {bytes(handle.goal_id.uuid).hex()}\n")
        answer = _result(node, handle)
        client.destroy()
    print(f"Result:\n{_indented(answer.result)}")
    print(f"Goal finished with status: {_STATUS.get(answer.status, answer.status)}")
    return 0 if answer.status == _SUCCEEDED else 1


def _result(node: Any, handle: Any) -> Any:
    """Wait for a goal's result; an interruption cancels the goal, a second one ends the waiting."""
    future = handle.get_result_async()
    try:
        return wait_for(node, future)
    except KeyboardInterrupt:
        signal.signal(signal.SIGINT, signal.default_int_handler)
        print("Canceling goal...")
        wait_for(node, handle.cancel_goal_async())
        return wait_for(node, future)


def _indented(message: Any) -> str:
    return textwrap.indent(dump(message_tree(message)), "    ")
