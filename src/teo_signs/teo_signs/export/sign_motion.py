# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A sign as the motion that its robot makes of it, for programs that play motions and know no signs.

A program that plays stored motions goes straight to the first position, with no look at what is in between;
a motion from rest to rest leaves nothing to hit on the way.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from teo_common.arrays import Array
from teo_signs.sign import Sign


@dataclass(frozen=True, kw_only=True, eq=False)
class SignMotion:
    """A sign from rest to rest. Arrays are read-only.

    Attributes:
        sign: The entry.
        limbs: Joints of each of the robot's limbs that moves, in its order; the others stay at rest.
        times: [s] from 0, evenly spaced. Shape (n,).
        positions: [rad], a column for each of `joints`. Shape (n, m).
        start: When the sign itself begins [s].
        duration: How long the sign itself lasts [s].
        stretch: Duration over the duration in the table [1].
    """

    sign: Sign
    limbs: Mapping[str, tuple[str, ...]]
    times: Array
    positions: Array
    start: float
    duration: float
    stretch: float

    @property
    def joints(self) -> tuple[str, ...]:
        """Joints of the moving limbs."""
        return tuple(joint for joints in self.limbs.values() for joint in joints)

    @property
    def description(self) -> str:
        """What it is of and what it was made for, in a sentence."""
        sign = self.sign
        return (
            f"{sign.kind} of {sign.language} for {sign.robot}, {sign.provenance.standing}; from rest to "
            f"rest, the sign from {self.start:.2f} s for {self.duration:.2f} s "
            f"({self.stretch:.2f} times its time)"
        )

    def limb(self, name: str) -> Array:
        """Positions of one moving limb [rad]. Shape (n, joints of the limb)."""
        columns = [self.joints.index(joint) for joint in self.limbs[name]]
        return self.positions[:, columns]
