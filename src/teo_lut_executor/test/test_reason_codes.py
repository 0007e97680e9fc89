# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The README's list of reason codes is what the code can say: no code is missing, none is made up."""

from __future__ import annotations

import ast
import re
from pathlib import Path

from teo_lut_executor.execution.situation import BLOCKED

SOURCES = Path(__file__).parents[2]
# What executor and planner are made of; the commands of `lut` have codes of their own.
ROOMS = (
    "teo_lut_executor/teo_lut_executor/*.py",
    "teo_lut_executor/teo_lut_executor/execution/*.py",
    "teo_lut_executor/teo_lut_executor/node/*.py",
    "teo_motion/teo_motion/**/*.py",
    "teo_signs/teo_signs/**/*.py",
)


def said() -> set[str]:
    """Every code that a `PlanError` is made with, or that is given as `code`."""
    codes = {code for code, _ in BLOCKED.values()}
    for path in (path for room in ROOMS for path in SOURCES.glob(room)):
        for call in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if not isinstance(call, ast.Call):
                continue
            given = [word.value for word in call.keywords if word.arg == "code"]
            if isinstance(call.func, ast.Name) and call.func.id == "PlanError" and call.args:
                given.append(call.args[0])
            codes |= {each.value for each in given if isinstance(each, ast.Constant) and each.value}
    return codes


def listed() -> set[str]:
    """The codes of the README's table."""
    text = (SOURCES / "teo_lut_executor" / "README.md").read_text(encoding="utf-8")
    table = text.split("\n## Codes\n")[1].split("\n## ")[0]
    return {
        code
        for row in table.splitlines()
        if row.startswith("| `")
        for code in re.findall(r"`([a-z_]+)`", row.split("|")[1])
    }


def test_every_code_is_listed_and_no_other() -> None:
    assert listed() == said()
