# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which nodes live: those whose topic has a publisher that is heard."""

from __future__ import annotations

from dataclasses import dataclass
from typing import get_args

from teo_common.diagnostics import DIAGNOSTICS_PERIOD, Level
from teo_console.protocol.to_page import Health, NodeRole, NodeState

ROLES: tuple[NodeRole, ...] = get_args(NodeRole)

# Silence after which a node counts as silent [s]. Diagnostics come once a second: two may be missed, half a
# second is for a loaded machine. Joint states come a hundred times a second; the executor waits as long.
_SILENCE: dict[NodeRole, float] = {
    "translator": 2.5 * DIAGNOSTICS_PERIOD,
    "executor": 2.5 * DIAGNOSTICS_PERIOD,
    "driver": 0.5,
}


@dataclass
class _Heard:
    """What is known of one node."""

    present: bool = False
    at: float | None = None
    level: Level = Level.OK
    message: str = ""


class Liveness:
    """Keeps when each node was heard last, and what it said of its health."""

    def __init__(self) -> None:
        """Begin with nobody there."""
        self._nodes = {role: _Heard() for role in ROLES}

    def seen(self, role: NodeRole, *, present: bool) -> None:
        """Enter whether the node's topic has a publisher."""
        self._nodes[role].present = present

    def heard(self, role: NodeRole, now: float) -> None:
        """Enter that the node has spoken."""
        self._nodes[role].at = now

    def diagnosed(self, role: NodeRole, level: Level, message: str) -> None:
        """Enter what the node says of its health."""
        self._nodes[role].level, self._nodes[role].message = level, message

    def report(self, now: float) -> tuple[Health, ...]:
        """How each node is."""
        return tuple(self._health(role, now) for role in ROLES)

    def _health(self, role: NodeRole, now: float) -> Health:
        node = self._nodes[role]
        quiet = 0.0 if node.at is None else max(now - node.at, 0.0)
        state: NodeState
        if not node.present:
            state = "missing"
        elif node.at is None or quiet > _SILENCE[role]:
            state = "silent"
        elif node.level is not Level.OK:
            state = "unwell"
        else:
            state = "alive"
        return Health(
            role=role,
            state=state,
            message=node.message if state == "unwell" else "",
            # Whole seconds: what is shown, and no reason to tell all pages the same thing ten times a second.
            quiet=float(int(quiet)) if state in ("silent", "missing") else 0.0,
        )
