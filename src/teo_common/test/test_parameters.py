# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress

import pytest
import rclpy
from rclpy.context import Context
from rclpy.exceptions import ParameterImmutableException
from rclpy.node import Node
from rclpy.parameter import Parameter

from teo_common.parameters import ParameterRow, declare_parameters

ROWS = (
    ParameterRow(name="rate", default=10, low=1, high=100, description="Steps per second [Hz]."),
    ParameterRow(name="wait", default=0.5, low=0.0, high=2.0, description="Longest wait [s]."),
    ParameterRow(name="loud", default=False, description="Whether it speaks."),
    ParameterRow(name="hand", default="right", choices=("right", "left"), description="Which hand."),
    ParameterRow(name="words", default=("",), description="Words."),
    ParameterRow(name="folder", default="", description="Where.", read_only=True),
)
ENDS = [("rate", 1), ("rate", 100), ("wait", 0.0), ("wait", 2.0), ("loud", True)]
BEYOND = [
    ("rate", 0),
    ("rate", 101),
    ("wait", -0.1),
    ("wait", 2.1),
    ("wait", 1),
    ("loud", 1),
    ("folder", "x"),
]


@pytest.fixture(scope="module")
def node(module_domain_id: int) -> Iterator[Node]:
    context = Context()
    rclpy.init(context=context, domain_id=module_domain_id)
    node = Node("parameters", context=context)
    declare_parameters(node, ROWS)
    yield node
    node.destroy_node()
    context.try_shutdown()


def accepted(node: Node, name: str, value: object) -> bool:
    return bool(node.set_parameters([Parameter(name, value=value)])[0].successful)


def test_every_row_has_its_default(node: Node) -> None:
    got = {row.name: node.get_parameter(row.name).value for row in ROWS}
    assert list(got.pop("words")) == [""]
    assert got == {"rate": 10, "wait": 0.5, "loud": False, "hand": "right", "folder": ""}


@pytest.mark.parametrize(("name", "value"), ENDS)
def test_values_up_to_both_ends_of_the_range_are_taken(node: Node, name: str, value: object) -> None:
    assert accepted(node, name, value)
    assert node.get_parameter(name).value == value


@pytest.mark.parametrize(("name", "value"), BEYOND)
def test_values_beyond_the_range_of_another_type_or_read_only_are_refused(
    node: Node, name: str, value: object
) -> None:
    before = node.get_parameter(name).value
    with suppress(ParameterImmutableException):  # how rclpy refuses read-only ones inside the process
        assert not accepted(node, name, value)
    assert node.get_parameter(name).value == before


def test_what_a_person_needs_is_shown(node: Node) -> None:
    shown = {row.name: node.describe_parameter(row.name) for row in ROWS}
    assert shown["wait"].description == "Longest wait [s]."
    assert shown["hand"].additional_constraints == "one of 'right', 'left'"
    assert shown["folder"].read_only
