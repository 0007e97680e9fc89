# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Refusing to run without the Fast DDS profile that was asked for.

Fast DDS writes a line and goes on when the file that FASTRTPS_DEFAULT_PROFILES_FILE names is missing or
malformed, when a certificate cannot be read or a port is taken: a node that was to speak through TLS then
speaks plain UDP to everybody. So the ports that a participant opens are compared with what the file says.
"""

from __future__ import annotations

import os
import socket
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import NamedTuple

from teo_common.errors import CodedError

VARIABLE = "FASTRTPS_DEFAULT_PROFILES_FILE"
_TAG = "{http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles}"


class ProfileError(CodedError):
    """The profile that was asked for cannot be used, or is not."""


class Sockets(NamedTuple):
    """Ports of this process."""

    udp: frozenset[int]
    """Bound ones."""
    listening: frozenset[int]
    """TCP ports that take connections."""


class Profile(NamedTuple):
    """What the default participant of a file is to use."""

    path: Path
    udp: bool
    """Whether it is to speak UDP."""
    tcp_ports: frozenset[int] | None
    """Where it is to listen over TCP, 0 for any port; None: it is not to speak TCP."""

    def check(self, before: Sockets) -> None:
        """Compare with what the process has opened.

        Args:
            before: Sockets before the participant was made.

        Raises:
            ProfileError: `profile_not_in_force`: the participant speaks otherwise.
        """
        now = own_sockets()
        udp, listening = now.udp - before.udp, now.listening - before.listening
        told = (
            f"({VARIABLE}={self.path}): see what Fast DDS wrote; where TCP alone is wanted,"
            " ROS_AUTOMATIC_DISCOVERY_RANGE must not be LOCALHOST, which opens UDP ports"
        )
        if self.udp != bool(udp):
            expected = "UDP ports" if self.udp else "no UDP port"
            raise ProfileError(
                "profile_not_in_force", f"expected {expected}, got {sorted(udp) or 'none'} {told}"
            )
        if self.tcp_ports is not None and not (self.tcp_ports - {0} <= listening and listening):
            raise ProfileError(
                "profile_not_in_force",
                f"expected to listen at TCP port {sorted(self.tcp_ports)} (0: any),"
                f" got {sorted(listening) or 'none'} {told}",
            )


def requested_profile(rmw: str) -> Profile | None:
    """Read the profile that the environment names.

    Args:
        rmw: The middleware, as `rclpy.get_rmw_implementation_identifier` names it. Only rmw_fastrtps reads
            the variable.

    Returns:
        What the participant is to use; None where nothing is asked for.

    Raises:
        ProfileError: `profile_missing`, `profile_malformed`, `profile_without_default` or
            `profile_certificate`.
    """
    name = os.environ.get(VARIABLE)
    if not name or not rmw.startswith("rmw_fastrtps"):
        return None
    path = Path(name).resolve()
    try:
        return _read(path)
    except OSError as error:
        raise ProfileError(
            "profile_missing", f"expected a file of profiles, got {VARIABLE}={name}: {error.strerror}"
        ) from error
    except (ET.ParseError, ValueError) as error:
        raise ProfileError("profile_malformed", f"expected profiles in XML in {path}: {error}") from error


def own_sockets() -> Sockets:
    """The ports that this process holds."""
    udp, listening = set(), set()
    for handle in Path("/proc/self/fd").iterdir():
        try:
            if not str(handle.readlink()).startswith("socket:"):
                continue
            with socket.socket(fileno=os.dup(int(handle.name))) as copy:
                if copy.family not in (socket.AF_INET, socket.AF_INET6):
                    continue
                port = copy.getsockname()[1]
                if copy.type == socket.SOCK_DGRAM and port:
                    udp.add(port)
                elif copy.type == socket.SOCK_STREAM and copy.getsockopt(
                    socket.SOL_SOCKET, socket.SO_ACCEPTCONN
                ):
                    listening.add(port)
        except OSError:
            continue  # closed meanwhile
    return Sockets(frozenset(udp), frozenset(listening))


def _read(path: Path) -> Profile:
    root = ET.parse(path).getroot()
    participant = root.find(f".//{_TAG}participant[@is_default_profile='true']/{_TAG}rtps")
    if participant is None:
        raise ProfileError(
            "profile_without_default",
            f'expected a participant with is_default_profile="true" in {path}: nodes use no other',
        )
    named = {each.text for each in participant.iterfind(f"{_TAG}userTransports/{_TAG}transport_id")}
    used = {
        each.findtext(f"{_TAG}type"): each
        for each in root.iter(f"{_TAG}transport_descriptor")
        if each.findtext(f"{_TAG}transport_id") in named
    }
    builtin = (participant.findtext(f"{_TAG}useBuiltinTransports") or "true").strip() in ("true", "1")
    tcp = used.get("TCPv4", used.get("TCPv6"))
    ports = None
    if tcp is not None:
        _check_certificates(tcp)
        ports = frozenset(int(port.text or 0) for port in tcp.iterfind(f"{_TAG}listening_ports/{_TAG}port"))
    return Profile(path, builtin or not used.keys().isdisjoint(("UDPv4", "UDPv6")), ports)


def _check_certificates(transport: ET.Element) -> None:
    """Read the files of TLS as OpenSSL will."""
    tls = transport.find(f"{_TAG}tls")
    if tls is None:
        return
    import ssl  # 20 ms, where it is needed

    names = [tls.findtext(f"{_TAG}{name}") for name in ("cert_chain_file", "private_key_file", "verify_file")]
    certificate, key, authority = names
    try:
        context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
        if certificate:
            context.load_cert_chain(certificate, key, tls.findtext(f"{_TAG}password") or "")
        if authority:
            context.load_verify_locations(authority)
    except (OSError, ssl.SSLError) as error:
        raise ProfileError(
            "profile_certificate", f"expected certificate, its key and an authority in {names}: {error}"
        ) from error
