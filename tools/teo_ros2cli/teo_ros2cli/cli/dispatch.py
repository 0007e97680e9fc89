# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Choosing a command and a verb by name, with the help texts that list them."""

from __future__ import annotations

import argparse
import importlib
import signal
import sys
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from teo_ros2cli.errors import Ros2CliError


class Entry(NamedTuple):
    """Something to choose.

    Args:
        module: The module that does it. It has either `VERBS`, the entries to choose from next, or
            `run(options) -> int` and, unless there are no arguments, `add_arguments(parser)`.
        summary: One line on what it does.
        verb: For a module with several small verbs: the functions are `run_<verb>` and
            `add_<verb>_arguments`.
    """

    module: str
    summary: str
    verb: str = ""


def choose(
    program: str, description: str, kind: str, entries: Mapping[str, Entry], words: Sequence[str]
) -> int:
    """Run the entry that the first word names with the other words, and return the exit status.

    Args:
        program: The command line up to here, for the usage.
        description: What the program is for.
        kind: What the entries are called: `command` or `verb`.
        entries: By name.
        words: The rest of the command line.
    """
    metavar = f"Call `{program} <{kind}> -h` for more detailed usage."
    parser = argparse.ArgumentParser(
        prog=program,
        description=description,
        epilog=metavar,
        usage=f"{program} [-h] {metavar} ...",
        formatter_class=_ListingFormatter,
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
    return _call(f"{program} {name}", entries[name], list(words[1:]))


class _ListingFormatter(argparse.HelpFormatter):
    """Keeps the line breaks of the listing."""

    def _fill_text(self, text: str, width: int, indent: str) -> str:
        if "\n" in text:
            return "".join(f"{indent}{line}\n" for line in text.splitlines()).rstrip("\n")
        return super()._fill_text(text, width, indent)


def add_arguments(parser: argparse.ArgumentParser, entry: Entry) -> None:
    """Add an entry's own arguments to a parser, if it has any."""
    add = f"add_{entry.verb}_arguments" if entry.verb else "add_arguments"
    getattr(importlib.import_module(entry.module), add, lambda _parser: None)(parser)


def verbs_of(entry: Entry) -> Mapping[str, Entry] | None:
    """Return what there is to choose from after an entry; None if it is chosen to its end."""
    verbs: Mapping[str, Entry] | None = getattr(importlib.import_module(entry.module), "VERBS", None)
    return None if entry.verb else verbs


def _call(program: str, entry: Entry, words: list[str]) -> int:
    verbs = verbs_of(entry)
    if verbs is not None:
        return choose(program, entry.summary, "verb", verbs, words)
    parser = argparse.ArgumentParser(prog=program, description=entry.summary)
    add_arguments(parser, entry)
    run = getattr(importlib.import_module(entry.module), f"run_{entry.verb}" if entry.verb else "run")
    try:
        return int(run(parser.parse_args(words)))
    except Ros2CliError as error:
        print(error, file=sys.stderr)
        return 1
    except Exception as error:
        # Loading rclpy costs a tenth of a second: its exception is told by its name.
        if type(error).__name__ == "ExternalShutdownException":
            return 128 + int(signal.SIGTERM)
        raise
