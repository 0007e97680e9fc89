# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Types of arguments, and options that several commands share."""

from __future__ import annotations

import argparse
import math
import re
import sys
from typing import Any

from teo_ros2cli.errors import Ros2CliError

# As rclpy.qos names them; not taken from there, because loading rclpy takes longer than most commands.
QOS_PRESETS = (
    "unknown",
    "default",
    "system_default",
    "sensor_data",
    "services_default",
    "parameters",
    "parameter_events",
    "action_status_default",
    "best_available",
)
QOS_POLICIES = {
    "history": ("system_default", "keep_last", "keep_all", "unknown"),
    "reliability": ("system_default", "reliable", "best_effort", "unknown", "best_available"),
    "durability": ("system_default", "transient_local", "volatile", "unknown", "best_available"),
    "liveliness": ("system_default", "automatic", "manual_by_topic", "unknown", "best_available"),
}


def positive_float(text: str) -> float:
    """Read a finite number above 0."""
    value = _number(text)
    if value <= 0:
        raise argparse.ArgumentTypeError(f"value must be above 0, got {text}")
    return value


def non_negative_float(text: str) -> float:
    """Read a finite number of at least 0."""
    value = _number(text)
    if value < 0:
        raise argparse.ArgumentTypeError(f"value must not be below 0, got {text}")
    return value


def _number(text: str) -> float:
    try:
        value = float(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(f"value must be a number, got {text!r}") from error
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"value must be finite, got {text}")
    return value


def non_negative_int(text: str) -> int:
    """Read an integer of at least 0."""
    try:
        value = int(text)
    except ValueError:
        value = -1
    if value < 0:
        raise argparse.ArgumentTypeError(f"value must be non-negative integer, got {text!r}")
    return value


def positive_int(text: str) -> int:
    """Read an integer above 0."""
    value = non_negative_int(text)
    if value == 0:
        raise argparse.ArgumentTypeError("value must be above 0, got 0")
    return value


def add_values_argument(parser: argparse.ArgumentParser, name: str, help_text: str) -> None:
    """Add an argument for values in YAML, and `--stdin`; `given_values` reads them."""
    parser.add_argument(name, nargs="?", default="", help=help_text)
    parser.add_argument("--stdin", action="store_true", help="Read values from standard input")


def given_values(options: argparse.Namespace, name: str) -> str:
    """Return the values in YAML that were typed or come on the standard input; none are `{}`.

    Raises:
        Ros2CliError: `values_twice`.
    """
    typed = str(getattr(options, name))
    if options.stdin and typed:
        raise Ros2CliError("values_twice", f"Values come by --stdin or as `{name}`, not both: got {typed!r}")
    return (sys.stdin.read() if options.stdin else typed) or "{}"


def key_value(text: str) -> tuple[str, str]:
    """Read `key=value`."""
    key, separator, value = text.partition("=")
    if not separator or not key:
        raise argparse.ArgumentTypeError(f"expected KEY=VALUE, got {text!r}")
    return key, value


def assignment(text: str) -> tuple[str, str]:
    """Read `name:=value`."""
    name, separator, value = text.partition(":=")
    if not separator or not name:
        raise argparse.ArgumentTypeError(f"expected NAME:=VALUE, got {text!r}")
    return name, value


def full_name(topic: str) -> str:
    """Return a topic name with the slash that full names begin with."""
    return topic if topic.startswith("/") else f"/{topic}"


def pattern(text: str) -> re.Pattern[str] | None:
    """Return a regular expression, None for an empty text.

    Raises:
        Ros2CliError: `invalid_regex`.
    """
    if not text:
        return None
    try:
        return re.compile(text)
    except re.error as error:
        raise Ros2CliError("invalid_regex", f"{text!r} is not a regular expression: {error}") from error


def add_graph_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options on how the graph is looked at."""
    parser.add_argument(
        "--spin-time",
        type=non_negative_float,
        help="Spin time in seconds to wait for discovery (default: until all participants of this machine "
        "are known, and 0.5 s where other machines may take part)",
    )
    parser.add_argument("-s", "--use-sim-time", action="store_true", help="Enable ROS simulation time")
    parser.add_argument("--no-daemon", action="store_true", help="Accepted; there is no daemon")


class _QosAction(argparse.Action):
    """Stores an option and that some QoS option was given."""

    def __call__(
        self,
        _parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        _option: str | None = None,
    ) -> None:
        setattr(namespace, self.dest, values)
        namespace.qos_given = True


def add_qos_arguments(parser: argparse.ArgumentParser, doing: str, preset: str) -> None:
    """Add the `--qos-*` options.

    Args:
        parser: The parser of a command.
        doing: `publish` or `subscribe`.
        preset: The preset that holds unless another is chosen.
    """
    parser.set_defaults(qos_given=False)
    where = f"setting to {doing} with (overrides the value of --qos-profile)"
    parser.add_argument(
        "--qos-profile",
        choices=QOS_PRESETS,
        default=preset,
        action=_QosAction,
        help=f"Quality of service preset profile to {doing} with (default: {preset})",
    )
    parser.add_argument(
        "--qos-depth", metavar="N", type=non_negative_int, action=_QosAction, help=f"Queue size {where}"
    )
    for name, choices in QOS_POLICIES.items():
        parser.add_argument(
            f"--qos-{name}", choices=choices, action=_QosAction, help=f"Quality of service {name} {where}"
        )
    parser.add_argument(
        "--qos-liveliness-lease-duration-seconds",
        type=non_negative_float,
        action=_QosAction,
        help=f"Quality of service liveliness lease duration {where}",
    )
