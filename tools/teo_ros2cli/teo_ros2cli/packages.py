# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Installed packages and their executables, from the ament index. Needs no ROS running."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from teo_ros2cli.errors import Ros2CliError

INDEX = Path("share/ament_index/resource_index")


def prefixes() -> list[Path]:
    """Return the existing directories of AMENT_PREFIX_PATH, the first one winning where names clash.

    Raises:
        Ros2CliError: `no_environment`, the variable is empty: no ROS 2 workspace is sourced.
    """
    value = os.environ.get("AMENT_PREFIX_PATH", "")
    if not value.strip(os.pathsep):
        raise Ros2CliError(
            "no_environment",
            "Environment variable 'AMENT_PREFIX_PATH' is not set or empty: source the workspace first",
        )
    return [Path(entry) for entry in value.split(os.pathsep) if entry and Path(entry).is_dir()]


def resources(kind: str) -> dict[str, Path]:
    """Map the names registered under one kind of the ament index to their prefixes."""
    found: dict[str, Path] = {}
    for prefix in prefixes():
        folder = prefix / INDEX / kind
        if folder.is_dir():
            for entry in folder.iterdir():
                if not entry.name.startswith(".") and entry.is_file():
                    found.setdefault(entry.name, prefix)
    return found


def package_prefix(package: str) -> Path:
    """Return the prefix that a package is installed in.

    Raises:
        Ros2CliError: `package_not_found`.
    """
    # The name is looked up as a file: an odd one must not leave the index.
    if package and "/" not in package and not package.startswith("."):
        for prefix in prefixes():
            if (prefix / INDEX / "packages" / package).is_file():
                return prefix
    raise Ros2CliError("package_not_found", f"Package '{package}' not found")


def executables(package: str) -> list[Path]:
    """Return the executable files of a package, anywhere under its `lib/<package>`, sorted by name."""
    root = package_prefix(package) / "lib" / package
    found: list[Path] = []
    for folder, subfolders, names in os.walk(root):
        subfolders[:] = [name for name in subfolders if not name.startswith(".")]
        for name in names:
            path = Path(folder, name)
            if os.access(path, os.X_OK) and path.is_file():
                found.append(path)
    return sorted(found, key=lambda path: (path.name, str(path)))


def find_executable(package: str, executable: str) -> Path:
    """Return the one executable file of that name in a package.

    Raises:
        Ros2CliError: `package_not_found`, `executable_not_found` or `executable_ambiguous`.
    """
    matches = [path for path in executables(package) if path.name == executable]
    if not matches:
        raise Ros2CliError("executable_not_found", "No executable found")
    if len(matches) > 1:
        listing = "".join(f"\n- {path}" for path in matches)
        raise Ros2CliError("executable_ambiguous", f"Multiple executables found:{listing}")
    return matches[0]


def iter_package_names() -> Iterator[str]:
    """Yield the names of all installed packages, sorted."""
    yield from sorted(resources("packages"))
