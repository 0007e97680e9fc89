# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a node knows of the graph, and waiting until it knows it."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Collection
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.interfaces import interface_name_of

_Found = TypeVar("_Found")
_UNKNOWN_NODE = "_NODE_NAME_UNKNOWN_"
# Every participant of ROS 2 publishes on this topic which nodes it holds; its name goes to DDS unmangled.
_DISCOVERY_TOPIC = "ros_discovery_info"
# Bytes of an endpoint's identifier that name its participant.
_PARTICIPANT_PREFIX = 12

# Time for participants of other machines to answer [s]: the genuine command's default without its daemon.
_REMOTE_ANSWER = 0.5
# The same when nothing is to come from outside this machine [s].
_LOCAL_ANSWER = 0.1
# Fast DDS announces a participant every 3 s: one that was not heard of by then does not take part.
_LONGEST = 3.5
# Once all participants are known, what belongs to them follows, mostly without a longer pause [s]: what was
# missed is asked for again with the next announcement, a quarter of a second later (config/fastdds.xml).
_QUIET = 0.3
# The same before a message that is sent once [s]: a subscription that two announcements in a row were lost of
# is not there yet, on a loaded machine; one that is overlooked never gets the message.
_QUIET_BEFORE_MESSAGE = 0.6
# Time in which a thing that is asked for by name may still be announced [s]: four announcements of
# config/fastdds.xml, of which a loaded machine loses some.
_LATE = 1.0
# Interval of looking at the graph [s].
_POLL = 0.02

# Ports of the RTPS specification (OMG DDSI-RTPS 2.5, section 9.6.2.3): those that are bound tell how many
# participants run on this machine, so how many there are to wait for.
_PORT_BASE = 7400
_DOMAIN_GAIN = 250
_UNICAST_OFFSET = 10
_PARTICIPANT_GAIN = 2
_UDP_TABLE = Path("/proc/net/udp")


def settle(
    node: Any,
    spin_time: float | None = None,
    *,
    names: bool = False,
    publishers: Collection[Any] = (),
    stopped: Callable[[], bool] = lambda: False,
) -> None:
    """Wait until the node knows the graph.

    That is: an answering time has passed, every participant of this machine is known, and nothing has changed
    for a moment; at most `_LONGEST` or the spin time.

    Args:
        node: The node.
        spin_time: Answering time [s]; by default half a second, less if only this machine takes part.
        names: Wait for the names of the nodes as well, which come after topics and services.
        publishers: Wait also until every subscription of their topics that can take from them has matched.
        stopped: Asked all the time; True ends the waiting.
    """
    started = time.monotonic()
    shortest = spin_time if spin_time is not None else _answering_time()
    longest = max(shortest, _LONGEST)
    quiet = _QUIET_BEFORE_MESSAGE if publishers else _QUIET
    if spin_time is not None:
        quiet = min(quiet, spin_time)
    changed, last = started, None
    while (now := time.monotonic()) - started < longest and not stopped():
        picture = _picture(node, names, publishers)
        if picture != last:
            changed, last = now, picture
        ready = _UNKNOWN_NODE not in picture.nodes
        ready = ready and picture.participants >= _local_participants(node.context.get_domain_id())
        ready = ready and picture.matched >= len(picture.subscriptions)
        if ready and now - started >= shortest and now - changed >= quiet:
            return
        time.sleep(_POLL)


def look_again(look: Callable[[], _Found]) -> _Found:
    """Return what a look at the graph finds; while that is nothing, look on for a moment.

    What has only just appeared is announced a little after the rest.
    """
    deadline = time.monotonic() + _LATE
    while not (found := look()) and time.monotonic() < deadline:
        time.sleep(_POLL)
    return found


def _answering_time() -> float:
    outside = os.environ.get("ROS_AUTOMATIC_DISCOVERY_RANGE", "").upper() not in ("LOCALHOST", "OFF")
    peers = os.environ.get("ROS_STATIC_PEERS", "").strip()
    return _REMOTE_ANSWER if outside or peers else _LOCAL_ANSWER


class _Picture(NamedTuple):
    participants: int
    nodes: tuple[str, ...]
    topics: tuple[tuple[str, ...], ...]
    subscriptions: tuple[bytes, ...]
    matched: int


