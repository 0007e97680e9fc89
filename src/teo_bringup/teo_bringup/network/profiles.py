# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Fast DDS profiles for several machines: templates in `config/network/` with the machines' values put in."""

from __future__ import annotations

import ipaddress
from pathlib import Path
from string import Template
from typing import NamedTuple
from xml.sax.saxutils import escape

from ament_index_python.packages import get_package_share_directory

from teo_common.errors import CodedError


class NetworkError(CodedError):
    """What is asked of the network cannot be made."""


class Endpoint(NamedTuple):
    """Where a discovery server listens."""

    address: str
    """IPv4 address."""
    port: int
    """1 to 65535."""

    @classmethod
    def parse(cls, text: str) -> Endpoint:
        """Read ADDRESS:PORT.

        Raises:
            NetworkError: `bad_endpoint`: it is none.
        """
        address, _, port = text.rpartition(":")
        try:
            endpoint = cls(str(ipaddress.IPv4Address(address)), int(port))
        except ValueError:
            endpoint = cls(address, 0)
        if not 0 < endpoint.port < 2**16:
            raise NetworkError(
                "bad_endpoint", f"expected an IPv4 address and a port, such as 10.0.0.2:11811; got {text!r}"
            )
        return endpoint


class Certificates(NamedTuple):
    """Files of TLS, in PEM."""

    authority: Path
    """Certificate of who signs the machines' certificates."""
    certificate: Path
    """This machine's."""
    key: Path
    """This machine's secret key."""


def peers_profile() -> bytes:
    """A profile with which up to 16 participants of each machine find each other by ROS_STATIC_PEERS."""
    return _fill("peers.xml", {})


def server_profile(listen: Endpoint, certificates: Certificates | None) -> bytes:
    """The profile of a discovery server.

    Args:
        listen: Where it listens.
        certificates: The server's: it takes TCP connections with TLS and nothing else. None: UDP.

    Raises:
        NetworkError: `no_certificate`: a file is missing.
    """
    if certificates is None:
        return _fill("server.xml", listen._asdict())
    return _fill("server_tls.xml", listen._asdict() | _checked(certificates))


def client_profile(server: Endpoint, certificates: Certificates) -> bytes:
    """The profile of a node that finds the others by a discovery server, over TCP with TLS and nothing else.

    Args:
        server: Where the server listens.
        certificates: This machine's: nodes of other machines connect to this one as well.

    Raises:
        NetworkError: `no_certificate`: a file is missing.
    """
    return _fill("client_tls.xml", server._asdict() | _checked(certificates))


def _fill(template: str, values: dict[str, object]) -> bytes:
    path = Path(get_package_share_directory("teo_bringup")) / "config" / "network" / template
    escaped = {name: escape(str(value)) for name, value in values.items()}
    return Template(path.read_text(encoding="utf-8")).substitute(escaped).encode()


def _checked(certificates: Certificates) -> dict[str, object]:
    """Absolute paths by name; a missing file is refused here: Fast DDS would say so in its log and go on."""
    for path in certificates:
        if not path.is_file():
            raise NetworkError("no_certificate", f"expected a PEM file, got {path}, which is not there")
    return {name: path.resolve() for name, path in certificates._asdict().items()}
