# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The parameter file says what the nodes' own tables say."""

from __future__ import annotations

import importlib
from collections.abc import Iterator
from itertools import cycle
from pathlib import Path

import pytest
import rclpy
import yaml
from parameter_file import FILE, TABLES, parameter_file
from rclpy.context import Context
from rclpy.node import Node

from teo_common.parameters import declare_parameters


def test_it_is_what_the_script_writes_and_holds_every_parameter_with_its_default() -> None:
    assert FILE.read_text(encoding="utf-8") == parameter_file(), "run python scripts/parameter_file.py"
    values = yaml.safe_load(FILE.read_text(encoding="utf-8"))
    for node, (module, attribute) in TABLES.items():
        rows = getattr(importlib.import_module(module), attribute)
        defaults = {
            row.name: list(row.default) if isinstance(row.default, tuple) else row.default for row in rows
        }
        assert values[f"/**/{node}"]["ros__parameters"] == defaults


@pytest.fixture
def context(domain_id: int) -> Iterator[Context]:
    context = Context()
    rclpy.init(context=context, domain_id=domain_id)
    yield context
    rclpy.shutdown(context=context)


@pytest.mark.parametrize(("node", "namespace"), list(zip(TABLES, cycle(["", "/lab/teo"]), strict=False)))
def test_a_node_takes_a_changed_value_from_it_in_any_namespace(
    context: Context, tmp_path: Path, node: str, namespace: str
) -> None:
    module, attribute = TABLES[node]
    rows = getattr(importlib.import_module(module), attribute)
    numbers = [row for row in rows if row.low is not None and row.default != row.high]
    changed = numbers[0]
    values = yaml.safe_load(FILE.read_text(encoding="utf-8"))
    values[f"/**/{node}"]["ros__parameters"][changed.name] = type(changed.default)(changed.high)
    file = tmp_path / "mine.yaml"
    file.write_text(yaml.safe_dump(values), encoding="utf-8")
    # Every value of the file has the type and the range that the table declares, else this raises.
    made = Node(
        node,
        namespace=namespace,
        context=context,
        cli_args=["--ros-args", "--params-file", str(file)],
    )
    try:
        declare_parameters(made, rows)
        assert made.get_parameter(changed.name).value == changed.high
    finally:
        made.destroy_node()