def _picture(node: Any, names: bool, publishers: Collection[Any]) -> _Picture:
    """Return what the node knows of the graph; names of nodes and publishers' matches only on request."""
    announcers = node.get_publishers_info_by_topic(_DISCOVERY_TOPIC, no_mangle=True)
    participants = {bytes(info.endpoint_gid[:_PARTICIPANT_PREFIX]) for info in announcers}
    # Every node publishes parameter events: by these one sees whether a node's name has come.
    owners = node.get_publishers_info_by_topic("/parameter_events") if names else []
    topics = tuple((name, *types) for name, types in node.get_topic_names_and_types())
    return _Picture(
        len(participants),
        tuple(sorted(info.node_name for info in owners)),
        topics,
        tuple(taker for publisher in publishers for taker in _takers(node, publisher)),
        sum(publisher.get_subscription_count() for publisher in publishers),
    )


def _takers(node: Any, publisher: Any) -> tuple[bytes, ...]:
    """Return the identifiers of the subscriptions that a publisher's type and quality of service suit."""
    from rclpy.qos import QoSCompatibility, qos_check_compatible

    kind = interface_name_of(publisher.msg_type)
    return tuple(
        sorted(
            bytes(info.endpoint_gid)
            for info in node.get_subscriptions_info_by_topic(publisher.topic_name)
            if info.topic_type == kind
            and qos_check_compatible(publisher.qos_profile, info.qos_profile)[0] != QoSCompatibility.ERROR
        )
    )


def _local_participants(domain: int) -> int:
    """Return the number of participants of a domain on this machine; 0 where that cannot be told."""
    try:
        return count_participants(_UDP_TABLE.read_text(encoding="ascii"), domain)
    except OSError:
        return 0


def count_participants(udp_table: str, domain: int) -> int:
    """Count the discovery ports of a domain in a text of the form of `/proc/net/udp`."""
    first = _PORT_BASE + _DOMAIN_GAIN * domain + _UNICAST_OFFSET
    last = _PORT_BASE + _DOMAIN_GAIN * (domain + 1)
    rows = udp_table.splitlines()[1:]
    ports = {int(row.split()[1].rpartition(":")[2], 16) for row in rows}
    return sum(first <= port < last and (port - first) % _PARTICIPANT_GAIN == 0 for port in ports)


def node_names(node: Any) -> list[str]:
    """Return the full names of the nodes of the graph, the given one left out."""
    own = (node.get_name(), node.get_namespace())
    return [
        f"{namespace.rstrip('/')}/{name}"
        for name, namespace in node.get_node_names_and_namespaces()
        if (name, namespace) != own
    ]


def full_topic_name(node: Any, topic: str) -> str:
    """Expand a topic name as typed (`text`, `/text`) to the full one.

    Raises:
        Ros2CliError: `invalid_topic`.
    """
    from rclpy.exceptions import InvalidTopicNameException
    from rclpy.expand_topic_name import expand_topic_name
    from rclpy.validate_full_topic_name import validate_full_topic_name

    try:
        expanded = expand_topic_name(topic, node.get_name(), node.get_namespace())
        validate_full_topic_name(expanded)
    except (ValueError, InvalidTopicNameException) as error:
        raise Ros2CliError("invalid_topic", str(error)) from error
    return str(expanded)


def topic_types(node: Any, topic: str) -> list[str]:
    """Return the types of a topic in the graph: none without it, several if its endpoints disagree."""
    return next((list(types) for name, types in node.get_topic_names_and_types() if name == topic), [])


def only_type(node: Any, topic: str, doing: str) -> str | None:
    """Return the type of a topic, or None if the graph has no such topic.

    Raises:
        Ros2CliError: `ambiguous_type`, endpoints of the topic have several types.
    """
    types = topic_types(node, topic)
    if len(types) > 1:
        raise Ros2CliError(
            "ambiguous_type",
            f"Cannot {doing} topic '{topic}', as it contains more than one type: [{', '.join(types)}]",
        )
    return types[0] if types else None


def wait_for_type(node: Any, topic: str, doing: str) -> str:
    """Wait until the graph has a topic, and return its type."""
    found = only_type(node, topic, doing)
    if found is None:
        print(f"WARNING: topic [{topic}] does not appear to be published yet", flush=True)
    while found is None:
        time.sleep(0.1)
        found = only_type(node, topic, doing)
    return found
