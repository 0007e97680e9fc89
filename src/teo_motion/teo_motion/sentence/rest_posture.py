# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Postures in which a robot waits: where sentences begin and end, and idle limbs go."""

from __future__ import annotations

from enum import StrEnum

from teo_common.arrays import Array
from teo_description.humanoid import Humanoid


class RestPosture(StrEnum):
    """Names of the postures."""

    HANGING = "hanging"
    """Arms hang; out of the way of every sign."""
    READY = "ready"
    """Forearms level, hands low before the body, as signers wait for their turn."""

    def of(self, humanoid: Humanoid) -> Array:
        """Positions of the commanded joints [rad]. Shape (joints,), read-only."""
        return humanoid.hanging if self is RestPosture.HANGING else humanoid.ready


# Ready, because a sentence takes 1.5 s less than from hanging arms and back, and because that is how signers
# wait when more is to come.
DEFAULT_REST = RestPosture.READY
