# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""SROS2: governance and permissions of DDS Security for this graph, from the table `config/access.yaml`.

By the governance all must be who they say they are, all is encrypted, and every topic is for those who may.
Names are those that ROS 2 gives to DDS topics (design.ros2.org, "Topic and Service name mapping to DDS"):
`rt/` before a topic, `rq/…Request` and `rr/…Reply` for a service, five of these for an action. The wheels'
Fast DDS is built without DDS Security: the files are for genuine installations.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from datetime import UTC, datetime, timedelta
from pathlib import Path
from string import Template
from typing import Any, NamedTuple
from xml.sax.saxutils import escape

import yaml

from teo_common.atomic_files import write_atomically
from teo_common.installed_packages import package_path

# Before which every enclave stands, as in `--enclave /teo/driver`.
_ENCLAVES = "/teo"
# As long as the certificates of `ros2 security create_keystore`.
_VALID = timedelta(days=3650)
_TOPICS_OF_ALL = ("rosout", "parameter_events")


class Access(NamedTuple):
    """What an enclave may do, as names of DDS topics; `*` stands for anything."""

    publish: list[str]
    subscribe: list[str]


def read_table() -> dict[str, Access]:
    """Read from `config/access.yaml` who may do what, by the names of the enclaves."""
    path = package_path("teo_bringup", "config/access.yaml")
    table: dict[str, dict[str, Any]] = yaml.safe_load(path.read_text(encoding="utf-8"))
    return {name: _access(row.get("node", name), row) for name, row in table.items()}


def write_access_files(folder: Path, *, domain: int, now: datetime | None = None) -> None:
    """Write `governance.xml` and for every enclave `NAME/permissions.xml`, to be signed by the keystore.

    Args:
        folder: Where; made if need be.
        domain: The ROS_DOMAIN_ID for which they hold.
        now: From when on they are valid, for ten years; None: from now on.

    Raises:
        OSError: They cannot be written.
    """
    begin = now or datetime.now(UTC)
    folder.mkdir(parents=True, exist_ok=True)
    governance = xml_template("governance.xml").substitute(domain=domain)
    write_atomically(folder / "governance.xml", governance.encode())
    for name, access in read_table().items():
        permissions = xml_template("permissions.xml").substitute(
            enclave=f"{_ENCLAVES}/{name}",
            domain=domain,
            begin=_date(begin),
            end=_date(begin + _VALID),
            publish=_topics(access.publish),
            subscribe=_topics(access.subscribe),
        )
        (folder / name).mkdir(exist_ok=True)
        write_atomically(folder / name / "permissions.xml", permissions.encode())


def xml_template(name: str) -> Template:
    """A file of `config/network/` that wants values, which must be text of XML."""
    return Template(package_path("teo_bringup", f"config/network/{name}").read_text(encoding="utf-8"))


def _date(time: datetime) -> str:
    return time.strftime("%Y-%m-%dT%H:%M:%S")


def _topics(names: Iterable[str]) -> str:
    """The elements, on lines of their own at the template's depth."""
    return "\n            ".join(f"<topic>{escape(name)}</topic>" for name in names)


def _access(node: str, row: Mapping[str, Any]) -> Access:
    own = f"{node}/*"  # its parameters, and of a lifecycle node its services and events
    publish = [f"rt/{name}" for name in (*_TOPICS_OF_ALL, own, *row.get("publishes", ()))]
    subscribe = [f"rt/{name}" for name in ("parameter_events", "clock", *row.get("subscribes", ()))]
    actions, asked = row.get("executes", []), row.get("asks", [])
    served = [*row.get("serves", ()), *_services(actions), own]
    called = [*row.get("calls", ()), *_services(asked)]
    for names, requests, replies in ((served, subscribe, publish), (called, publish, subscribe)):
        requests += [f"rq/{name}Request" for name in names]
        replies += [f"rr/{name}Reply" for name in names]
    for names, topics in ((actions, publish), (asked, subscribe)):
        topics += [f"rt/{name}/_action/{topic}" for name in names for topic in ("feedback", "status")]
    # What ROS 2's nodes tell each other of the graph.
    return Access([*publish, "ros_discovery_info"], [*subscribe, "ros_discovery_info"])


def _services(actions: Iterable[str]) -> list[str]:
    return [
        f"{name}/_action/{part}" for name in actions for part in ("send_goal", "cancel_goal", "get_result")
    ]
