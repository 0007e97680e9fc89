# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`ros2 doctor`: what may be wrong with this machine's setup and with the graph, subject by subject."""

from __future__ import annotations

import argparse
import os
import platform
import socket
import sys
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from teo_ros2cli.bags.selection import is_hidden
from teo_ros2cli.cli.options import add_graph_arguments, known_graph
from teo_ros2cli.graph.discovery import node_names
from teo_ros2cli.packages import prefixes


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    add_graph_arguments(parser)
    parser.add_argument("--report", "-r", action="store_true", help="Print all reports.")
    parser.add_argument(
        "--report-failed", "-rf", action="store_true", help="Print reports of failed checks only."
    )
    parser.add_argument(
        "--include-warnings", "-iw", action="store_true", help="Include warnings as failed checks."
    )


def run(options: argparse.Namespace) -> int:
    """Print the reports that are asked for, or without one how many checks passed and what is wrong."""
    sections = [
        _examine_network(),
        _examine_platform(),
        _examine_middleware(),
    ]
    with known_graph(options, names=True) as node:
        sections += _examine_graph(node, node_names(node))
    failed = [
        section for section in sections if section.problems or (options.include_warnings and section.warnings)
    ]
    if options.report or options.report_failed:
        for section in sections if options.report else failed:
            print(f"\n   {section.title}")
            width = max((len(name) for name, _ in section.lines), default=0)
            for name, value in section.lines:
                print(f"{name.ljust(width)} : {value}")
        return 0
    for section in sections:
        for kind, sentences in (("ERROR", section.problems), ("WARNING", section.warnings)):
            for sentence in sentences:
                print(f"{section.name}: {kind}: {sentence}", file=sys.stderr)
    if failed:
        print(f"\n{len(failed)}/{len(sections)} check(s) failed\n")
        print("Failed modules:", *(section.name for section in failed))
    else:
        print(f"\nAll {len(sections)} checks passed\n")
    return 0


_INTERFACES = Path("/sys/class/net")
# Flags of a network interface, as in Linux's if.h: it is up, and takes multicast.
_UP, _MULTICAST = 0x1, 0x1000
# What decides who hears whom; all of it is told, since a name that is misspelt has no effect in silence.
_VARIABLES = ("ROS_", "RMW_", "FASTRTPS_", "FASTDDS_", "CYCLONEDDS_", "AMENT_PREFIX_PATH")
_PROFILES = ("FASTRTPS_DEFAULT_PROFILES_FILE", "FASTDDS_DEFAULT_PROFILES_FILE")
# Domains above it use ports that the system gives to others (Linux, docs.ros.org "The ROS_DOMAIN_ID").
_HIGHEST_DOMAIN = 101


class _Section(NamedTuple):
    """One subject.

    Args:
        name: In a word, such as `network`.
        title: Above the lines.
        lines: What was found: a name and a value each.
        problems: A sentence for each thing that keeps the graph from working.
        warnings: A sentence for each thing that may be meant so.
    """

    name: str
    title: str
    lines: Sequence[tuple[str, str]]
    problems: Sequence[str] = ()
    warnings: Sequence[str] = ()


def _examine_network() -> _Section:
    """Look at the network interfaces: by multicast, which one must take, participants find each other."""
    lines: list[tuple[str, str]] = []
    capable = []
    for _, name in socket.if_nameindex():
        flags = int((_INTERFACES / name / "flags").read_text(encoding="ascii"), 16)
        mtu = (_INTERFACES / name / "mtu").read_text(encoding="ascii").strip()
        words = [word for bit, word in ((_UP, "UP"), (_MULTICAST, "MULTICAST")) if flags & bit]
        lines += [("device", name), ("flags", ",".join(words)), ("mtu", mtu)]
        if flags & _UP and flags & _MULTICAST:
            capable.append(name)
    warnings = (
        () if capable else ("No network interface that is up takes multicast: other machines are not found",)
    )
    return _Section("network", "NETWORK CONFIGURATION", lines, warnings=warnings)


