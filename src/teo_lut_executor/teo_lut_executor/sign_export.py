"""A sign as the motion that TEO would make of it, for programs that play motions and know nothing of signs.

What is exported is what the planner plays: from rest over the sign, slowed down where TEO is too slow for it,
back to rest. A program that plays stored motions goes straight to the first position, with no look at
what is in between; from rest to rest there is nothing to hit on the way.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from teo_description import HEAD, LEFT_ARM, LEFT_HAND, RIGHT_ARM, RIGHT_HAND, TRUNK
from teo_lut_executor.lut_error import LutError
from teo_lut_executor.plan import sample_at
from teo_lut_executor.planner import DEFAULT_PERIOD, Planner
from teo_lut_executor.sign import Sign
from teo_lut_executor.tokens import Kind, Token

Array = NDArray[np.float64]

PARTS = {
    "head": HEAD,
    "trunk": TRUNK,
    "leftArm": LEFT_ARM,
    "rightArm": RIGHT_ARM,
    "leftHand": LEFT_HAND,
    "rightHand": RIGHT_HAND,
}
"""TEO's control boards, as their ports are named, and the joints of each in its order."""

PERIOD_RANGE = (0.001, 0.1)
"""[s] Between two rows: drives take no more than 50 set-points a second, and straight lines over more than
0.1 s cut the corners of a sign by more than 2 deg."""

_STILL = 1e-6
"""[rad] A joint that moves less than this, the last digit of an entry, stands still."""


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


def sign_motion(planner: Planner, sign: Sign, *, period: float = DEFAULT_PERIOD) -> SignMotion:
    """Plan one sign from rest to rest.

    Args:
        planner: It must sign entries of any standing, or a word is spelled instead.
        sign: An entry of the planner's table.
        period: Time between two rows [s].

    Raises:
        LutError: The period is outside `PERIOD_RANGE` ("bad_period").
        PlanError: The sign cannot be planned.
    """
    least, most = PERIOD_RANGE
    if not least <= period <= most:
        raise LutError("bad_period", f"period: expected {least:g} to {most:g} s, got {period}")
    plan = planner.plan([Token(gloss=sign.gloss, kind=Kind[sign.kind.upper()])])
    if len(plan.timings) != 1 or plan.timings[0].token.gloss != sign.gloss:
        raise LutError(
            "not_signed", f"{sign.gloss}: expected a planner that signs every standing, got the word spelled"
        )
    moving = {
        name
        for name, column in zip(plan.names, np.ptp(plan.positions, axis=0).tolist(), strict=True)
        if column > _STILL
    }
    parts = tuple(part for part, joints in PARTS.items() if not moving.isdisjoint(joints))
    columns = [plan.names.index(joint) for part in parts for joint in PARTS[part]]
    rows = math.ceil(plan.duration / period - 1e-9) + 1
    times: Array = np.arange(rows, dtype=np.float64) * period
    positions = sample_at(plan.motions, times).positions[:, columns].copy()
    positions[-1] = plan.positions[-1, columns]
    for array in (times, positions):
        array.setflags(write=False)
    timing = plan.timings[0]
    return SignMotion(
        sign=sign,
        parts=parts,
        times=times,
        positions=positions,
        start=timing.start,
        duration=timing.duration,
        stretch=timing.stretch,
    )
