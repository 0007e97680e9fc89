# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A sign as the motion that TEO would make of it, for programs that play motions and know nothing of signs.

A program that plays stored motions goes straight to the first position, with no look at what is in between;
a motion from rest to rest leaves nothing to hit on the way.
"""

from __future__ import annotations

from dataclasses import dataclass

from teo_common.arrays import Array
from teo_description import HEAD, LEFT_ARM, LEFT_HAND, RIGHT_ARM, RIGHT_HAND, TRUNK
from teo_signs.sign import Sign

# TEO's control boards, as their ports are named, and the joints of each in its order.
PARTS = {
    "head": HEAD,
    "trunk": TRUNK,
    "leftArm": LEFT_ARM,
    "rightArm": RIGHT_ARM,
    "leftHand": LEFT_HAND,
    "rightHand": RIGHT_HAND,
}


@dataclass(frozen=True, kw_only=True, eq=False)
class SignMotion:
    """A sign from rest to rest. Arrays are read-only.

    Attributes:
        sign: The entry.
        parts: Which of `PARTS` move, in their order; the others stay at rest.
        times: [s] from 0, evenly spaced. Shape (n,).
        positions: [rad], a column for each of `joints`. Shape (n, m).
        start: When the sign itself begins [s].
        duration: How long the sign itself lasts [s].
        stretch: Duration over the duration in the table [1].
    """

    sign: Sign
    parts: tuple[str, ...]
    times: Array
    positions: Array
    start: float
    duration: float
    stretch: float

    @property
    def joints(self) -> tuple[str, ...]:
        """Joints of the moving parts."""
        return tuple(joint for part in self.parts for joint in PARTS[part])

    def part(self, name: str) -> Array:
        """Positions of one moving part [rad]. Shape (n, joints of the part)."""
        columns = [self.joints.index(joint) for joint in PARTS[name]]
        return self.positions[:, columns]
