# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Installed packages, their executables and interfaces, from the ament index. Needs no ROS running."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

from teo_ros2cli.errors import Ros2CliError

_INDEX = Path("share/ament_index/resource_index")
INTERFACE_KINDS = ("msg", "srv", "action")


class InterfaceName(NamedTuple):
    """Name of an interface: package, kind (`msg`, `srv`, `action`) and type, as in `std_msgs/msg/String`."""

    package: str
    kind: str
    type: str

    def __str__(self) -> str:
        return f"{self.package}/{self.kind}/{self.type}"

    @classmethod
    def parse(cls, text: str, default_kind: str = "msg") -> InterfaceName:
        """Read `pkg/kind/Type`, or `pkg/Type` with the kind that the caller expects.

        Raises:
            Ros2CliError: `invalid_type`, the text is not of either form.
        """
        parts = text.split("/")
        if len(parts) == 2:
            parts.insert(1, default_kind)
        if (
            len(parts) != 3
            or not all(part.isidentifier() for part in parts)
            or parts[1] not in INTERFACE_KINDS
        ):
            raise Ros2CliError(
                "invalid_type",
                f"The passed {_KIND_WORDS[default_kind]} type is invalid: expected a name such as "
                f"'{_EXAMPLES[default_kind]}', got {text!r}",
            )
        return cls(*parts)


_KIND_WORDS = {"msg": "message", "srv": "service", "action": "action"}
_EXAMPLES = {
    "msg": "std_msgs/msg/String",
    "srv": "std_srvs/srv/Trigger",
    "action": "example_interfaces/action/Fibonacci",
}


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
        folder = prefix / _INDEX / kind
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
            if (prefix / _INDEX / "packages" / package).is_file():
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


def interfaces(kind: str) -> Mapping[str, list[str]]:
    """Map each package that has interfaces of a kind (`msg`, `srv`, `action`) to its sorted type names."""
    found: dict[str, list[str]] = {}
    for package, prefix in sorted(resources("rosidl_interfaces").items()):
        listing = (prefix / _INDEX / "rosidl_interfaces" / package).read_text(encoding="utf-8")
        names = {
            Path(line).stem
            for line in listing.splitlines()
            if line.startswith(f"{kind}/") and Path(line).suffix in (f".{kind}", ".idl")
        }
        # Services and actions generate messages of their own; these are not interfaces that someone wrote.
        names = {name for name in names if "_" not in name}
        if names:
            found[package] = sorted(names)
    return found


def interface_file(name: InterfaceName) -> Path:
    """Return the file that defines an interface, the `.msg`, `.srv` or `.action` text before the `.idl`.

    Raises:
        Ros2CliError: `package_not_found`, or `interface_not_found`.
    """
    folder = package_prefix(name.package) / "share" / name.package / name.kind
    for suffix in (name.kind, "idl"):
        path = folder / f"{name.type}.{suffix}"
        if path.is_file():
            return path
    raise Ros2CliError(
        "interface_not_found", f"Unknown interface '{name}': there is no {name.type} in {folder}"
    )


def iter_package_names() -> Iterator[str]:
    """Yield the names of all installed packages, sorted."""
    yield from sorted(resources("packages"))
