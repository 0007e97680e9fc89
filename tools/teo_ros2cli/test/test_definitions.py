# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import re

import pytest
from mcap_ros2._dynamic import generate_dynamic
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.interfaces import (
    InterfaceName,
    definition_lines,
    installed_type_hash,
    interfaces,
    referenced_types,
    schema_of,
)


def computed_hash(name: str, text: str) -> str:
    """The type hash that an independent implementation computes from the definition text alone."""
    store = get_typestore(Stores.EMPTY)
    store.register(get_types_from_msg(text, name))
    return str(store.hash_rihs01(name))


def test_every_installed_message_has_a_schema_that_others_can_read_and_a_hash() -> None:
    names = [f"{package}/msg/{name}" for package, types in interfaces("msg").items() for name in types]
    assert len(names) > 100
    for name in names:
        schema = schema_of(name)
        generate_dynamic(name, schema.text)
        known = installed_type_hash(name)
        assert known.startswith("RIHS01_")
        # rosbags hashes `char` as a type of its own; ROS 2 has made it a uint8.
        assert computed_hash(name, schema.text) == known or re.search(r"^char\b", schema.text, re.MULTILINE)


def test_the_feedback_of_an_action_has_a_schema() -> None:
    action = next((f"{p}/action/{n}" for p, names in interfaces("action").items() for n in names), None)
    if action is None:
        pytest.skip("no action is installed")
    schema = schema_of(f"{action}_FeedbackMessage")
    assert "MSG: unique_identifier_msgs/UUID" in schema.text
    assert computed_hash(schema.name, schema.text) == installed_type_hash(schema.name)


def test_references_are_told_from_basic_types_constants_and_comments() -> None:
    lines = (
        "# geometry_msgs/Pose no",
        "Header h",
        "Pose[<=3] poses",
        "string<=5 s 'a/B c'",
        "int32 X=3",
        "uint8[4] d # a/X x",
    )
    assert [str(name) for name in referenced_types("\n".join(lines), "geometry_msgs")] == [
        "std_msgs/msg/Header",
        "geometry_msgs/msg/Pose",
    ]


def test_unknown_types_have_neither_schema_nor_hash() -> None:
    with pytest.raises(Ros2CliError):
        schema_of("std_msgs/msg/Nothing")
    assert installed_type_hash("std_msgs/msg/Nothing") == ""
    assert installed_type_hash("nonsense") == ""


def test_a_listing_expands_nested_types() -> None:
    name = InterfaceName.parse("std_msgs/msg/Header")
    bare = list(definition_lines(name, comments=False, nested_comments=False))
    assert bare == ["builtin_interfaces/Time stamp", "\tint32 sec", "\tuint32 nanosec", "string frame_id"]
    assert any(line.startswith("#") for line in definition_lines(name, comments=True, nested_comments=False))
    assert any(line.startswith("\t#") for line in definition_lines(name, comments=True, nested_comments=True))
