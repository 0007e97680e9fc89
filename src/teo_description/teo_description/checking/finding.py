# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a check of a robot finds."""

from __future__ import annotations

from typing import NamedTuple


class Finding(NamedTuple):
    """One thing that was looked at."""

    ok: bool
    what: str
    """What should be so."""
    measured: str
    """What is so, with units."""
    field: str
    """The field of ``robot.yaml`` to look at where it is not."""
    needed: bool = True
    """Whether a robot that fails here is not fit to sign; else it is only told."""

    @property
    def mark(self) -> str:
        """``ok``, ``note`` or ``FAIL``."""
        return "ok" if self.ok else "FAIL" if self.needed else "note"
