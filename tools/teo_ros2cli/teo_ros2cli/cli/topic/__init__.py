# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The verbs of `ros2 topic`: a module each, loaded when called."""

from __future__ import annotations

from teo_ros2cli.cli.dispatch import Entry

VERBS = {
    "bw": Entry(f"{__name__}.measuring", "Display bandwidth used by topic", "bw"),
    "delay": Entry(f"{__name__}.measuring", "Display delay of topic from timestamp in header", "delay"),
    "echo": Entry(f"{__name__}.echo", "Output messages from a topic"),
    "find": Entry(f"{__name__}.listing", "Output a list of available topics of a given type", "find"),
    "hz": Entry(f"{__name__}.hz", "Print the average receiving rate to screen"),
    "info": Entry(f"{__name__}.info", "Print information about a topic"),
    "list": Entry(f"{__name__}.listing", "Output a list of available topics"),
    "pub": Entry(f"{__name__}.pub", "Publish a message to a topic"),
    "type": Entry(f"{__name__}.listing", "Print a topic's type", "type"),
}
