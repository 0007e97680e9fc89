# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How far and how fast joints go."""

from __future__ import annotations

from dataclasses import dataclass

from teo_common.arrays import Array


@dataclass(frozen=True, kw_only=True, eq=False)
class JointLimits:
    """Limits of some joints, in the order of `names`; the arrays are read-only.

    Attributes:
        names: Joint names.
        lower, upper: Position limits [rad]. Shape (n,).
        velocity: Greatest speed [rad/s]. Shape (n,).
    """

    names: tuple[str, ...]
    lower: Array
    upper: Array
    velocity: Array
