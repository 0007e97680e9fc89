"""`ros2 daemon`: for scripts that call it; this command looks at the graph itself, and needs no daemon."""

from __future__ import annotations

import argparse
from collections.abc import Sequence

from teo_ros2cli.cli.dispatch import Entry, choose

VERBS = {
    "start": Entry(__name__, "Start the daemon: there is none to start", "start"),
    "status": Entry(__name__, "Output the status of the daemon", "status"),
    "stop": Entry(__name__, "Stop the daemon: there is none to stop", "stop"),
}


def run_words(words: Sequence[str]) -> int:
    """Run the verb that the words name."""
    return choose("ros2 daemon", "Various daemon related sub-commands", "verb", VERBS, words)


def add_start_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `start`: there are none."""


def run_start(_options: argparse.Namespace) -> int:
    """Say that there is nothing to start."""
    print("There is no daemon to start: every command discovers the graph itself")
    return 0


def add_status_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `status`: there are none."""


def run_status(_options: argparse.Namespace) -> int:
    """Say that no daemon runs."""
    print("The daemon is not running")
    return 0


def add_stop_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `stop`: there are none."""


def run_stop(_options: argparse.Namespace) -> int:
    """Say that no daemon runs."""
    print("The daemon is not running")
    return 0
