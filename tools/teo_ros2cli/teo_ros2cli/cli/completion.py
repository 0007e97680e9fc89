# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Completing words in the shell: commands, verbs, options, packages, executables and interfaces."""

from __future__ import annotations

import argparse
from collections.abc import Iterable, Mapping

import argcomplete
from argcomplete.completers import BaseCompleter, FilesCompleter

from teo_ros2cli.cli.dispatch import Entry, Group, add_arguments
from teo_ros2cli.interfaces import INTERFACE_KINDS, interfaces
from teo_ros2cli.packages import executables, iter_package_names

# Arguments by name whose values are known without a graph. Names of topics and nodes are not completed: to
# find them takes a second at each press of the key, as there is no daemon that knows them already.
_KINDS: Mapping[str, tuple[str, ...]] = {
    "message_type": ("msg",),
    "topic_type": ("msg",),
    "service_type": ("srv",),
    "action_type": ("action",),
    "type": INTERFACE_KINDS,
}


def complete(commands: Mapping[str, Entry | Group]) -> None:
    """Print what the word under the cursor may become, as the shell asks for it, and exit."""
    parser = argparse.ArgumentParser(prog="ros2")
    _add_choices(parser, commands)
    argcomplete.autocomplete(parser, always_complete_options=False, default_completer=_Values())


def _add_choices(parser: argparse.ArgumentParser, entries: Mapping[str, Entry | Group]) -> None:
    choices = parser.add_subparsers()
    for name, entry in entries.items():
        chosen = choices.add_parser(name, help=entry.summary)
        if isinstance(entry, Group):
            _add_choices(chosen, entry.entries)
        else:
            add_arguments(chosen, entry)


class _Values(BaseCompleter):
    """The values that an argument may have; names of files where none are known."""

    def __call__(
        self,
        *,
        prefix: str,
        action: argparse.Action,
        parser: argparse.ArgumentParser,
        parsed_args: argparse.Namespace,
    ) -> Iterable[str]:
        if action.dest == "package_name":
            return iter_package_names()
        if action.dest == "executable_name":
            return [path.name for path in executables(parsed_args.package_name)]
        if kinds := _KINDS.get(action.dest):
            known = [(kind, *entry) for kind in kinds for entry in interfaces(kind).items()]
            return [f"{package}/{kind}/{name}" for kind, package, names in known for name in names]
        return FilesCompleter()(prefix, action=action, parser=parser, parsed_args=parsed_args)
