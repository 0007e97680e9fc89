# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Fast DDS profiles for several machines, made from the one that a single machine uses.

Announcements, heartbeats and shared memory stay as the profile says that one starts from; only how
participants reach those of other machines changes. Element names are those of `fastRTPS_profiles.xsd`, which
comes with Fast DDS 2.14.
"""

from __future__ import annotations

import copy
import ipaddress
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import NamedTuple

from teo_common.errors import CodedError

NAMESPACE = "http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles"
# The identity of discovery server 0, as `fastdds discovery -i 0` and ROS_DISCOVERY_SERVER have it.
_SERVER_ZERO = "44.53.00.5f.45.50.52.4f.53.49.4d.41"
# Participants of one machine that a peer can reach. Fast DDS has 4, one less than translator, executor,
# driver, console and a `ros2` command: the fifth would know nothing of other machines' fifth. Each costs one
# packet of 300 bytes an announcement.
_PARTICIPANTS_PER_MACHINE = 16


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

    def checked(self) -> Certificates:
        """The same with absolute paths.

        Raises:
            NetworkError: `no_certificate`: a file is missing; Fast DDS would say so in its log and go on.
        """
        for path in self:
            if not path.is_file():
                raise NetworkError("no_certificate", f"expected a PEM file, got {path}, which is not there")
        return Certificates(*(path.resolve() for path in self))


def peers_profile(base: Path) -> bytes:
    """A profile with which up to 16 participants of each machine find each other by ROS_STATIC_PEERS.

    Args:
        base: Profile to start from.

    Raises:
        NetworkError: `bad_base`: that is no profile.
    """
    root, _ = _read(base)
    for descriptor in root.iter(_tag("transport_descriptor")):
        if descriptor.findtext(_tag("type")) == "UDPv4":
            _add(descriptor, "maxInitialPeersRange", str(_PARTICIPANTS_PER_MACHINE))
    return _write(root)


def server_profile(base: Path, listen: Endpoint, certificates: Certificates | None) -> bytes:
    """The profile of a discovery server.

    Args:
        base: Profile to start from.
        listen: Where it listens.
        certificates: The server's: it takes TCP connections with TLS and nothing else. None: UDP.

    Raises:
        NetworkError: `bad_base` or `no_certificate`.
    """
    root, rtps = _read(base)
    if certificates is not None:
        transport = _encrypted_transport(root, certificates)
        _add(_add(transport, "listening_ports"), "port", str(listen.port))
    rtps.insert(0, prefix := ET.Element(_tag("prefix")))
    prefix.text = _SERVER_ZERO
    builtin = _discover(rtps, "SERVER")
    _add_locator(_add(builtin, "metatrafficUnicastLocatorList"), listen, tcp=certificates is not None)
    return _write(root)


def client_profile(base: Path, server: Endpoint, certificates: Certificates) -> bytes:
    """The profile of a node that finds the others by a discovery server, over TCP with TLS and nothing else.

    Args:
        base: Profile to start from.
        server: Where the server listens.
        certificates: This machine's: nodes of other machines connect to this one as well.

    Raises:
        NetworkError: `bad_base` or `no_certificate`.
    """
    root, rtps = _read(base)
    transport = _encrypted_transport(root, certificates)
    _add(_add(transport, "listening_ports"), "port", "0")  # any that is free: several nodes share the profile
    builtin = _discover(rtps, "SUPER_CLIENT")
    settings = builtin.find(_tag("discovery_config"))
    assert settings is not None
    remote = _add(_add(settings, "discoveryServersList"), "RemoteServer")
    remote.set("prefix", _SERVER_ZERO)
    _add_locator(_add(remote, "metatrafficUnicastLocatorList"), server, tcp=True)
    return _write(root)


def _read(base: Path) -> tuple[ET.Element, ET.Element]:
    """The root of a profile and `rtps` of its default participant."""
    try:
        root = copy.deepcopy(ET.parse(base).getroot())
    except (OSError, ET.ParseError) as error:
        raise NetworkError(
            "bad_base", f"expected a profile of Fast DDS to start from in {base}: {error}"
        ) from error
    rtps = root.find(f".//{_tag('participant')}[@is_default_profile='true']/{_tag('rtps')}")
    if rtps is None:
        raise NetworkError(
            "bad_base", f"expected a participant with is_default_profile in {base}, found none"
        )
    return root, rtps


def _encrypted_transport(root: ET.Element, certificates: Certificates) -> ET.Element:
    """Put TCP with TLS in the place of UDP."""
    files = certificates.checked()
    for descriptor in root.iter(_tag("transport_descriptor")):
        kind = descriptor.find(_tag("type"))
        if kind is None or kind.text != "UDPv4":
            continue
        kind.text = "TCPv4"
        tls = _add(descriptor, "tls")
        _add(tls, "private_key_file", str(files.key))
        _add(tls, "cert_chain_file", str(files.certificate))
        _add(tls, "verify_file", str(files.authority))
        verify = _add(tls, "verify_mode")
        for mode in ("VERIFY_PEER", "VERIFY_FAIL_IF_NO_PEER_CERT"):
            _add(verify, "verify", mode)
        options = _add(tls, "options")
        for option in ("NO_SSLV2", "NO_SSLV3", "NO_TLSV1", "NO_TLSV1_1", "NO_COMPRESSION"):
            _add(options, "option", option)
        return descriptor
    raise NetworkError("bad_base", "expected a UDPv4 transport in the profile to start from, found none")


def _discover(rtps: ET.Element, protocol: str) -> ET.Element:
    builtin = rtps.find(_tag("builtin"))
    settings = None if builtin is None else builtin.find(_tag("discovery_config"))
    if builtin is None or settings is None:
        raise NetworkError("bad_base", "expected builtin/discovery_config in the profile to start from")
    settings.insert(0, kind := ET.Element(_tag("discoveryProtocol")))
    kind.text = protocol
    return builtin


def _add_locator(parent: ET.Element, endpoint: Endpoint, *, tcp: bool) -> None:
    locator = _add(_add(parent, "locator"), "tcpv4" if tcp else "udpv4")
    _add(locator, "address", endpoint.address)
    _add(locator, "port", str(endpoint.port))
    if tcp:
        _add(locator, "physical_port", str(endpoint.port))


def _add(parent: ET.Element, name: str, text: str | None = None) -> ET.Element:
    child = ET.SubElement(parent, _tag(name))
    child.text = text
    return child


def _tag(name: str) -> str:
    return f"{{{NAMESPACE}}}{name}"


def _write(root: ET.Element) -> bytes:
    ET.register_namespace("", NAMESPACE)
    ET.indent(root)
    text: bytes = ET.tostring(root, encoding="UTF-8", xml_declaration=True)
    return text + b"\n"
