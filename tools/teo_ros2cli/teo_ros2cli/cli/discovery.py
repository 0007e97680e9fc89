# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`ros2 multicast` and `ros2 daemon`: how participants find each other."""

from __future__ import annotations

import argparse
import contextlib
import socket
import struct
from collections.abc import Iterator

from teo_ros2cli.cli.options import non_negative_int, positive_float, positive_int
from teo_ros2cli.errors import Ros2CliError

# The genuine command's, so that the two find each other.
_GROUP, _PORT = "225.0.0.1", 49150
_TEXT = b"Hello World!"
_LONGEST = 4096


def _add_common(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--group", default=_GROUP, help=f"IPv4 multicast group for multicast messages (default: {_GROUP})"
    )
    parser.add_argument(
        "--port", type=positive_int, default=_PORT, help=f"Port for multicast messages (default: {_PORT})"
    )


def add_send_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `send`."""
    _add_common(parser)
    parser.add_argument(
        "--ttl",
        type=non_negative_int,
        help="The multicast TTL of the datagram: routers that it may pass (default: the system's, 1)",
    )


def run_send(options: argparse.Namespace) -> int:
    """Send a datagram.

    Raises:
        Ros2CliError: `multicast_failed`.
    """
    with _socket(options) as sender:
        if options.ttl is not None:
            sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, options.ttl)
        print("Sending one UDP multicast datagram...")
        sender.sendto(_TEXT, (options.group, options.port))
    return 0


def add_receive_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `receive`."""
    _add_common(parser)
    parser.add_argument(
        "--timeout",
        type=positive_float,
        help="Timeout in seconds to wait for a datagram (default: endlessly)",
    )


def run_receive(options: argparse.Namespace) -> int:
    """Wait for a datagram and print it; exit status 1 if none came in time.

    Raises:
        Ros2CliError: `multicast_failed`.
    """
    with _socket(options) as receiver:
        receiver.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        receiver.bind(("", options.port))
        membership = struct.pack("4sl", socket.inet_aton(options.group), socket.INADDR_ANY)
        receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, membership)
        receiver.settimeout(options.timeout)
        print("Waiting for UDP multicast datagram...")
        try:
            data, (host, port) = receiver.recvfrom(_LONGEST)
        except TimeoutError:
            raise Ros2CliError("multicast_failed", "Timed out waiting for UDP multicast datagram") from None
    print(f"Received from {host}:{port}: {data.decode(errors='replace')!r}")
    return 0


@contextlib.contextmanager
def _socket(options: argparse.Namespace) -> Iterator[socket.socket]:
    try:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM, socket.IPPROTO_UDP) as opened:
            yield opened
    except OSError as error:
        where = f"{options.group}:{options.port}"
        raise Ros2CliError("multicast_failed", f"Multicast to {where} is not possible: {error}") from error


def run_daemon_start(_options: argparse.Namespace) -> int:
    """Say that there is nothing to start."""
    print("There is no daemon to start: every command discovers the graph itself")
    return 0


def run_daemon_status(_options: argparse.Namespace) -> int:
    """Say that no daemon runs."""
    print("The daemon is not running")
    return 0
