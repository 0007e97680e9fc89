# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The launch files name what exists; `launch` itself, which no wheel has, is stood in for."""

from __future__ import annotations

import ast
import runpy
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

SOURCES = Path(__file__).parents[2]
LAUNCH_FILES = sorted((SOURCES / "teo_bringup" / "launch").glob("*.launch.py"))


class Recorded:
    """Keeps what it was made with; knows only those keywords of the real class that are used here."""

    known: frozenset[str] = frozenset()

    def __init__(self, *arguments: object, **keywords: Any) -> None:
        unknown = set(keywords) - self.known
        assert not unknown, f"expected keywords of {sorted(self.known)}, got {sorted(unknown)}"
        self.arguments, self.keywords = arguments, keywords


class Node(Recorded):
    known = frozenset({"package", "executable", "namespace", "parameters", "output", "on_exit"})


class DeclareLaunchArgument(Recorded):
    known = frozenset({"default_value", "description"})


class Shutdown(Recorded):
    known = frozenset({"reason"})


class LaunchConfiguration(Recorded):
    pass


class LaunchDescription(Recorded):
    pass


STAND_INS = {
    "launch": {"LaunchDescription": LaunchDescription},
    "launch.actions": {"DeclareLaunchArgument": DeclareLaunchArgument, "Shutdown": Shutdown},
    "launch.substitutions": {"LaunchConfiguration": LaunchConfiguration},
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


def executables_of(package: str) -> set[str]:
    """Names of the console scripts in a package's setup.py."""
    tree = ast.parse((SOURCES / package / "setup.py").read_text(encoding="utf-8"))
    for node in ast.walk(tree):
        if isinstance(node, ast.Dict):
            for key, value in zip(node.keys, node.values, strict=True):
                if isinstance(key, ast.Constant) and key.value == "console_scripts":
                    return {script.split("=")[0].strip() for script in ast.literal_eval(value)}
    raise AssertionError(f"no console_scripts in setup.py of {package}")


def test_every_node_is_an_executable_of_its_package(actions: list[Recorded]) -> None:
    nodes = [action for action in actions if isinstance(action, Node)]
    assert nodes
    for node in nodes:
        assert node.keywords["executable"] in executables_of(node.keywords["package"])


def test_one_node_that_ends_ends_all(actions: list[Recorded]) -> None:
    for node in actions:
        if isinstance(node, Node):
            assert isinstance(node.keywords["on_exit"], Shutdown)


def test_every_configuration_is_declared_and_the_parameter_file_is_there(actions: list[Recorded]) -> None:
    declared = {
        action.arguments[0]: action.keywords["default_value"]
        for action in actions
        if isinstance(action, DeclareLaunchArgument)
    }
    assert Path(declared["params_file"]).is_file()
    nodes = [node for node in actions if isinstance(node, Node)]
    used = {
        value.arguments[0]
        for node in nodes
        for given in (node.keywords["namespace"], *node.keywords["parameters"])
        for value in (given.values() if isinstance(given, dict) else [given])
        if isinstance(value, LaunchConfiguration)
    }
    assert used == set(declared)


def test_there_is_one_for_signing_seeing_learning_and_showing() -> None:
    assert [path.name for path in LAUNCH_FILES] == [
        "capture.launch.py",
        "console.launch.py",
        "retriever.launch.py",
        "signing.launch.py",
    ]
