# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any

import pytest
from builtin_interfaces.msg import Time
from geometry_msgs.msg import PoseStamped
from hypothesis import given, settings
from hypothesis import strategies as st
from rclpy.serialization import deserialize_message, serialize_message
from rosidl_parser.definition import (
    AbstractNestedType,
    AbstractString,
    Array,
    NamespacedType,
)
from sensor_msgs.msg import CameraInfo, Image, Imu, JointState
from std_msgs.msg import Bool, Byte, ByteMultiArray, Char, Float32, Int8, String, UInt64
from trajectory_msgs.msg import JointTrajectory

from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.interfaces import interface_class, message_class
from teo_ros2cli.messages.fill import fill_from_text
from teo_ros2cli.messages.tree import Abridgement, dump, message_tree, select

# Together they have fields of every kind.
CLASSES = (JointTrajectory, CameraInfo, Imu, Image, ByteMultiArray, String, Bool, Byte, Char, Int8)


def filled(cls: Any, text: str) -> Any:
    message = cls()
    fill_from_text(message, text)
    return message


_INTEGERS = {
    **{f"int{bits}": st.integers(-(2 ** (bits - 1)), 2 ** (bits - 1) - 1) for bits in (8, 16, 32, 64)},
    **{f"uint{bits}": st.integers(0, 2**bits - 1) for bits in (8, 16, 32, 64)},
}
_TEXT = st.text(st.characters(codec="utf-8", exclude_characters="\0"), max_size=12)


def values_of(kind: Any) -> st.SearchStrategy[Any]:
    """Any value of a field, as plain Python."""
    if isinstance(kind, NamespacedType):
        return tree_of(interface_class("/".join(kind.namespaced_name()), "msg"))
    if isinstance(kind, AbstractNestedType):
        least = kind.size if isinstance(kind, Array) else 0
        most = kind.size if isinstance(kind, Array) else min(getattr(kind, "maximum_size", 4), 4)
        return st.lists(values_of(kind.value_type), min_size=least, max_size=most)
    if isinstance(kind, AbstractString):
        return _TEXT
    name = kind.typename
    if name == "boolean":
        return st.booleans()
    if name == "octet":
        return st.integers(0, 255)
    if name in _INTEGERS:
        return _INTEGERS[name]
    return st.floats(width=32 if name == "float" else 64, allow_nan=False)


def tree_of(cls: Any) -> st.SearchStrategy[dict[str, Any]]:
    names = list(cls.get_fields_and_field_types())
    return st.fixed_dictionaries(
        {name: values_of(kind) for name, kind in zip(names, cls.SLOT_TYPES, strict=False)}
    )


@settings(max_examples=150)
@given(st.data())
def test_any_message_survives_printing_and_reading(data: st.DataObject) -> None:
    cls = data.draw(st.sampled_from(CLASSES))
    message = filled(cls, dump(data.draw(tree_of(cls))))
    again = filled(cls, dump(message_tree(message), flow_style=data.draw(st.booleans())))
    # The generated comparison judges, and the wire format takes and gives back each value.
    assert again == message
    assert deserialize_message(serialize_message(again), cls) == message


# What people type


@pytest.mark.parametrize(
    "typed", ["12:30", "no", "null", "1e3", "2024-01-01", "0x10", "'quoted: text'", "1_000", "=", "~"]
)
def test_a_string_field_takes_the_text_as_typed(typed: str) -> None:
    assert filled(String, f"{{data: {typed}}}").data == typed.strip("'")


def test_numbers_that_yaml_takes_for_text_are_numbers() -> None:
    assert filled(Float32, "data: 1e-3").data == pytest.approx(1e-3)
    assert filled(UInt64, f"data: {2**64 - 1}").data == 2**64 - 1
    assert filled(Int8, "data: 3.0").data == 3
    assert filled(Bool, "data: yes").data is True


def test_bytes_are_numbers_or_base64() -> None:
    assert filled(Byte, "data: 255").data == b"\xff"
    assert list(filled(Image, "data: !!binary AQID").data) == [1, 2, 3]
    assert filled(ByteMultiArray, "data: [1, 2]").data == [b"\x01", b"\x02"]


