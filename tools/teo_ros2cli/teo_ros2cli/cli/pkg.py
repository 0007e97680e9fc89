# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`ros2 pkg`: what is installed."""

from __future__ import annotations

import argparse
import xml.etree.ElementTree as ElementTree

from teo_ros2cli.cli.dispatch import Entry
from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.packages import executables, iter_package_names, package_prefix

VERBS = {
    "executables": Entry(__name__, "Output a list of package specific executables", "executables"),
    "list": Entry(__name__, "Output a list of available packages", "list"),
    "prefix": Entry(__name__, "Output the prefix path of a package", "prefix"),
    "xml": Entry(__name__, "Output the XML of the package manifest or a specific tag", "xml"),
}


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
