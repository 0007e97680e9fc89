# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The parameter file says what the nodes' own tables say."""

from __future__ import annotations

import importlib
from itertools import cycle
from pathlib import Path

import rclpy
import yaml
from parameter_file import FILE, TABLES, parameter_file
from rclpy.context import Context
from rclpy.node import Node

from teo_common.parameters import ParameterRow, declare_parameters


def rows_of(node: str) -> tuple[ParameterRow, ...]:
    module, attribute = TABLES[node]
    rows: tuple[ParameterRow, ...] = getattr(importlib.import_module(module), attribute)
    return rows


def test_it_is_what_the_script_writes_and_holds_every_parameter_with_its_default() -> None:
    assert FILE.read_text(encoding="utf-8") == parameter_file(), "run python scripts/parameter_file.py"
    values = yaml.safe_load(FILE.read_text(encoding="utf-8"))
    for node in TABLES:
        defaults = {
            row.name: list(row.default) if isinstance(row.default, tuple) else row.default
            for row in rows_of(node)
        }
        assert values[f"/**/{node}"]["ros__parameters"] == defaults


def test_every_number_has_a_range_with_its_default_in_it() -> None:
    for row in (row for node in TABLES for row in rows_of(node)):
        numbers = row.low is not None and row.high is not None and row.low <= row.default <= row.high
        assert isinstance(row.default, bool | str | tuple) or numbers, row.name


def test_a_node_takes_a_changed_value_from_it_in_any_namespace(domain_id: int, tmp_path: Path) -> None:
    context = Context()
    rclpy.init(context=context, domain_id=domain_id)
    for node, namespace in zip(TABLES, cycle(["", "/lab/teo"]), strict=False):
        rows = rows_of(node)
        changed = next(row for row in rows if row.low is not None and row.default != row.high)
        values = yaml.safe_load(FILE.read_text(encoding="utf-8"))
        values[f"/**/{node}"]["ros__parameters"][changed.name] = type(changed.default)(changed.high)
        file = tmp_path / "mine.yaml"
        file.write_text(yaml.safe_dump(values), encoding="utf-8")
        arguments = ["--ros-args", "--params-file", str(file)]
        made = Node(node, namespace=namespace, context=context, cli_args=arguments)
        # Every value of the file has the type and the range that the table declares, else this raises.
        declare_parameters(made, rows)
        assert made.get_parameter(changed.name).value == changed.high
        made.destroy_node()
    rclpy.shutdown(context=context)
