# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`ros2 topic info`: who publishes and subscribes."""

from __future__ import annotations

import argparse

from teo_ros2cli.cli.options import add_graph_arguments
from teo_ros2cli.errors import Ros2CliError


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the verb's arguments."""
    add_graph_arguments(parser)
    parser.add_argument("topic_name", help="Name of the ROS topic to get info (e.g. '/chatter')")
    parser.add_argument(
        "-v",
        "--verbose",
        action="store_true",
        help="Prints detailed information like the node name, node namespace, topic type, topic type hash, "
        "GUID, and QoS Profile of the publishers and subscribers to this topic",
    )


def run(options: argparse.Namespace) -> int:
    """Print a topic's type and its endpoints, this command's own ones left out.

    Raises:
        Ros2CliError: `topic_unknown` or `invalid_topic`.
    """
    from teo_ros2cli.graph.cli_node import cli_node, look_again, settle
    from teo_ros2cli.graph.topics import full_topic_name, topic_types

    with cli_node(use_sim_time=options.use_sim_time, rosout=False) as node:
        topic = full_topic_name(node, options.topic_name)
        settle(node, options.spin_time, names=True)
        types = look_again(lambda: topic_types(node, topic))
        own = node.get_name()
        publishers = [info for info in node.get_publishers_info_by_topic(topic) if info.node_name != own]
        subscriptions = [
            info for info in node.get_subscriptions_info_by_topic(topic) if info.node_name != own
        ]
    if not types:
        raise Ros2CliError("topic_unknown", f"Unknown topic '{options.topic_name}'")
    end = "\n\n" if options.verbose else "\n"
    print(f"Type: {types[0] if len(types) == 1 else types}", end=end)
    for noun, endpoints in (("Publisher", publishers), ("Subscription", subscriptions)):
        print(f"{noun} count: {len(endpoints)}", end=end)
        if options.verbose:
            for info in endpoints:
                print(info, end=end)
    return 0