@pytest.mark.parametrize(
    ("cls", "typed", "named"),
    [
        (String, "dat: x", "'std_msgs/msg/String' has no field 'dat' (at 'dat'); it has data"),
        (String, "data: [1]", "field 'data' takes a string"),
        (String, 'data: "a\\0b"', "NUL"),
        (Int8, "data: 128", "an integer from -128 to 127, got '128'"),
        (Int8, "data: 1.5", "an integer"),
        (Int8, "data: true", "an integer"),
        (Bool, "data: maybe", "true or false"),
        (Float32, "data: 1e39", "fits a 32-bit float"),
        (Float32, "data: x", "a number"),
        (Imu, "orientation_covariance: [1, 2]", "exactly 9 values, got [1, 2] of 2 values"),
        (JointTrajectory, "points: {}", "a sequence of trajectory_msgs/msg/JointTrajectoryPoint"),
        (
            JointTrajectory,
            "points: [{positions: [a]}]",
            "field 'points[0].positions[0]' takes a number, got 'a'",
        ),
        (JointTrajectory, "header: 3", "field 'header' takes a mapping"),
        (PoseStamped, "pose: {position: {w: 1}}", "(at 'pose.position.w'); it has x, y, z"),
    ],
)
def test_a_wrong_value_is_refused_with_its_place(cls: Any, typed: str, named: str) -> None:
    with pytest.raises(Ros2CliError) as caught:
        filled(cls, typed)
    assert caught.value.code == "invalid_field"
    assert named in str(caught.value)


@pytest.mark.parametrize(
    "typed", ["{", "[1, 2", "a: b: c", "data: !!python/object:os.system x", "? [a]: b", "2024-13-01", "\x00"]
)
def test_broken_yaml_is_refused(typed: str) -> None:
    with pytest.raises(Ros2CliError, match="is not valid YAML") as caught:
        filled(String, typed)
    assert caught.value.code == "invalid_yaml"


def test_automatic_stamps_are_set_when_publishing() -> None:
    message = PoseStamped()
    setters = fill_from_text(message, "{header: auto, pose: {position: {x: 1}}}", automatic_stamps=True)
    assert len(setters) == 1
    setters[0](Time(sec=7, nanosec=8))
    assert (message.header.stamp.sec, message.header.stamp.nanosec, message.pose.position.x) == (7, 8, 1.0)
    setters = fill_from_text(message, "{header: {stamp: now, frame_id: map}}", automatic_stamps=True)
    setters[0](Time(sec=9))
    assert (message.header.stamp.sec, message.header.frame_id) == (9, "map")


def test_bounded_sequences_have_limits() -> None:
    solid = message_class("shape_msgs/msg/SolidPrimitive")
    assert list(filled(solid, "dimensions: [1, 2, 3]").dimensions) == [1.0, 2.0, 3.0]
    with pytest.raises(Ros2CliError, match="at most 3 values"):
        filled(solid, "dimensions: [1, 2, 3, 4]")


# What is printed


def test_yaml_is_printed_as_people_know_it() -> None:
    message = filled(JointState, "{header: {frame_id: ñ}, name: [a, b], position: [0.5, 1]}")
    assert dump(message_tree(message)) == (
        "header:\n  stamp:\n    sec: 0\n    nanosec: 0\n  frame_id: ñ\nname:\n- a\n- b\n"
        "position:\n- 0.5\n- 1.0\nvelocity: []\neffort: []\n"
    )
    assert dump(message_tree(String(data="x y")), flow_style=True) == "{data: x y}\n"
    assert dump(message_tree(String(data="¿qué? 😀"))) == "data: ¿qué? 😀\n"


def test_long_values_are_cut_and_hidden_on_request() -> None:
    message = JointState(name=["abcdef"] * 3, position=[1.0] * 5)
    assert message_tree(message, Abridgement(length=2))["position"] == [1.0, 1.0, "..."]
    assert message_tree(message, Abridgement(length=2))["name"] == ["ab...", "ab...", "..."]
    hidden = message_tree(message, Abridgement(no_sequences=True))
    assert hidden["position"] == "<sequence type: double, length: 5>"
    assert (
        message_tree(Imu(), Abridgement(no_sequences=True))["orientation_covariance"]
        == "<array type: double[9]>"
    )
    assert message_tree(String(data="abc"), Abridgement(no_strings=True))["data"] == "<string length: <3>>"


def test_a_part_of_a_message_is_selected() -> None:
    message = filled(JointTrajectory, "{joint_names: [a, b], points: [{positions: [1, 2]}]}")
    assert list(select(message, "points[0].positions")) == [1.0, 2.0]
    assert select(message, "joint_names[-1]") == "b"
    for path in ("nothing", "points[3]", "points.x", "header.stamp.sec.more", ".", "points[x]", "__class__"):
        with pytest.raises(Ros2CliError):
            select(message, path)


@pytest.mark.parametrize(
    ("names", "told"),
    [
        (
            ("std_msgs/msg/Strin", "no_such_msgs/msg/String", "std_msgs/srv/String", "os/msg/path"),
            "is invalid",
        ),
        (
            ("", "String", "a/b/c/d", "std_msgs/msg/", "std msgs/msg/String", "x/nothing/Y", "../a/B"),
            "type is invalid: expected a name such as",
        ),
    ],
    ids=["unknown", "of a wrong form"],
)
def test_names_of_unknown_types_and_of_a_wrong_form_are_refused(names: tuple[str, ...], told: str) -> None:
    for name in names:
        with pytest.raises(Ros2CliError, match=told) as caught:
            message_class(name)
        assert caught.value.code == "invalid_type", name
