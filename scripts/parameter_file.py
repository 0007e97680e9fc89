# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Writes teo_bringup's parameter file from the tables of the nodes: `python scripts/parameter_file.py`."""

from __future__ import annotations

import importlib
import json
import textwrap
from collections.abc import Iterable
from pathlib import Path

from teo_common.parameters import ParameterRow, Value

FILE = Path(__file__).parents[1] / "src" / "teo_bringup" / "config" / "parameters.yaml"
# Each node, by the name that it has in the graph, and the table of its parameters: module and attribute.
TABLES = {
    "translator": ("teo_sign_translator.node.parameters", "PARAMETERS"),
    "executor": ("teo_lut_executor.node.parameters", "PARAMETERS"),
    "teo_sim_driver": ("teo_sim_driver.parameters", "PARAMETERS"),
    "skeleton_retriever": ("teo_skeleton_retriever.node.node_parameters", "PARAMETERS"),
    "console": ("teo_console.node.parameters", "PARAMETERS"),
    "capture": ("teo_sign_capture.node.parameters", "CAPTURE_PARAMETERS"),
}
_HEAD = """\
# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
#
# Every parameter of every node, with its default. Made by scripts/parameter_file.py from the nodes' own
# tables; a test compares the two. A lab copies this file, keeps the lines that it changes and names the copy:
#   ros2 run teo_bringup up --params-file my.yaml
#   ros2 launch teo_bringup signing.launch.py params_file:=my.yaml
"""
_WIDTH = 110  # characters of a comment's line


def parameter_file() -> str:
    """Give the text of the file."""
    sections = []
    for node, (module, attribute) in TABLES.items():
        rows: Iterable[ParameterRow] = getattr(importlib.import_module(module), attribute)
        # `/**/` before its name: the node is found in any namespace.
        sections.append(f"\n/**/{node}:\n  ros__parameters:\n" + "".join(map(_entry, rows)))
    return _HEAD + "".join(sections)


def _entry(row: ParameterRow) -> str:
    comment = row.description
    if row.choices:
        comment += f" One of {', '.join(json.dumps(choice) for choice in row.choices)}."
    if row.low is not None and row.high is not None:
        comment += f" {row.low:g} to {row.high:g}."
    if row.read_only:
        comment += " Read when the node starts."
    lines = textwrap.wrap(comment, _WIDTH, initial_indent="    # ", subsequent_indent="    # ")
    return "\n".join(lines) + f"\n    {row.name}: {_scalar(row.default)}\n"


def _scalar(value: Value) -> str:
    # JSON is YAML, and keeps the decimal point by which ROS tells a real number from a whole one.
    return json.dumps(list(value) if isinstance(value, tuple) else value, ensure_ascii=False)


if __name__ == "__main__":
    FILE.write_text(parameter_file(), encoding="utf-8")
