# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`network`: how this machine's nodes find those of other machines.

Each command prints the lines that a shell is to source, and writes the profile that they name.
"""

from __future__ import annotations

import argparse
import ipaddress
import os
import shlex
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

from teo_bringup.network.access import write_access_files
from teo_bringup.network.profiles import (
    Certificates,
    Endpoint,
    NetworkError,
    client_profile,
    peers_profile,
    server_profile,
)
from teo_common.atomic_files import write_atomically
from teo_common.dds_profiles import VARIABLE

# ROS 2's own variables, beside the profile: what the shell had before must not linger.
_FIND_BY_SERVER = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET", "ROS_STATIC_PEERS": ""}


def main(arguments: Sequence[str] | None = None) -> None:
    """Do what the command line asks; exit with 1 and the reason where it cannot be done."""
    options = _parser().parse_args(arguments)
    do: Callable[[argparse.Namespace], dict[str, str]] = options.do
    try:
        variables = do(options)
    except NetworkError as error:
        sys.exit(f"network: [{error.code}] {error}")
    except OSError as error:
        sys.exit(f"network: [not_written] expected to write a file: {error}")
    for name, value in variables.items():
        print(f"export {name}={shlex.quote(value)}")


def _peers(options: argparse.Namespace) -> dict[str, str]:
    for address in options.addresses:
        try:
            ipaddress.IPv4Address(address)
        except ValueError as error:
            raise NetworkError("bad_address", f"expected an IPv4 address, got {address!r}") from error
    write_atomically(options.output, peers_profile(_base()))
    return {
        # Of its own, a node looks on this machine alone, without multicast; the peers come on top.
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "ROS_STATIC_PEERS": ";".join(options.addresses),
        VARIABLE: str(options.output.resolve()),
    }


def _server(options: argparse.Namespace) -> dict[str, str]:
    listen = Endpoint.parse(options.endpoint)
    write_atomically(options.output, server_profile(_base(), listen, _certificates(options)))
    return _FIND_BY_SERVER | {VARIABLE: str(options.output.resolve())}


def _client(options: argparse.Namespace) -> dict[str, str]:
    server = Endpoint.parse(options.endpoint)
    certificates = _certificates(options)
    if certificates is None:  # what ROS 2 has is enough
        return _FIND_BY_SERVER | {
            "ROS_DISCOVERY_SERVER": f"{server.address}:{server.port}",
            "ROS_SUPER_CLIENT": "TRUE",  # nodes and `ros2` see the whole graph
        }
    if options.output is None:
        raise NetworkError("no_output", "expected --output FILE with certificates: TLS needs a profile")
    write_atomically(options.output, client_profile(_base(), server, certificates))
    return _FIND_BY_SERVER | {VARIABLE: str(options.output.resolve())}


def _access(options: argparse.Namespace) -> dict[str, str]:
    write_access_files(options.output, domain=options.domain)
    return {}


def _base() -> Path:
    name = os.environ.get(VARIABLE)
    if not name:
        raise NetworkError(
            "no_base", f"expected {VARIABLE} to name the profile to start from; source env.sh first"
        )
    return Path(name)


def _certificates(options: argparse.Namespace) -> Certificates | None:
    files = (options.authority, options.certificate, options.key)
    if files == (None, None, None):
        return None
    if None in files:
        raise NetworkError("no_certificate", "expected --authority, --certificate and --key together")
    return Certificates(*files)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="network",
        description="Make what nodes need to find those of other machines. Prints lines to source.",
    )
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    peers = commands.add_parser("peers", help="every machine knows the addresses of all; no multicast")
    peers.add_argument(
        "addresses", nargs="+", metavar="ADDRESS", help="IPv4 address of each machine, also this one's"
    )
    peers.add_argument("--output", type=Path, required=True, help="profile to write (XML)")
    peers.set_defaults(do=_peers)
    for name, do, told in (
        ("server", _server, "this machine runs `discovery_server`, which knows all nodes"),
        ("client", _client, "this machine's nodes ask a discovery server"),
    ):
        command = commands.add_parser(name, help=told)
        command.add_argument(
            "endpoint", metavar="ADDRESS:PORT", help="IPv4 address and port where the server listens"
        )
        command.add_argument("--output", type=Path, required=do is _server, help="profile to write (XML)")
        command.add_argument(
            "--authority", type=Path, help="PEM of who signs certificates; with it all goes over TLS"
        )
        command.add_argument("--certificate", type=Path, help="this machine's PEM")
        command.add_argument("--key", type=Path, help="this machine's secret key, PEM")
        command.set_defaults(do=do)
    access = commands.add_parser("access", help="SROS2: governance and each node's permissions")
    access.add_argument("--output", type=Path, required=True, help="folder to write into")
    access.add_argument(
        "--domain", type=int, default=0, choices=range(102), metavar="0-101", help="ROS_DOMAIN_ID"
    )
    access.set_defaults(do=_access)
    return parser
