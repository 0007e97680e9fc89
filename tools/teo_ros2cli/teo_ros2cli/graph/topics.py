# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the graph tells about topics."""

from __future__ import annotations

import time
from typing import Any

from teo_ros2cli.errors import Ros2CliError


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
