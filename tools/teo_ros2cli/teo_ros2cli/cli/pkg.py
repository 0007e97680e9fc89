# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`ros2 pkg` and `ros2 run`: what is installed, and starting an executable in this process's place."""

from __future__ import annotations

import argparse
import os
import shlex
import shutil
import sys

from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.packages import executables, find_executable, iter_package_names, package_prefix


def add_executables_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `executables`."""
    parser.add_argument("package_name", nargs="?", help="The package name (default: all packages)")
    parser.add_argument("--full-path", action="store_true", help="Show the full path of each executable")


def run_executables(options: argparse.Namespace) -> int:
    """Print the executables of one package or of all."""
    packages = iter_package_names() if options.package_name is None else [options.package_name]
    for package in packages:
        for path in executables(package):
            print(path if options.full_path else f"{package} {path.name}")
    return 0


def run_list(options: argparse.Namespace) -> int:  # noqa: ARG001 - as every verb
    """Print the names of all packages."""
    for name in iter_package_names():
        print(name)
    return 0


def add_prefix_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `prefix`."""
    parser.add_argument("package_name", help="The package name")
    parser.add_argument("--share", action="store_true", help="Show share directory for the package")


def run_prefix(options: argparse.Namespace) -> int:
    """Print the prefix or the share directory of a package."""
    prefix = package_prefix(options.package_name)
    print(prefix / "share" / options.package_name if options.share else prefix)
    return 0


def add_xml_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `xml`."""
    parser.add_argument("package_name", help="The package name")
    parser.add_argument("-t", "--tag", help="The XML tag to output, e.g. version")


def run_xml(options: argparse.Namespace) -> int:
    """Print a package's manifest, or the text of one of its tags.

    Raises:
        Ros2CliError: `manifest_invalid` or `tag_not_found`.
    """
    import xml.etree.ElementTree as ElementTree

    path = package_prefix(options.package_name) / "share" / options.package_name / "package.xml"
    try:
        text = path.read_text(encoding="utf-8")
        root = ElementTree.fromstring(text)
    except (OSError, ElementTree.ParseError) as error:
        raise Ros2CliError("manifest_invalid", f"Manifest '{path}' cannot be read: {error}") from error
    if options.tag is None:
        print(text, end="")
        return 0
    found = root.findall(options.tag)
    if not found:
        raise Ros2CliError("tag_not_found", f"No '{options.tag}' tag found in '{path}'")
    for element in found:
        print(element.text or "")
    return 0


def add_run_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument(
        "--prefix",
        help="Prefix command, which should go before the executable. Command must be wrapped in quotes if it "
        "contains spaces (e.g. --prefix 'gdb -ex run --args').",
    )
    parser.add_argument("package_name", help="Name of the ROS package")
    parser.add_argument("executable_name", help="Name of the executable")
    parser.add_argument("argv", nargs=argparse.REMAINDER, help="Pass arbitrary arguments to the executable")


def run_run(options: argparse.Namespace) -> int:
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
