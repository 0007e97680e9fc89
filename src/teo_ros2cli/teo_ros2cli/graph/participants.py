"""How many DDS participants of a domain run on this machine, told by the UDP ports that are bound.

A new participant may hear of an old one only when that one announces itself next, which Fast DDS does every
three seconds. The ports of the RTPS specification (OMG DDSI-RTPS 2.5, section 9.6.2.3) tell how many there
are to wait for.
"""

from __future__ import annotations

from pathlib import Path

_PORT_BASE = 7400
_DOMAIN_GAIN = 250
_UNICAST_OFFSET = 10
_PARTICIPANT_GAIN = 2
_UDP_TABLE = Path("/proc/net/udp")


def local_participants(domain: int) -> int:
    """Return the number of participants of a domain on this machine; 0 where that cannot be told."""
    try:
        return count_participants(_UDP_TABLE.read_text(encoding="ascii"), domain)
    except (OSError, UnicodeDecodeError):
        return 0


def count_participants(udp_table: str, domain: int) -> int:
    """Count the discovery ports of a domain in a text of the form of `/proc/net/udp`."""
    first = _PORT_BASE + _DOMAIN_GAIN * domain + _UNICAST_OFFSET
    last = _PORT_BASE + _DOMAIN_GAIN * (domain + 1)
    ports = set()
    for line in udp_table.splitlines()[1:]:
        fields = line.split()
        if len(fields) > 1 and ":" in fields[1]:
            try:
                ports.add(int(fields[1].rsplit(":", 1)[1], 16))
            except ValueError:
                continue
    return sum(first <= port < last and (port - first) % _PARTICIPANT_GAIN == 0 for port in ports)
