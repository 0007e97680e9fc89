# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a limb does while no sign uses it.

* Head, trunk and hands go to rest at once, in the time that takes. A hand that is idle for too short a time
  to reach rest goes to its next shape instead.
* An arm goes to rest only if it can stay there for a while (`SigningStyle.arm_rest`); otherwise it waits
  where its last sign left it.
* A limb that is needed again sets out in time, while the signs before its own are still made: people raise
  the next hand so, and it is not read as a part of the sign that the other hand makes.
* After its last sign every limb goes to rest.
* An arm that would be in the way of a sign waits until that sign's turn, and hangs before it begins, until
  it is needed.

A limb on its way does not hold up the signs meanwhile: it passes their waypoints freely.
"""

from __future__ import annotations

from collections.abc import Collection

import numpy as np
from numpy.typing import NDArray

from teo_common.arrays import Array
from teo_motion.sentence.composition import ARMS, Composition, IdleSpan, Route
from teo_motion.trajectory.limits import MotionLimits


def settle_idle_limbs(
    composition: Composition,
    *,
    times: NDArray[np.float64],
    limits: MotionLimits,
    arm_rest: float,
    cleared: Collection[tuple[str, int]] = (),
) -> Route:
    """Fix the free joints of a composition.

    Args:
        composition: The sentence.
        times: When each waypoint is reached, as far as the limbs in use ask for it [s]. Shape (n,).
        limits: Limits of the joints.
        arm_rest: Least time at rest for which an idle arm goes there and back [s].
        cleared: Arms that must be out of the way, each with the waypoint at which it must hang.

    Returns:
        The composition with idle limbs in place; positions are still NaN where a limb is on its way.
    """
    targets = composition.targets.copy()
    hanging, limbs = limits.humanoid.hanging, limits.humanoid.limb_columns
    for span in composition.idle:
        columns = limbs[span.limb]
        wanted = [
            waypoint for limb, waypoint in cleared if limb == span.limb and span.first < waypoint < span.last
        ]
        if wanted:
            targets[span.first + 1 : min(wanted), columns] = targets[span.first, columns]
            targets[min(wanted) : span.last, columns] = hanging[columns]
        else:
            place, still = _waits(
                span, targets[:, columns], composition.rest[columns], times, limits, arm_rest
            )
            targets[still, columns] = place
    return Route(
        targets=targets,
        nominal=composition.nominal,
        strokes=composition.strokes,
        spans=composition.spans,
        start=composition.start,
    )


def _waits(
    span: IdleSpan, targets: Array, rest: Array, times: Array, limits: MotionLimits, arm_rest: float
) -> tuple[Array, slice]:
    """Where an idle limb waits, and at which waypoints it is there.

    Args:
        span: Where it is idle.
        targets: Waypoints of its joints [rad]. Shape (n, m).
        rest: Their rest [rad]. Shape (m,).
        times: See `settle_idle_limbs`, as the others.
        limits: See there.
        arm_rest: See there.
    """
    columns = limits.humanoid.limb_columns[span.limb]
    before, after = targets[span.first], targets[span.last]
    between = times[span.first + 1 : span.last]

    def arrived() -> int:
        takes = limits.least_times(rest - before, columns).max()
        return span.first + 1 + int(np.searchsorted(between, times[span.first] + takes))

    def leaves(place: Array) -> int:
        takes = limits.least_times(after - place, columns).max()
        return span.first + int(np.searchsorted(between, times[span.last] - takes, side="right"))

    if span.last == len(targets) - 1:
        return rest, slice(arrived(), span.last)
    first, last = arrived(), leaves(rest)
    if span.limb in ARMS and (first >= span.last or times[last] - times[first] < arm_rest):
        return before, slice(span.first + 1, leaves(before) + 1)
    return rest, slice(first, last + 1)
