# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`discovery_server`: keeps a participant of the profile that `network server` has made, until told to end.

The wheels' `fast-discovery-server` does not start (a library is missing), so this takes its place.
"""

from __future__ import annotations

from collections.abc import Sequence

from rclpy.node import Node

from teo_common.node_process import run_node


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the server; a profile that is not in force ends it with the reason."""
    run_node(lambda: Node("discovery_server"), arguments)
