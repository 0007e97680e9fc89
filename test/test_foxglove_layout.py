# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Foxglove's layout shows what the demo's bag holds: recorded topics, and fields that their messages have."""

from __future__ import annotations

import importlib
import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import demo
import pytest
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from teo_sign_msgs.msg import ExecutorStatus, SignSentence

from teo_names import ALL_JOINTS

FILE = Path(__file__).parents[1] / "src" / "teo_bringup" / "config" / "foxglove_layout.json"
LAYOUT = json.loads(FILE.read_text(encoding="utf-8"))
TYPES: dict[str, Any] = {
    "text": String,
    "sign_tokens": SignSentence,
    "joint_states": JointState,
    "robot_description": String,
    "executor_status": ExecutorStatus,
}


def paths(part: Any) -> Iterator[str]:
    """Every path of a message, anywhere in the layout."""
    if isinstance(part, dict):
        yield from (key for key in part if key.startswith("/"))
        for value in part.values():
            yield from paths(value)
    elif isinstance(part, list):
        for value in part:
            yield from paths(value)
    elif isinstance(part, str) and part.startswith("/"):
        yield part


PATHS = sorted(set(paths(LAYOUT)))


@pytest.mark.parametrize("path", PATHS)
def test_every_path_leads_to_a_field_of_a_recorded_topic(path: str) -> None:
    topic, *fields = path.removeprefix("/").split(".")
    assert topic in demo.RECORDED
    message = TYPES[topic]
    for field in fields:
        name = re.sub(r"\[.*\]$", "", field)
        kind = message.get_fields_and_field_types()[name]
        element = re.sub(r"^sequence<([^,>]+).*$", r"\1", kind)
        package, _, kind_of_message = element.rpartition("/")
        message = getattr(importlib.import_module(f"{package}.msg"), kind_of_message) if package else None


def test_every_panel_is_placed_once() -> None:
    def panels(tree: Any) -> list[str]:
        return [tree] if isinstance(tree, str) else [*panels(tree["first"]), *panels(tree["second"])]

    assert sorted(panels(LAYOUT["layout"])) == sorted(LAYOUT["configById"])


def test_the_joints_that_are_plotted_are_the_arms() -> None:
    (path,) = (each for each in PATHS if each.startswith("/joint_states.position"))
    first, last = map(int, re.findall(r"\d+", path))
    plotted = ALL_JOINTS[first : last + 1]
    assert len(plotted) == 12
    assert all(re.search("Shoulder|Elbow|Wrist", name) for name in plotted)
