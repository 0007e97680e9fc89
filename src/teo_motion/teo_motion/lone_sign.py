# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""One sign as the planner plays it: from rest over the sign, slowed down where need be, back to rest."""

from __future__ import annotations

import math

import numpy as np

from teo_common.arrays import Array
from teo_motion.planner import DEFAULT_PERIOD, Planner
from teo_motion.sentence.plan import sample_at
from teo_signs.errors import LutError
from teo_signs.export import SignMotion
from teo_signs.sign import Sign
from teo_signs.tokens import Kind, Token

# Between two rows [s]: drives take no more than 50 set-points a second, and straight lines over more than 0.1
# s cut the corners of a sign by more than 2 deg.
_PERIOD_RANGE = (0.001, 0.1)

# Greatest motion of a joint that counts as standing still [rad]: the last digit of an entry.
_STILL = 1e-6


def sign_motion(planner: Planner, sign: Sign, *, period: float = DEFAULT_PERIOD) -> SignMotion:
    """Plan one sign from rest to rest.

    Args:
        planner: It must sign entries of any standing, or a word is spelled instead.
        sign: An entry of the planner's table.
        period: Time between two rows [s].

    Raises:
        LutError: The period is outside `_PERIOD_RANGE` ("bad_period").
        PlanError: The sign cannot be planned.
    """
    least, most = _PERIOD_RANGE
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
    humanoid = planner.limits.humanoid
    limbs = {limb: joints for limb, joints in humanoid.limbs.items() if not moving.isdisjoint(joints)}
    columns = humanoid.columns(joint for joints in limbs.values() for joint in joints)
    rows = math.ceil(plan.duration / period - 1e-9) + 1
    times: Array = np.arange(rows, dtype=np.float64) * period
    positions = sample_at(plan.motions, times).positions[:, columns].copy()
    positions[-1] = plan.positions[-1, columns]
    for array in (times, positions):
        array.setflags(write=False)
    timing = plan.timings[0]
    return SignMotion(
        sign=sign,
        limbs=limbs,
        times=times,
        positions=positions,
        start=timing.start,
        duration=timing.duration,
        stretch=timing.stretch,
    )
