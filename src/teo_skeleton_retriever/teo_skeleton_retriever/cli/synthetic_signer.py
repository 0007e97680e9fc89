# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`synthesize` and `sensor_study`, which the package `teo_synthetic_signer` provides if installed."""

from __future__ import annotations

import sys
from importlib.metadata import entry_points

# The group of entry points under which other packages offer commands of this one.
COMMANDS = "teo_skeleton_retriever.commands"


def synthesize() -> None:
    """Run `synthesize` of `teo_synthetic_signer`."""
    _run("synthesize")


def sensor_study() -> None:
    """Run `sensor_study` of `teo_synthetic_signer`."""
    _run("sensor_study")


def _run(name: str) -> None:
    """Run a command that another package offers; without that package, say what to install."""
    for command in entry_points(group=COMMANDS, name=name):
        command.load()()
        return
    sys.exit(
        f"{name}: expected the package teo_synthetic_signer, which provides it; build it beside this one"
    )
