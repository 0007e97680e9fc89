# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`ros2 service`: which services there are, and calling them."""

from __future__ import annotations

import argparse
import sys
import time
from typing import Any

from teo_ros2cli.bags.selection import is_hidden
from teo_ros2cli.cli.options import (
    NamesAndTypes,
    add_graph_arguments,
    add_listing_arguments,
    add_qos_arguments,
    add_values_argument,
    full_name,
    given_values,
    known_graph,
    positive_float,
    print_names,
    print_types,
)
from teo_ros2cli.cli.topic.echo import Printer, add_printing_arguments
from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.graph.cli_node import cli_node, wait_for
from teo_ros2cli.graph.discovery import look_again
from teo_ros2cli.graph.subscribing import AdaptiveSubscription, listen
from teo_ros2cli.interfaces import InterfaceName, interface_class
from teo_ros2cli.messages.fill import fill_from_text
from teo_ros2cli.qos import asked_record


def add_list_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `list`."""
    add_listing_arguments(parser, "service")


def run_list(options: argparse.Namespace) -> int:
    """Print the services of the graph."""
    return print_names(options, _services(options, options.include_hidden))


def add_type_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `type`."""
    add_graph_arguments(parser)
    parser.add_argument(
        "service_name", help="Name of the ROS service to get type (e.g. '/talker/list_parameters')"
    )


def run_type(options: argparse.Namespace) -> int:
    """Print the types of a service; exit status 1 if there is no such service."""
    with known_graph(options) as node:
        return print_types(lambda: _served(node), options.service_name)


def add_find_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `find`."""
    add_listing_arguments(parser, "service", types=False)
    parser.add_argument("service_type", help="Name of the ROS service type to filter for")


def run_find(options: argparse.Namespace) -> int:
    """Print the services of a type."""
    wanted = str(InterfaceName.parse(options.service_type, "srv"))
    services = _services(options, options.include_hidden)
    return print_names(options, [entry for entry in services if wanted in entry[1]])


def add_info_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `info`."""
    add_graph_arguments(parser)
    parser.add_argument(
        "service_name", help="Name of the ROS service to get info (e.g. '/talker/list_parameters')"
    )


def run_info(options: argparse.Namespace) -> int:
    """Print a service's type, and how many nodes call and serve it.

    Raises:
        Ros2CliError: `service_unknown`.
    """
    service = full_name(options.service_name)
    with known_graph(options) as node:
        types = look_again(lambda: _types(node, service))
        if not types:
            raise Ros2CliError("service_unknown", f"Unknown service '{options.service_name}'")
        print(f"Type: {', '.join(types)}")
        print(f"Clients count: {node.count_clients(service)}")
        print(f"Services count: {node.count_services(service)}")
    return 0


def add_call_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `call`."""
    parser.add_argument("service_name", help="Name of the ROS service to call to (e.g. '/add_two_ints')")
    parser.add_argument("service_type", help="Type of the ROS service (e.g. 'std_srvs/srv/Empty')")
    add_values_argument(
        parser,
        "values",
        'Values to fill the service request with in YAML format (e.g. "{a: 1, b: 2}"), otherwise the '
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
    cls = interface_class(options.service_type, "srv")
    request = cls.Request()
    stamps = fill_from_text(request, given_values(options, "values"), automatic_stamps=True)

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


def add_echo_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `echo`."""
    add_graph_arguments(parser)
    parser.add_argument("service_name", help="Name of the ROS service to echo from (e.g. '/add_two_ints')")
    parser.add_argument("service_type", nargs="?", help="Type of the ROS service (e.g. 'std_srvs/srv/Empty')")
    add_qos_arguments(parser, "subscribe", "services_default")
    add_printing_arguments(parser)
    parser.set_defaults(field=None, raw=False, filter_expression=None, once=False, include_message_info=False)


def run_echo(options: argparse.Namespace) -> int:
    """Print the requests and responses of a service whose node has introspection switched on.

    Raises:
        Ros2CliError: `service_unknown`, `invalid_type`.
    """
    service = full_name(options.service_name)
    events = f"{service}/_service_event"
    with known_graph(options) as node:
        types = [options.service_type] if options.service_type else look_again(lambda: _types(node, service))
        if not types:
            raise Ros2CliError("service_unknown", f"Unknown service '{options.service_name}'")
        if not node.count_publishers(events):
            print(f"'{service}' tells of no calls: its node has to switch introspection on", file=sys.stderr)
        subscription = AdaptiveSubscription(
            node,
            events,
            interface_class(types[0], "srv").Event,
            _EventPrinter(options),
            fixed=asked_record(options),
            warn=lambda sentence: print(sentence, file=sys.stderr),
        )
        listen(node, [subscription])
    return 0


# By the numbers of service_msgs/msg/ServiceEventInfo.
_EVENTS = ("REQUEST_SENT", "REQUEST_RECEIVED", "RESPONSE_SENT", "RESPONSE_RECEIVED")


class _EventPrinter(Printer):
    def _tree(self, message: Any) -> Any:
        tree = super()._tree(message)
        tree["info"]["event_type"] = _EVENTS[message.info.event_type]
        return tree


def _types(node: Any, service: str) -> list[str]:
    return list(dict(node.get_service_names_and_types()).get(service, ()))


def _services(options: argparse.Namespace, hidden: bool) -> NamesAndTypes:
    with known_graph(options) as node:
        return [(name, types) for name, types in _served(node) if hidden or not is_hidden(name)]


def _served(node: Any) -> NamesAndTypes:
    """The services of the graph, the command's own left out."""
    own = dict(node.get_service_names_and_types_by_node(node.get_name(), node.get_namespace()))
    return [(name, types) for name, types in node.get_service_names_and_types() if name not in own]
