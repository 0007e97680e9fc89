# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`ros2 topic echo`: prints the messages of a topic."""

from __future__ import annotations

import argparse
import builtins
import sys
import time
from collections.abc import Callable
from typing import Any

from teo_ros2cli.cli.options import (
    add_graph_arguments,
    add_qos_arguments,
    non_negative_int,
    positive_float,
)
from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.graph.cli_node import cli_node
from teo_ros2cli.graph.discovery import full_topic_name, look_again, only_type, settle
from teo_ros2cli.graph.subscribing import AdaptiveSubscription, listen
from teo_ros2cli.interfaces import message_class
from teo_ros2cli.messages.tree import Abridgement, dump, message_csv, message_tree, select
from teo_ros2cli.qos import asked_record

_DEFAULT_LENGTH = 128


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the verb's arguments."""
    add_graph_arguments(parser)
    parser.add_argument("topic_name", help="Name of the ROS topic to listen to (e.g. '/chatter')")
    parser.add_argument(
        "message_type", nargs="?", help="Type of the ROS message (e.g. 'std_msgs/msg/String')"
    )
    add_qos_arguments(parser, "subscribe", "sensor_data")
    parser.add_argument(
        "--field",
        help="Echo a selected field of a message. Use '.' to select sub-fields and '[i]' for one of a "
        "sequence, e.g. 'pose.position' or 'points[0].positions'",
    )
    add_printing_arguments(parser)
    parser.add_argument("--no-lost-messages", action="store_true", help="Don't report when a message is lost")
    parser.add_argument("--raw", action="store_true", help="Echo the raw binary representation")
    parser.add_argument(
        "--filter",
        dest="filter_expression",
        help="Python expression to filter messages that are printed. Expression can use Python builtins as "
        "well as m (the message).",
    )
    parser.add_argument("--once", action="store_true", help="Print the first message received and then exit.")
    parser.add_argument("--timeout", metavar="N", type=positive_float, help="Exit after this time in seconds")
    parser.add_argument(
        "--include-message-info", "-i", action="store_true", help="Shows the associated message info."
    )


def add_printing_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options on the form in which messages are printed, which `Printer` follows."""
    parser.add_argument(
        "--csv",
        action="store_true",
        help="Output all recursive fields separated by commas (e.g. for plotting). If --include-message-info "
        "is also passed, source_timestamp, received_timestamp, publication_sequence_number and "
        "reception_sequence_number are prepended.",
    )
    parser.add_argument(
        "--full-length",
        "-f",
        action="store_true",
        help="Output all elements for arrays, bytes, and string with a length > '--truncate-length', by "
        "default they are truncated after '--truncate-length' elements with '...''",
    )
    parser.add_argument(
        "--truncate-length",
        "-l",
        type=non_negative_int,
        default=_DEFAULT_LENGTH,
        help=f"The length to truncate arrays, bytes, and string to (default: {_DEFAULT_LENGTH})",
    )
    parser.add_argument("--no-arr", action="store_true", help="Don't print array fields of messages")
    parser.add_argument("--no-str", action="store_true", help="Don't print string fields of messages")
    parser.add_argument(
        "--flow-style", action="store_true", help="Print collections in the flow style (not with csv)"
    )


def run(options: argparse.Namespace) -> int:
    """Print messages until enough have come, the time is over, or the command is interrupted.

    Raises:
        Ros2CliError: `invalid_type`, `invalid_field`, `invalid_topic`, `invalid_filter`, `type_unknown`,
            `ambiguous_type`.
    """
    given = message_class(options.message_type) if options.message_type else None
    show = Printer(options)
    deadline = time.monotonic() + options.timeout if options.timeout is not None else None
    with cli_node(use_sim_time=options.use_sim_time) as node:
        topic = full_topic_name(node, options.topic_name)
        if given is None:
            settle(node, options.spin_time)
            name = look_again(lambda: only_type(node, topic, "echo"))
            if name is None:
                print(f"WARNING: topic [{options.topic_name}] does not appear to be published yet")
                raise Ros2CliError("type_unknown", "Could not determine the type for the passed topic")
            given = message_class(name)
        subscription = AdaptiveSubscription(
            node,
            topic,
            given,
            show,
            fixed=asked_record(options),
            raw=options.raw,
            warn=lambda sentence: print(sentence, file=sys.stderr),
            lost=None if options.no_lost_messages else show.tell_lost,
        )
        listen(node, [subscription], until=lambda: options.once and show.shown > 0, deadline=deadline)
    if options.once and not show.shown:
        print(f"No message came within {options.timeout} s", file=sys.stderr)
    return 0


class Printer:
    """Prints messages in the form that the options of `topic echo` ask for.

    Attributes:
        shown: Messages that were printed.
    """

    def __init__(self, options: argparse.Namespace) -> None:
        self._options = options
        self._abridgement = Abridgement(
            length=None if options.full_length else options.truncate_length,
            no_sequences=options.no_arr,
            no_strings=options.no_str,
        )
        self._passes = message_filter(options.filter_expression)
        self._lost = 0
        self.shown = 0

    def __call__(self, message: Any, info: dict[str, Any]) -> None:
        """Print a message, unless the options leave it out; `info` is rclpy's on it."""
        part = message
        if self._options.field is not None and not self._options.raw:
            part = select(message, self._options.field)
        if not self._passes(part) or (self._options.once and self.shown):
            return
        self.shown += 1
        if hasattr(part, "get_fields_and_field_types"):
            self._print_message(part, info)
        else:
            if self._options.include_message_info:
                print(f"---Got new message, message info:---\n{info}\n---Message data:---")
            print(part, end="\n---\n")

    def tell_lost(self, count: int) -> None:
        """Print that the middleware has lost messages."""
        self._lost += count
        print(
            f"A message was lost!!!\n\ttotal count change:{count}\n\ttotal count: {self._lost}", end="---\n"
        )

    def _print_message(self, message: Any, info: dict[str, Any]) -> None:
        if self._options.csv:
            line = message_csv(message, self._abridgement)
            if self._options.include_message_info:
                line = f"{','.join(map(str, info.values()))},{line}"
            print(line)
            return
        if self._options.include_message_info:
            print(dump(info), end="---\n")
        print(dump(self._tree(message), flow_style=self._options.flow_style), end="---\n")

    def _tree(self, message: Any) -> Any:
        return message_tree(message, self._abridgement)


def message_filter(expression: str | None) -> Callable[[Any], bool]:
    """Return a function that tells whether a message `m` makes a Python expression true; none lets all pass.

    Raises:
        Ros2CliError: `invalid_filter`; the function raises it as well, if the expression fails on a message.
    """
    if expression is None:
        return lambda _message: True
    try:
        code = compile(expression, "<filter>", "eval")
    except (SyntaxError, ValueError) as error:
        raise Ros2CliError(
            "invalid_filter", f"Filter {expression!r} is not a Python expression: {error}"
        ) from error

    def passes(message: Any) -> bool:
        try:
            return bool(eval(code, {"__builtins__": builtins}, {"m": message}))  # the user's own words
        except Exception as error:
            raise Ros2CliError(
                "invalid_filter", f"Filter {expression!r} fails: {type(error).__name__}: {error}"
            ) from error

    return passes
