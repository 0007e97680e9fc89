"""`ros2 service`: which services there are, and calling them."""

from __future__ import annotations

import argparse
import time
from collections.abc import Sequence
from typing import Any

from teo_ros2cli.bags.selection import is_hidden
from teo_ros2cli.cli.dispatch import Entry, choose
from teo_ros2cli.cli.options import add_graph_arguments, full_name, positive_float
from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.packages import InterfaceName

VERBS = {
    "call": Entry(__name__, "Call a service", "call"),
    "find": Entry(__name__, "Output a list of available services of a given type", "find"),
    "list": Entry(__name__, "Output a list of available services", "list"),
    "type": Entry(__name__, "Output a service's type", "type"),
}


def run_words(words: Sequence[str]) -> int:
    """Run the verb that the words name."""
    return choose("ros2 service", "Various service related sub-commands", "verb", VERBS, words)


def add_list_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `list`."""
    add_graph_arguments(parser)
    parser.add_argument("-t", "--show-types", action="store_true", help="Additionally show the service type")
    parser.add_argument(
        "-c", "--count-services", action="store_true", help="Only display the number of services"
    )
    parser.add_argument(
        "-a", "--include-hidden-services", action="store_true", help="Consider hidden services as well"
    )


def run_list(options: argparse.Namespace) -> int:
    """Print the services of the graph."""
    services = _services(options, options.include_hidden_services)
    if options.count_services:
        print(len(services))
        return 0
    for name, types in services:
        print(f"{name} [{', '.join(types)}]" if options.show_types else name)
    return 0


def add_type_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `type`."""
    add_graph_arguments(parser)
    parser.add_argument(
        "service_name", help="Name of the ROS service to get type (e.g. '/talker/list_parameters')"
    )


def run_type(options: argparse.Namespace) -> int:
    """Print the types of a service; exit status 1 if there is no such service."""
    types = dict(_services(options, True)).get(full_name(options.service_name), [])
    for kind in types:
        print(kind)
    return 0 if types else 1


def add_find_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `find`."""
    add_graph_arguments(parser)
    parser.add_argument("service_type", help="Name of the ROS service type to filter for")
    parser.add_argument(
        "-c", "--count-services", action="store_true", help="Only display the number of services"
    )
    parser.add_argument(
        "-a", "--include-hidden-services", action="store_true", help="Consider hidden services as well"
    )


def run_find(options: argparse.Namespace) -> int:
    """Print the services of a type."""
    wanted = str(InterfaceName.parse(options.service_type, "srv"))
    names = [name for name, types in _services(options, options.include_hidden_services) if wanted in types]
    if options.count_services:
        print(len(names))
        return 0
    for name in names:
        print(name)
    return 0


def add_call_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `call`."""
    parser.add_argument("service_name", help="Name of the ROS service to call to (e.g. '/add_two_ints')")
    parser.add_argument("service_type", help="Type of the ROS service (e.g. 'std_srvs/srv/Empty')")
    parser.add_argument(
        "values",
        nargs="?",
        default="{}",
        help='Values to fill the service request with in YAML format (e.g. "{a: 1, b: 2}"), otherwise the '
        "service request will be published with default values",
    )
    parser.add_argument(
        "-r", "--rate", metavar="N", type=positive_float, help="Repeat the call at a specific rate in Hz"
    )


def run_call(options: argparse.Namespace) -> int:
    """Call a service as soon as it is there, and print the response.

    Raises:
        Ros2CliError: `invalid_type`, `invalid_yaml`, `invalid_field`.
    """
    from teo_ros2cli.messages.classes import interface_class
    from teo_ros2cli.messages.fill import fill_message
    from teo_ros2cli.messages.yaml_text import parse

    cls = interface_class(options.service_type, "srv")
    request = cls.Request()
    values = parse(options.values)
    if not isinstance(values, dict):
        raise Ros2CliError("invalid_yaml", "The passed value needs to be a dictionary in YAML format")
    try:
        stamps = fill_message(request, values, automatic_stamps=True)
    except Ros2CliError as error:
        raise Ros2CliError(error.code, f"Failed to populate field: {error}") from error

    from teo_ros2cli.graph.calls import wait_for
    from teo_ros2cli.graph.cli_node import cli_node

    with cli_node() as node:
        client = node.create_client(cls, options.service_name)
        if not client.service_is_ready():
            print("waiting for service to become available...")
            client.wait_for_service()
        while True:
            for stamp in stamps:
                stamp(node.get_clock().now().to_msg())
            print(f"requester: making request: {request!r}\n")
            print(f"response:\n{wait_for(node, client.call_async(request))!r}\n")
            if options.rate is None:
                return 0
            time.sleep(1.0 / options.rate)


def _services(options: argparse.Namespace, hidden: bool) -> list[tuple[str, list[str]]]:
    from teo_ros2cli.graph.cli_node import cli_node, settle

    with cli_node(use_sim_time=options.use_sim_time) as node:
        settle(node, options.spin_time)
        own = _own_services(node)
        return [
            (name, list(types))
            for name, types in node.get_service_names_and_types()
            if name not in own and (hidden or not is_hidden(name))
        ]


def _own_services(node: Any) -> set[str]:
    return {
        name for name, _ in node.get_service_names_and_types_by_node(node.get_name(), node.get_namespace())
    }
