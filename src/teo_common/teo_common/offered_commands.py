# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Commands that are run under one package's name and that another offers, if it is installed.

`ros2 run teo_sign_translator train` runs what `teo_sign_training` offers under the name `train`: a robot's
computer has the one and not the other.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from importlib.metadata import entry_points
from pathlib import Path
from typing import Any

#: Group of entry points under which packages offer commands.
COMMANDS = "teo.commands"


class NotOfferedError(Exception):
    """No installed package offers a command; the message says what to install."""


def offered_command(name: str) -> Callable[..., Any]:
    """Find the command that an installed package offers under a name.

    Raises:
        NotOfferedError: None does.
    """
    for point in entry_points(group=COMMANDS, name=name):
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
