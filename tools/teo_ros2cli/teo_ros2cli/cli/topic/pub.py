# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`ros2 topic pub`: publishes a message, once, so many times, or until interrupted."""

from __future__ import annotations

import argparse
import sys
import time
from typing import Any

from teo_ros2cli.cli.options import (
    add_graph_arguments,
    add_qos_arguments,
    add_values_argument,
    given_values,
    non_negative_float,
    non_negative_int,
    positive_float,
)
from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.graph.cli_node import cli_node, executor_of
from teo_ros2cli.graph.discovery import full_topic_name, settle
from teo_ros2cli.interfaces import message_class
from teo_ros2cli.messages.fill import StampSetter, fill_from_text
from teo_ros2cli.qos import from_options

# Longest time that reliable subscriptions get to receive the last message [s]. A subscription that has been
# found may itself find this publisher later, with the next announcement, every 3 s with the defaults of Fast
# DDS. Only then it gets what was published already; the message is lost if the publisher leaves before.
_ACKNOWLEDGEMENT = 5.0
# Longest wait between two looks for a signal while acknowledgements are awaited [s].
_ACKNOWLEDGEMENT_STEP = 0.1
# Interval of looking for subscriptions [s].
_POLL = 0.02


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the verb's arguments."""
    add_graph_arguments(parser)
    parser.add_argument("topic_name", help="Name of the ROS topic to publish to (e.g. '/chatter')")
    parser.add_argument("message_type", help="Type of the ROS message (e.g. 'std_msgs/String')")
    add_values_argument(
        parser,
        "values",
        'Values to fill the message with in YAML format (e.g. "data: Hello World"), otherwise the message '
        "will be published with default values. `header: auto` and `stamp: now` stand for the time of "
        "publishing.",
    )
    group = parser.add_mutually_exclusive_group()
    group.add_argument(
        "-r",
        "--rate",
        metavar="N",
        type=positive_float,
        default=1.0,
        help="Publishing rate in Hz (default: 1)",
    )
    group.add_argument("-1", "--once", action="store_true", help="Publish one message and exit")
    parser.add_argument(
        "-t", "--times", type=non_negative_int, default=0, help="Publish this number of times and then exit"
    )
    parser.add_argument(
        "-p",
        "--print",
        dest="print_every",
        metavar="N",
        type=non_negative_int,
        default=1,
        help="Only print every N-th published message (default: 1)",
    )
    parser.add_argument(
        "-w",
        "--wait-matching-subscriptions",
        type=non_negative_int,
        help="Wait until finding the specified number of matching subscriptions. Defaults to 1 when using "
        '"-1"/"--once"/"--times", otherwise defaults to 0.',
    )
    parser.add_argument(
        "--max-wait-time-secs",
        type=positive_float,
        help="Give up waiting for matching subscriptions after this time in seconds (default: wait "
        "endlessly)",
    )
    parser.add_argument(
        "--keep-alive",
        metavar="N",
        type=non_negative_float,
        default=0.1,
        help="Keep publishing node alive for N seconds after the last msg (default: 0.1)",
    )
    parser.add_argument("-n", "--node-name", help="Name of the created publishing node")
    add_qos_arguments(parser, "publish", "default")


def run(options: argparse.Namespace) -> int:
    """Publish as the options say.

    Raises:
        Ros2CliError: `conflicting_options`, `invalid_type`, `invalid_yaml`, `invalid_field`, `invalid_topic`,
            `no_subscription`.
    """
    if options.once and options.times > 0:
        raise Ros2CliError("conflicting_options", "Cannot pass both -1/--once and -t/--times")
    times = 1 if options.once else options.times
    # All that can be wrong with the words is found before the graph is joined.
    message = message_class(options.message_type)()
    stamps = fill_from_text(message, given_values(options, "values"), automatic_stamps=True)

    with cli_node(options.node_name, use_sim_time=options.use_sim_time) as node:
        topic = full_topic_name(node, options.topic_name)
        profile = from_options(options)
        publisher = node.create_publisher(type(message), topic, profile)
        wanted = options.wait_matching_subscriptions
        if wanted is None:
            wanted = 1 if times else 0
        _wait_for_subscriptions(publisher, wanted, options.max_wait_time_secs)
        if wanted:
            # The first subscription that matched is rarely the only one.
            settle(node, options.spin_time, publishers=(publisher,))
        print("publisher: beginning loop")
        _publish(node, publisher, message, stamps, times, options)
        _linger(publisher, profile, options.keep_alive)
    return 0


def _wait_for_subscriptions(publisher: Any, wanted: int, longest: float | None) -> None:
    started = time.monotonic()
    told = started - 1.0
    while (found := publisher.get_subscription_count()) < wanted:
        now = time.monotonic()
        if longest is not None and now - started >= longest:
            raise Ros2CliError(
                "no_subscription",
                f"Timed out waiting for subscribers: Expected {wanted} subscribers but only got {found}.",
            )
        if now - told >= 1.0:
            print(f"Waiting for at least {wanted} matching subscription(s)...")
            told = now
        time.sleep(_POLL)


def _publish(
    node: Any,
    publisher: Any,
    message: Any,
    stamps: list[StampSetter],
    times: int,
    options: argparse.Namespace,
) -> None:
    from rclpy.executors import ExternalShutdownException

    count = 0

    def publish() -> None:
        nonlocal count
        count += 1
        for stamp in stamps:
            stamp(node.get_clock().now().to_msg())
        if options.print_every and count % options.print_every == 0:
            print(f"publishing #{count}: {message!r}\n")
        publisher.publish(message)

    publish()
    if times == 1:
        return
    timer = node.create_timer(1.0 / options.rate, publish)
    with executor_of(node) as executor:
        while times == 0 or count < times:
            executor.spin_once()
            if not node.context.ok():
                raise ExternalShutdownException  # SIGTERM
    node.destroy_timer(timer)


def _linger(publisher: Any, profile: Any, keep_alive: float) -> None:
    """Stay until reliable subscriptions have the last message, and the time that was asked for."""
    from rclpy.duration import Duration
    from rclpy.qos import ReliabilityPolicy

    started = time.monotonic()
    if profile.reliability != ReliabilityPolicy.BEST_EFFORT:
        while not publisher.wait_for_all_acked(Duration(seconds=_ACKNOWLEDGEMENT_STEP)):
            if time.monotonic() - started >= _ACKNOWLEDGEMENT:
                print(
                    f"Not every subscription acknowledged the last message within {_ACKNOWLEDGEMENT:g} s",
                    file=sys.stderr,
                )
                break
    time.sleep(max(0.0, keep_alive - (time.monotonic() - started)))
