# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a limb does while no sign uses it.

* Head, trunk and hands go to rest at once, in the time that takes, and stay there until the way to their
  next posture begins. A hand that is idle for too short a time to reach rest goes to its next shape instead.
* An arm goes to rest only if it can stay there for a while (`SigningStyle.arm_rest`); otherwise it waits
  where its last sign left it.
* After its last sign every limb goes to rest.
* An arm that would be in the way of a sign waits until that sign's turn, and is at rest before it begins.

A limb on its way does not hold up the signs meanwhile: it passes their waypoints freely.
"""

from __future__ import annotations

from collections.abc import Collection

import numpy as np
from numpy.typing import NDArray

from teo_motion.sentence.composition import ARMS, LIMBS, REST, Composition, IdleSpan
from teo_motion.sentence.route import Route
from teo_motion.trajectory.limits import MotionLimits


def settle_idle_limbs(
    composition: Composition,
    *,
    times: NDArray[np.float64],
    limits: MotionLimits,
    arm_rest: float,
    cleared: Collection[tuple[int, int]] = (),
) -> Route:
    """Fix the free joints of a composition.

    Args:
        composition: The sentence.
        times: When each waypoint is reached, as far as the limbs in use ask for it [s]. Shape (n,).
        limits: Limits of the joints.
        arm_rest: Least time at rest for which an idle arm goes there and back [s].
        cleared: Arms that must be out of the way, each with the waypoint at which it must be at rest.

    Returns:
        The composition with idle limbs in place; positions are still NaN where a limb is on its way.
    """
    targets = composition.targets.copy()
    final = len(targets) - 1
    for span in composition.idle:
        columns = list(LIMBS[span.limb])
        before = targets[span.first, columns]
        wanted = [
            waypoint for limb, waypoint in cleared if limb == span.limb and span.first < waypoint < span.last
        ]
        if wanted:
            targets[span.first + 1 : min(wanted), columns] = before
            targets[min(wanted) : span.last, columns] = REST[columns]
            continue
        takes = float(np.max(limits.least_times(REST[columns] - before, columns)))
        between = slice(span.first + 1, span.last)
        arrived = between.start + int(np.searchsorted(times[between], times[span.first] + takes))
        if span.limb in ARMS and span.last != final and not _worth_it(span, arrived, times, arm_rest):
            targets[between, columns] = before
        else:
            targets[arrived : span.last, columns] = REST[columns]
    return Route(
        targets=targets,
        nominal=composition.nominal,
        strokes=composition.strokes,
        spans=composition.spans,
        start=composition.start,
    )


def _worth_it(span: IdleSpan, arrived: int, times: NDArray[np.float64], arm_rest: float) -> bool:
    return arrived < span.last and bool(times[span.last - 1] - times[arrived] >= arm_rest)
