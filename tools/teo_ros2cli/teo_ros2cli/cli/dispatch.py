# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Choosing a command and a verb by name, with the help texts that list them."""

from __future__ import annotations

import argparse
import importlib
import signal
import sys
import time
from collections.abc import Mapping, Sequence
from types import ModuleType
from typing import NamedTuple

from teo_ros2cli.errors import Ros2CliError

# Of a SIGINT rclpy's handler ends the context first; Python's KeyboardInterrupt comes within this time [s].
_INTERRUPTED = 0.1


class Entry(NamedTuple):
    """A command or a verb of one.

    Args:
        summary: One line on what it does.
        target: `module:verb`, a module of `teo_ros2cli.cli` with the functions `run_<verb>(options) -> int`
            and, unless there are no arguments, `add_<verb>_arguments(parser)`; or `module` alone, with `run`
            and `add_arguments`. It is loaded when it is called.
    """

    summary: str
    target: str


class Group(NamedTuple):
    """A command with verbs, or all commands: what it is for, and its entries by name."""

    summary: str
    entries: Mapping[str, Entry | Group]


def choose(program: str, kind: str, group: Group, words: Sequence[str]) -> int:
    """Run the entry that the first word names with the other words, and return the exit status.

    Args:
        program: The command line up to here, for the usage.
        kind: What the entries are called: `command` or `verb`.
        group: What there is to choose from.
        words: The rest of the command line.
    """
    entries = group.entries
    metavar = f"Call `{program} <{kind}> -h` for more detailed usage."
    parser = argparse.ArgumentParser(
        prog=program,
        description=group.summary,
        epilog=metavar,
        usage=f"{program} [-h] {metavar} ...",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    listing = parser.add_argument_group(f"{kind.capitalize()}s")
    width = max(map(len, entries)) + 2
    listing.description = "\n".join(f"{name.ljust(width)}{entry.summary}" for name, entry in entries.items())
    if not words or words[0] in ("-h", "--help"):
        parser.print_help()
        return 0
    name = words[0]
    if name not in entries:
        choices = ", ".join(map(repr, entries))
        parser.print_usage(sys.stderr)
        print(
            f"{program}: error: argument {metavar}: invalid choice: {name!r} (choose from {choices})",
            file=sys.stderr,
        )
        return 2
    chosen = entries[name]
    if isinstance(chosen, Group):
        return choose(f"{program} {name}", "verb", chosen, words[1:])
    return _call(f"{program} {name}", chosen, words[1:])


def add_arguments(parser: argparse.ArgumentParser, entry: Entry) -> None:
    """Add an entry's own arguments to a parser, if it has any."""
    module, verb = _target(entry)
    getattr(module, f"add_{verb}_arguments" if verb else "add_arguments", lambda _parser: None)(parser)


def _target(entry: Entry) -> tuple[ModuleType, str]:
    module, _, verb = entry.target.partition(":")
    return importlib.import_module(f"teo_ros2cli.cli.{module}"), verb


def _call(program: str, entry: Entry, words: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog=program, description=entry.summary)
    add_arguments(parser, entry)
    module, verb = _target(entry)
    run = getattr(module, f"run_{verb}" if verb else "run")
    try:
        return int(run(parser.parse_args(words)))
    except Ros2CliError as error:
        print(error, file=sys.stderr)
        return 1
    except Exception as error:
        # Loading rclpy costs a tenth of a second: its exception is told by its name.
        if type(error).__name__ == "ExternalShutdownException":
            time.sleep(_INTERRUPTED)
            return 128 + int(signal.SIGTERM)
        raise
