# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What installed packages of this workspace bring: their data files, and commands that others run."""

from __future__ import annotations

import sys
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path
from typing import Any


def package_path(package: str, relative: str) -> Path:
    """Find a file or folder of a package's data.

    Args:
        package: Name of a package of this workspace, for example ``teo_signs``.
        relative: Path below the package's source folder, which is also the path below its share folder.

    Raises:
        FileNotFoundError: Neither the source tree nor the installed package holds it; the message names the
            places that were looked at.
    """
    looked: list[str] = []
    spec = find_spec(package)
    if spec is not None and spec.origin is not None:
        place = Path(spec.origin).resolve().parents[1] / relative
        if place.exists():
            return place
        looked.append(str(place))
    try:
        from ament_index_python.packages import PackageNotFoundError, get_package_share_directory
    except ImportError:
        pass  # no ROS in this environment: only the source tree is left
    else:
        try:
            place = Path(get_package_share_directory(package)) / relative
        except PackageNotFoundError:
            pass  # nothing of that name is installed
        else:
            if place.exists():
                return place
            looked.append(str(place))
    places = ", ".join(looked) or "the source tree and the installed packages"
    raise FileNotFoundError(f"{package}: expected {relative} in {places}; build the package again")


def installed_path(package: str, path: str) -> Path | None:
    """A file or folder that an installed Python package brings; None without the package.

    Args:
        package: As ``pip`` knows it.
        path: Below the folder that packages are installed in.
    """
    from importlib import metadata  # here: its parser of mail is a twentieth of a driver's start

    try:
        return Path(str(metadata.distribution(package).locate_file(path)))
    except metadata.PackageNotFoundError:
        return None


#: Group of entry points under which packages offer commands.
_COMMANDS = "teo.commands"


class NotOfferedError(Exception):
    """No installed package offers a command; the message says what to install."""


def offered_command(name: str) -> Callable[..., Any]:
    """Find the command that an installed package offers under a name.

    `ros2 run teo_sign_translator train` runs what `teo_sign_training` offers under the name `train`: a
    robot's computer has the one and not the other.

    Raises:
        NotOfferedError: None does.
    """
    from importlib.metadata import entry_points  # here: its parser of mail is a twentieth of a driver's start

    for point in entry_points(group=_COMMANDS, name=name):
        command: Callable[..., Any] = point.load()
        return command
    raise NotOfferedError(
        f"{name}: expected a package of the studio that offers it, found none; "
        "install the studio with `make setup`"
    )


def main() -> None:
    """Run the command by whose name this executable was called."""
    try:
        command = offered_command(Path(sys.argv[0]).name)
    except NotOfferedError as error:
        sys.exit(f"not_installed: {error}")
    command()
