# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""SROS2: governance and permissions of DDS Security for this graph, from the table `config/access.yaml`.

Names are those that ROS 2 gives to DDS topics (design.ros2.org, "Topic and Service name mapping to DDS"):
`rt/` before a topic, `rq/…Request` and `rr/…Reply` for a service, five of these for an action. The wheels'
Fast DDS is built without DDS Security: the files are for genuine installations.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterable, Mapping
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any, NamedTuple

import yaml
from ament_index_python.packages import get_package_share_directory

from teo_common.atomic_files import write_atomically

# Before which every enclave stands, as in `--enclave /teo/driver`.
_ENCLAVES = "/teo"
_SCHEMAS = "http://www.omg.org/spec/DDS-SECURITY/20170901/omg_shared_ca"
_XSI = "http://www.w3.org/2001/XMLSchema-instance"
# As long as the certificates of `ros2 security create_keystore`.
_VALID = timedelta(days=3650)
_TOPICS_OF_ALL = ("rosout", "parameter_events")


class Access(NamedTuple):
    """What an enclave may do, as names of DDS topics; `*` stands for anything."""

    publish: list[str]
    subscribe: list[str]


def read_table(path: Path | None = None) -> dict[str, Access]:
    """Read who may do what.

    Args:
        path: A table like `config/access.yaml`; None: that one.
    """
    path = path or Path(get_package_share_directory("teo_bringup")) / "config" / "access.yaml"
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
    write_atomically(folder / "governance.xml", governance(domain))
    for name, access in read_table().items():
        (folder / name).mkdir(exist_ok=True)
        write_atomically(folder / name / "permissions.xml", permissions(name, access, domain, begin))


def governance(domain: int) -> bytes:
    """All must be who they say they are, all is encrypted, and every topic is for those who may.

    Args:
        domain: The ROS_DOMAIN_ID for which it holds.
    """
    root = _root("governance")
    rule = _add(_add(root, "domain_access_rules"), "domain_rule")
    _add(_add(rule, "domains"), "id", str(domain))
    _add_all(
        rule,
        allow_unauthenticated_participants="false",
        enable_join_access_control="true",
        discovery_protection_kind="ENCRYPT",
        liveliness_protection_kind="ENCRYPT",
        rtps_protection_kind="SIGN",
    )
    _add_all(
        _add(_add(rule, "topic_access_rules"), "topic_rule"),
        topic_expression="*",
        enable_discovery_protection="true",
        enable_liveliness_protection="true",
        enable_read_access_control="true",
        enable_write_access_control="true",
        metadata_protection_kind="ENCRYPT",
        data_protection_kind="ENCRYPT",
    )
    return _bytes(root)


def permissions(name: str, access: Access, domain: int, begin: datetime) -> bytes:
    """What one enclave may do; all else is denied.

    Args:
        name: Of the enclave.
        access: What it may do.
        domain: The ROS_DOMAIN_ID for which it holds.
        begin: From when on it is valid.
    """
    root = _root("permissions")
    enclave = f"{_ENCLAVES}/{name}"
    grant = _add(_add(root, "permissions"), "grant")
    grant.set("name", enclave)
    _add(grant, "subject_name", f"CN={enclave}")
    _add_all(
        _add(grant, "validity"),
        not_before=begin.strftime("%Y-%m-%dT%H:%M:%S"),
        not_after=(begin + _VALID).strftime("%Y-%m-%dT%H:%M:%S"),
    )
    rule = _add(grant, "allow_rule")
    _add(_add(rule, "domains"), "id", str(domain))
    for kind, topics in (("publish", access.publish), ("subscribe", access.subscribe)):
        listed = _add(_add(rule, kind), "topics")
        for topic in topics:
            _add(listed, "topic", topic)
    _add(grant, "default", "DENY")
    return _bytes(root)


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


def _root(kind: str) -> ET.Element:
    root = ET.Element("dds")
    root.set(f"{{{_XSI}}}noNamespaceSchemaLocation", f"{_SCHEMAS}_{kind}.xsd")
    return root


def _add(parent: ET.Element, name: str, text: str | None = None) -> ET.Element:
    child = ET.SubElement(parent, name)
    child.text = text
    return child


def _add_all(parent: ET.Element, **texts: str) -> None:
    for name, text in texts.items():
        _add(parent, name, text)


def _bytes(root: ET.Element) -> bytes:
    ET.register_namespace("xsi", _XSI)
    ET.indent(root)
    text: bytes = ET.tostring(root, encoding="UTF-8", xml_declaration=True)
    return text + b"\n"
