# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`ros2 interface`: the definitions of messages, services and actions that are installed."""

from __future__ import annotations

import argparse
import sys

from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.interfaces import InterfaceName, definition_lines, interface_file, interfaces
from teo_ros2cli.packages import package_prefix

_TITLES = {"msg": "Messages", "srv": "Services", "action": "Actions"}
_OPTIONS = (("-m", "--only-msgs", "msg"), ("-s", "--only-srvs", "srv"), ("-a", "--only-actions", "action"))


def add_list_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `list`."""
    group = parser.add_mutually_exclusive_group()
    for short, long, kind in _OPTIONS:
        group.add_argument(
            short, long, dest="only", action="store_const", const=kind, help=f"Print out only {_TITLES[kind]}"
        )


def run_list(options: argparse.Namespace) -> int:
    """Print the names of all interfaces, by kind."""
    for kind, title in _TITLES.items():
        if options.only in (None, kind):
            print(f"{title}:")
            for package, names in interfaces(kind).items():
                for name in names:
                    print(f"    {package}/{kind}/{name}")
    return 0


def add_package_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `package`."""
    add_list_arguments(parser)
    parser.add_argument("package_name", help="Name of the ROS package (e.g. 'std_msgs')")


def run_package(options: argparse.Namespace) -> int:
    """Print the names of a package's interfaces."""
    package_prefix(options.package_name)
    for kind in [options.only] if options.only else _TITLES:
        for name in interfaces(kind).get(options.package_name, []):
            print(f"{options.package_name}/{kind}/{name}")
    return 0


add_packages_arguments = add_list_arguments


def run_packages(options: argparse.Namespace) -> int:
    """Print the packages that have interfaces."""
    kinds = [options.only] if options.only else list(_TITLES)
    for package in sorted({package for kind in kinds for package in interfaces(kind)}):
        print(package)
    return 0


def add_proto_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `proto`."""
    parser.add_argument("type", help="Show an interface prototype (e.g. 'std_msgs/msg/String')")
    parser.add_argument("--no-quotes", action="store_true", help="Print without quotes")


def run_proto(options: argparse.Namespace) -> int:
    """Print a message, request or goal with its default values as YAML, to be changed and passed on."""
    from teo_ros2cli.interfaces import interface_class
    from teo_ros2cli.messages.tree import dump, message_tree

    name = InterfaceName.parse(options.type)
    cls = interface_class(str(name), name.kind)
    message = {"msg": lambda: cls(), "srv": lambda: cls.Request(), "action": lambda: cls.Goal()}[name.kind]()
    quote = "" if options.no_quotes else '"'
    print(f"{quote}{dump(message_tree(message))}{quote}")
    return 0


def add_show_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `show`."""
    parser.add_argument(
        "type", help="Show an interface definition (e.g. 'std_msgs/msg/String'); '-' reads it from stdin"
    )
    group = parser.add_mutually_exclusive_group()
    group.add_argument(
        "--all-comments", action="store_true", help="Show all comments, of nested types as well"
    )
    group.add_argument("--no-comments", action="store_true", help="Show no comments or whitespace")


def run_show(options: argparse.Namespace) -> int:
    """Print a definition, nested types expanded.

    Raises:
        Ros2CliError: `invalid_type`, `package_not_found` or `interface_not_found`.
    """
    text = sys.stdin.readline().strip() if options.type == "-" else options.type
    name = _existing(text)
    for line in definition_lines(
        name, comments=not options.no_comments, nested_comments=options.all_comments
    ):
        print(line)
    return 0


def _existing(text: str) -> InterfaceName:
    """Return a name as it is or, without its kind, of the kind that exists."""
    if text.count("/") != 1:
        return InterfaceName.parse(text)
    for kind in _TITLES:
        name = InterfaceName.parse(text, kind)
        try:
            interface_file(name)
        except Ros2CliError:
            continue
        return name
    return InterfaceName.parse(text)
