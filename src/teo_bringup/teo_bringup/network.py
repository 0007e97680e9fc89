# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`network`: how this machine's nodes find those of other machines.

Each command prints the lines that a shell is to source, and writes the profile that they name: a template of
`config/network/` with the machines' values put in. `discovery_server` keeps a participant of such a profile.
"""

from __future__ import annotations

import ipaddress
import shlex
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated
from xml.sax.saxutils import escape

import typer

from teo_bringup.access import write_access_files, xml_template
from teo_common.atomic_files import write_atomically
from teo_common.dds_profiles import VARIABLE
from teo_common.errors import CodedError


class _NetworkError(CodedError):
    """What is asked of the network cannot be made."""


def _endpoint(text: str) -> dict[str, object]:
    """Address and port (1 to 65535) of ADDRESS:PORT, where a discovery server listens.

    Raises:
        _NetworkError: `bad_endpoint`: it is none.
    """
    address, _, digits = text.rpartition(":")
    try:
        ipaddress.IPv4Address(address)
        port = int(digits)
    except ValueError:
        port = 0
    if not 0 < port < 2**16:
        raise _NetworkError(
            "bad_endpoint", f"expected an IPv4 address and a port, such as 10.0.0.2:11811; got {text!r}"
        )
    return {"address": address, "port": port}


def _write(output: Path, template: str, values: dict[str, object]) -> None:
    escaped = {name: escape(str(value)) for name, value in values.items()}
    write_atomically(output, xml_template(template).substitute(escaped).encode())


_app = typer.Typer(
    add_completion=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    help="Make what nodes need to find those of other machines. Prints lines to source.",
)
# ROS 2's own variables, beside the profile: what the shell had before must not linger.
_FIND_BY_SERVER = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET", "ROS_STATIC_PEERS": ""}
# Domains whose ports are below Linux's ephemeral ones.
_HIGHEST_DOMAIN = 101

_Output = Annotated[Path, typer.Option(help="Profile to write (XML).", show_default=False)]
_EndpointText = Annotated[
    str, typer.Argument(metavar="ADDRESS:PORT", help="IPv4 address and port where the server listens.")
]
_Authority = Annotated[
    Path | None, typer.Option(help="PEM of who signs certificates; with it all goes over TLS.")
]
_Certificate = Annotated[Path | None, typer.Option(help="This machine's PEM.")]
_Key = Annotated[Path | None, typer.Option(help="This machine's secret key, PEM.")]


def main(arguments: Sequence[str] | None = None) -> None:
    """Do what the command line asks; exit with 1 and the reason where it cannot be done."""
    try:
        _app(arguments, prog_name="network")
    except _NetworkError as error:
        sys.exit(f"network: [{error.code}] {error}")
    except OSError as error:
        sys.exit(f"network: [not_written] expected to write a file: {error}")


@_app.command()
def peers(
    addresses: Annotated[
        list[str],
        typer.Argument(metavar="ADDRESS", help="IPv4 address of each machine, also this one's."),
    ],
    output: _Output,
) -> None:
    """Every machine knows the addresses of all; no multicast."""
    for address in addresses:
        try:
            ipaddress.IPv4Address(address)
        except ValueError as error:
            raise _NetworkError("bad_address", f"expected an IPv4 address, got {address!r}") from error
    _write(output, "peers.xml", {})
    _export(
        {
            # Of its own, a node looks on this machine alone, without multicast; the peers come on top.
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
            "ROS_STATIC_PEERS": ";".join(addresses),
            VARIABLE: str(output.resolve()),
        }
    )


@_app.command()
def server(
    endpoint: _EndpointText,
    output: _Output,
    authority: _Authority = None,
    certificate: _Certificate = None,
    key: _Key = None,
) -> None:
    """This machine runs `discovery_server`, which knows all nodes."""
    where = _endpoint(endpoint)
    files = _certificates(authority, certificate, key)
    _write(output, "server_tls.xml" if files else "server.xml", where | files)
    _export(_FIND_BY_SERVER | {VARIABLE: str(output.resolve())})


@_app.command()
def client(
    endpoint: _EndpointText,
    output: Annotated[Path | None, typer.Option(help="Profile to write (XML), with certificates.")] = None,
    authority: _Authority = None,
    certificate: _Certificate = None,
    key: _Key = None,
) -> None:
    """This machine's nodes ask a discovery server."""
    where = _endpoint(endpoint)
    files = _certificates(authority, certificate, key)
    if not files:  # what ROS 2 has is enough
        _export(
            _FIND_BY_SERVER
            | {
                "ROS_DISCOVERY_SERVER": f"{where['address']}:{where['port']}",
                "ROS_SUPER_CLIENT": "TRUE",  # nodes and `ros2` see the whole graph
            }
        )
        return
    if output is None:
        raise _NetworkError("no_output", "expected --output FILE with certificates: TLS needs a profile")
    _write(output, "client_tls.xml", where | files)
    _export(_FIND_BY_SERVER | {VARIABLE: str(output.resolve())})


@_app.command()
def access(
    output: Annotated[Path, typer.Option(help="Folder to write into.", show_default=False)],
    domain: Annotated[int, typer.Option(min=0, max=_HIGHEST_DOMAIN, help="ROS_DOMAIN_ID.")] = 0,
) -> None:
    """SROS2: governance and each node's permissions."""
    write_access_files(output, domain=domain)


def _certificates(authority: Path | None, certificate: Path | None, key: Path | None) -> dict[str, object]:
    """Absolute paths of the files of TLS by name; none without TLS.

    A missing file is refused here: Fast DDS would say so in its log and go on.
    """
    files = {"authority": authority, "certificate": certificate, "key": key}
    given = {name: path for name, path in files.items() if path is not None}
    if len(given) not in (0, len(files)):
        raise _NetworkError("no_certificate", "expected --authority, --certificate and --key together")
    for path in given.values():
        if not path.is_file():
            raise _NetworkError("no_certificate", f"expected a PEM file, got {path}, which is not there")
    return {name: path.resolve() for name, path in given.items()}


def _export(variables: dict[str, str]) -> None:
    for name, value in variables.items():
        print(f"export {name}={shlex.quote(value)}")


def run_discovery_server(arguments: Sequence[str] | None = None) -> None:
    """Run `discovery_server`; a profile that is not in force ends it with the reason.

    The wheels' `fast-discovery-server` does not start (a library is missing), so this takes its place.
    """
    from rclpy.node import Node  # here, as the next: `network` answers without ROS

    from teo_common.node_process import run_node

    run_node(lambda: Node("discovery_server"), arguments)
