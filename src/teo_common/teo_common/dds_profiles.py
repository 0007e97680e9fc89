# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Refusing to run without the Fast DDS profiles that were asked for.

Fast DDS writes a line and goes on when the file that FASTRTPS_DEFAULT_PROFILES_FILE names is missing or
malformed, when a certificate cannot be read or a port is taken: a node that was to speak through TLS then
speaks plain UDP to everybody.
"""

from __future__ import annotations

import ctypes
import os
import socket
import xml.etree.ElementTree as ET
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from teo_common.errors import CodedError

VARIABLE = "FASTRTPS_DEFAULT_PROFILES_FILE"
_TAG = "{http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles}"
# `XMLProfileManager::loadXMLFile(const std::string&)` of Fast DDS 2. It keeps what it has loaded, so the
# participant gets what was judged.
_LOAD = (
    "_ZN8eprosima8fastrtps9xmlparser17XMLProfileManager11loadXMLFile"
    "ERKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEE"
)
_XML_OK = 1  # of its `enum class XMLP_ret`


class ProfileError(CodedError):
    """The profiles that were asked for cannot be used, or are not."""


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

    def check(self, before: Sockets, now: Sockets) -> None:
        """Compare with what the process has opened since.

        Args:
            before: Sockets before the participant was made.
            now: Sockets now.

        Raises:
            ProfileError: `profile_not_in_force`: the participant speaks otherwise.
        """
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


def require_profile(rmw: str) -> Profile | None:
    """Have Fast DDS load the profiles that the environment names, before there is a participant.

    Args:
        rmw: The middleware, as `rclpy.get_rmw_implementation_identifier` names it. Others than rmw_fastrtps
        do not
            read the variable.

    Returns:
        What the participant is to use; None where nothing is asked for.

    Raises:
        ProfileError: `profile_missing`, `profile_malformed`, `profile_without_default`,
        `profile_certificate` or, where
            Fast DDS cannot be asked, `profile_unverifiable`.
    """
    name = os.environ.get(VARIABLE)
    if not name or not rmw.startswith("rmw_fastrtps"):
        return None
    path = Path(name).resolve()
    if not path.is_file():
        raise ProfileError(
            "profile_missing", f"expected a file of profiles, got {VARIABLE}={name}: not there"
        )
    if _loader(rmw)(os.fsencode(path)) != _XML_OK:
        raise ProfileError(
            "profile_malformed",
            f"expected profiles that Fast DDS can read in {path}; its lines above name the element to mend",
        )
    return _read(path)


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


def _loader(rmw: str) -> Callable[[bytes], int]:
    """Fast DDS's own reading of a file of profiles."""
    try:
        load = ctypes.CDLL(f"lib{rmw}.so")[_LOAD]
    except (OSError, AttributeError) as error:
        raise ProfileError(
            "profile_unverifiable",
            f"expected Fast DDS 2 of ROS 2 Jazzy to judge {VARIABLE} with: {error};"
            " unset it to run without profiles",
        ) from error
    load.restype = ctypes.c_int

    def loaded(path: bytes) -> int:
        return int(load(ctypes.byref(_StdString(path, len(path)))))

    return loaded


class _StdString(ctypes.Structure):
    """`std::string` of libstdc++, as a function sees it that only reads it."""

    _fields_ = [
        ("pointer", ctypes.c_char_p),
        ("size", ctypes.c_size_t),
        ("capacity", ctypes.c_char * 16),
    ]


def _read(path: Path) -> Profile:
    root = ET.parse(path).getroot()
    transports = {
        item.findtext(f"{_TAG}transport_id"): item for item in root.iter(f"{_TAG}transport_descriptor")
    }
    participant = root.find(f".//{_TAG}participant[@is_default_profile='true']/{_TAG}rtps")
    if participant is None:
        raise ProfileError(
            "profile_without_default",
            f'expected a participant with is_default_profile="true" in {path}: nodes use no other',
        )
    used = [
        transports[item.text] for item in participant.iterfind(f"{_TAG}userTransports/{_TAG}transport_id")
    ]
    builtin = (participant.findtext(f"{_TAG}useBuiltinTransports") or "true").strip() in ("true", "1")
    kinds = {item.findtext(f"{_TAG}type"): item for item in used}
    tcp = kinds.get("TCPv4", kinds.get("TCPv6"))
    if tcp is not None:
        _check_certificates(tcp)
    return Profile(
        path,
        udp=builtin or "UDPv4" in kinds or "UDPv6" in kinds,
        tcp_ports=None
        if tcp is None
        else frozenset(int(port.text or 0) for port in tcp.iterfind(f"{_TAG}listening_ports/{_TAG}port")),
    )


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
