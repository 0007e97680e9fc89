# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`ros2 run`: starts an executable of a package in this process's place."""

from __future__ import annotations

import argparse
import os
import shlex
import shutil
import sys

from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.packages import find_executable


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument(
        "--prefix",
        help="Prefix command, which should go before the executable. Command must be wrapped in quotes if it "
        "contains spaces (e.g. --prefix 'gdb -ex run --args').",
    )
    parser.add_argument("package_name", help="Name of the ROS package")
    parser.add_argument("executable_name", help="Name of the executable")
    parser.add_argument("argv", nargs=argparse.REMAINDER, help="Pass arbitrary arguments to the executable")


def run(options: argparse.Namespace) -> int:
    """Replace this process by the executable, which so gets every signal and gives the exit status itself.

    Raises:
        Ros2CliError: `package_not_found`, `executable_not_found`, `executable_ambiguous`, `prefix_not_found`,
            or `executable_broken`.
    """
    path = find_executable(options.package_name, options.executable_name)
    command = [*_prefix(options.prefix), str(path), *options.argv]
    sys.stdout.flush()
    sys.stderr.flush()
    try:
        os.execv(command[0], command)
    except OSError as error:
        raise Ros2CliError(
            "executable_broken", f"'{command[0]}' cannot be started: {error.strerror}"
        ) from error


def _prefix(text: str | None) -> list[str]:
    if not text:
        return []
    try:
        words = shlex.split(text)
    except ValueError as error:
        raise Ros2CliError(
            "prefix_not_found", f"Prefix {text!r} cannot be read as a command: {error}"
        ) from error
    program = shutil.which(words[0]) if words else None
    if program is None:
        raise Ros2CliError("prefix_not_found", f"Prefix command '{text}' not found")
    return [program, *words[1:]]
