# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`ros2 daemon`: for scripts that call it; this command looks at the graph itself, and needs no daemon."""

from __future__ import annotations

import argparse

from teo_ros2cli.cli.dispatch import Entry

VERBS = {
    "start": Entry(__name__, "Start the daemon: there is none to start", "start"),
    "status": Entry(__name__, "Output the status of the daemon", "status"),
    "stop": Entry(__name__, "Stop the daemon: there is none to stop", "status"),
}


def run_start(_options: argparse.Namespace) -> int:
    """Say that there is nothing to start."""
    print("There is no daemon to start: every command discovers the graph itself")
    return 0


def run_status(_options: argparse.Namespace) -> int:
    """Say that no daemon runs."""
    print("The daemon is not running")
    return 0