def _examine_platform() -> _Section:
    """Tell the machine, Python, the distribution of ROS, and what the environment sets for ROS."""
    lines = [
        ("system", f"{platform.system()} {platform.release()} {platform.machine()}"),
        ("python version", platform.python_version()),
        ("distribution name", os.environ.get("ROS_DISTRO", "")),
        *((name, value) for name, value in sorted(os.environ.items()) if name.startswith(_VARIABLES)),
    ]
    problems = []
    if not os.environ.get("ROS_DISTRO"):
        problems.append("ROS_DISTRO is not set: source the workspace")
    domain = os.environ.get("ROS_DOMAIN_ID", "0")
    if not domain.isdecimal() or int(domain) > _HIGHEST_DOMAIN:
        problems.append(f"ROS_DOMAIN_ID is {domain!r}: expected a number from 0 to {_HIGHEST_DOMAIN}")
    problems += [
        f"{name} names '{file}', which is no file: Fast DDS goes on without it"
        for name in _PROFILES
        if (file := os.environ.get(name)) and not Path(file).is_file()
    ]
    missing = [entry for entry in os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if entry]
    missing = [entry for entry in missing if Path(entry) not in prefixes()]
    warnings = [f"AMENT_PREFIX_PATH names '{entry}', which does not exist" for entry in missing]
    return _Section("platform", "PLATFORM INFORMATION", lines, problems, warnings)


def _examine_middleware() -> _Section:
    """Tell the middleware that is in use."""
    from rclpy.utilities import get_rmw_implementation_identifier

    used, wanted = get_rmw_implementation_identifier(), os.environ.get("RMW_IMPLEMENTATION", "")
    problems = () if wanted in ("", used) else (f"RMW_IMPLEMENTATION is '{wanted}', but '{used}' is used",)
    return _Section("rmw", "RMW MIDDLEWARE", [("middleware name", used)], problems)


def _examine_nodes(names: Sequence[str]) -> _Section:
    """Look for nodes that share a name."""
    shared = sorted(name for name, count in Counter(names).items() if count > 1)
    problems = [f"{names.count(name)} nodes have the name '{name}'" for name in shared]
    return _Section("node", "NODE LIST", [("node", name) for name in sorted(names)], problems)


class Topic(NamedTuple):
    """A topic of the graph, with rclpy's information on the endpoints of others than this command."""

    name: str
    types: Sequence[str]
    publishers: Sequence[Any]
    subscriptions: Sequence[Any]


def _examine_topics(topics: Sequence[Topic]) -> _Section:
    """Look for topics with several types, and for those that only one side has."""
    lines: list[tuple[str, str]] = []
    problems, warnings = [], []
    for topic in topics:
        published, subscribed = len(topic.publishers), len(topic.subscriptions)
        lines += [
            ("topic", topic.name),
            ("publisher count", str(published)),
            ("subscriber count", str(subscribed)),
        ]
        if len(topic.types) > 1:
            problems.append(f"'{topic.name}' has several types, which never meet: {', '.join(topic.types)}")
        if published and not subscribed:
            warnings.append(f"Publisher without subscriber detected on {topic.name}.")
        if subscribed and not published:
            warnings.append(f"Subscriber without publisher detected on {topic.name}.")
    return _Section("topic", "TOPIC LIST", lines, problems, warnings)


def _examine_qos(topics: Sequence[Topic]) -> _Section:
    """Look for publishers and subscriptions of one topic that never meet by what they offer and ask."""
    from rclpy.qos import QoSCompatibility, qos_check_compatible

    lines: list[tuple[str, str]] = []
    problems = []
    for topic in topics:
        for publisher in topic.publishers:
            for subscription in topic.subscriptions:
                verdict, reason = qos_check_compatible(publisher.qos_profile, subscription.qos_profile)
                state = "OK" if verdict == QoSCompatibility.OK else f"{verdict.name}: {reason.strip()}"
                pair = f"{publisher.node_name} -> {subscription.node_name}"
                lines += [
                    ("topic [type]", f"{topic.name} [{topic.types[0]}]"),
                    ("publisher -> subscriber", pair),
                ]
                lines.append(("compatibility status", state))
                if verdict == QoSCompatibility.ERROR:
                    problems.append(f"{topic.name}: {pair}: {reason.strip()}")
    return _Section("qos", "QOS COMPATIBILITY LIST", lines, problems)


def _examine_graph(node: Any, names: Sequence[str]) -> list[_Section]:
    """Examine the nodes and topics that a node knows, itself left out.

    Args:
        node: It knows the graph (see `teo_ros2cli.graph.discovery.settle`).
        names: Full names of the nodes of others.
    """
    own = node.get_name()
    topics = [
        Topic(
            name,
            types,
            [info for info in node.get_publishers_info_by_topic(name) if info.node_name != own],
            [info for info in node.get_subscriptions_info_by_topic(name) if info.node_name != own],
        )
        for name, types in node.get_topic_names_and_types()
        if not is_hidden(name)
    ]
    topics = [topic for topic in topics if topic.publishers or topic.subscriptions]
    return [_examine_nodes(names), _examine_topics(topics), _examine_qos(topics)]
