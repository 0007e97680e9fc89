# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The launch files name what exists; `launch` itself, which no wheel has, is stood in for."""

from __future__ import annotations

import runpy
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from teo_bringup.graph import executable_of

LAUNCH_FILES = sorted((Path(__file__).parents[1] / "launch").glob("*.launch.py"))


class Recorded:
    """Keeps what it was made with; knows only those keywords of the real class that are used here."""

    known: frozenset[str] = frozenset()

    def __init__(self, *arguments: object, **keywords: Any) -> None:
        unknown = set(keywords) - self.known
        assert not unknown, f"expected keywords of {sorted(self.known)}, got {sorted(unknown)}"
        self.arguments, self.keywords = arguments, keywords


def stand_in(name: str, *known: str) -> type[Recorded]:
    return type(name, (Recorded,), {"known": frozenset(known)})


Node = stand_in("Node", "package", "executable", "namespace", "parameters", "output", "on_exit")
DeclareLaunchArgument = stand_in("DeclareLaunchArgument", "default_value", "description")
Shutdown = stand_in("Shutdown", "reason")
STAND_INS = {
    "launch": {"LaunchDescription": Recorded},
    "launch.actions": {"DeclareLaunchArgument": DeclareLaunchArgument, "Shutdown": Shutdown},
    "launch.substitutions": {"LaunchConfiguration": Recorded},
    "launch_ros": {},
    "launch_ros.actions": {"Node": Node},
}


@pytest.fixture(params=LAUNCH_FILES, ids=lambda path: path.name)
def actions(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> list[Recorded]:
    """What a launch file describes."""
    for name, attributes in STAND_INS.items():
        module = ModuleType(name)
        vars(module).update(attributes)
        monkeypatch.setitem(sys.modules, name, module)
    description = runpy.run_path(str(request.param))["generate_launch_description"]()
    (entities,) = description.arguments
    return list(entities)


def test_every_node_is_installed_takes_what_is_declared_and_ends_all_with_it(actions: list[Recorded]) -> None:
    declared = {
        action.arguments[0]: action.keywords["default_value"]
        for action in actions
        if isinstance(action, DeclareLaunchArgument)
    }
    assert Path(declared["params_file"]).is_file()
    nodes = [action.keywords for action in actions if isinstance(action, Node)]
    assert nodes
    for node in nodes:
        assert executable_of(node["package"], node["executable"]).is_file()
        assert isinstance(node["on_exit"], Shutdown)
        given = [node["namespace"], node["parameters"][0], *node["parameters"][1].values()]
        assert {value.arguments[0] for value in given} == set(declared)


def test_there_is_one_for_signing_seeing_learning_and_showing() -> None:
    names = [path.name.removesuffix(".launch.py") for path in LAUNCH_FILES]
    assert names == ["capture", "console", "retriever", "signing"]
