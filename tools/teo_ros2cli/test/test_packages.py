# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from pathlib import Path

import pytest

from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.interfaces import InterfaceName, interface_file, interfaces
from teo_ros2cli.packages import executables, find_executable, package_prefix


def add_package(prefix: Path, name: str, **programs: str) -> None:
    index = prefix / "share/ament_index/resource_index/packages"
    index.mkdir(parents=True, exist_ok=True)
    (index / name).touch()
    for program, folder in programs.items():
        path = prefix / "lib" / name / folder / program
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("#!/bin/sh\n")
        path.chmod(0o755)


@pytest.fixture
def overlay(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> tuple[Path, Path]:
    first, second = tmp_path / "first", tmp_path / "second"
    monkeypatch.setenv("AMENT_PREFIX_PATH", f"{first}:{second}:{tmp_path / 'gone'}")
    for prefix in (first, second):
        prefix.mkdir()
    return first, second


def test_the_first_prefix_wins(overlay: tuple[Path, Path]) -> None:
    for prefix in overlay:
        add_package(prefix, "both", tool="")
    assert package_prefix("both") == overlay[0]
    assert find_executable("both", "tool") == overlay[0] / "lib/both/tool"


def test_executables_are_found_in_subfolders_but_files_without_the_right_are_not(
    overlay: tuple[Path, Path],
) -> None:
    add_package(overlay[1], "tools", top="", deep="more/inside", secret=".hidden")
    (overlay[1] / "lib/tools/data.txt").write_text("no program")
    assert [path.name for path in executables("tools")] == ["deep", "top"]


def test_an_ambiguous_executable_is_refused_with_its_places(overlay: tuple[Path, Path]) -> None:
    add_package(overlay[0], "tools", same="a")
    add_package(overlay[0], "tools", same="b")
    with pytest.raises(
        Ros2CliError, match=r"Multiple executables found:\n- .*/a/same\n- .*/b/same"
    ) as caught:
        find_executable("tools", "same")
    assert caught.value.code == "executable_ambiguous"


@pytest.mark.usefixtures("overlay")
@pytest.mark.parametrize("name", ["missing", "", "../../etc", ".hidden", "a/b"])
def test_an_unknown_package_is_named(name: str) -> None:
    with pytest.raises(Ros2CliError, match=f"Package '{name}' not found"):
        package_prefix(name)


def test_a_missing_environment_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("AMENT_PREFIX_PATH")
    with pytest.raises(Ros2CliError, match="source the workspace"):
        package_prefix("std_msgs")


def test_installed_interfaces_are_listed_without_those_that_are_generated() -> None:
    assert "String" in interfaces("msg")["std_msgs"]
    assert "Trigger" in interfaces("srv")["std_srvs"]
    assert not any("_" in name for names in interfaces("action").values() for name in names)


def test_names_are_read_with_and_without_their_kind() -> None:
    assert InterfaceName.parse("std_msgs/String") == InterfaceName.parse("std_msgs/msg/String")
    assert str(InterfaceName.parse("std_srvs/Trigger", "srv")) == "std_srvs/srv/Trigger"
    assert interface_file(InterfaceName.parse("std_msgs/String")).name == "String.msg"
