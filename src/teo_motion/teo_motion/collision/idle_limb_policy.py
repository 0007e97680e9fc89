"""What a limb does while no sign uses it.

* Head, trunk and hands go to rest at once, in the time that takes, and stay there until the way to their
  next posture begins. A hand that is idle for too short a time to reach rest goes to its next shape instead.
* An arm goes to rest only if it can stay there for a while (`SigningStyle.arm_rest`); otherwise it waits
  where its last sign left it.
* After its last sign every limb goes to rest.
* An arm that would be in the way of a sign waits until that sign's turn, and is at rest before it begins.

A limb on its way does not hold up the signs meanwhile: it passes their stations freely.
"""

from __future__ import annotations

from collections.abc import Collection

import numpy as np
from numpy.typing import NDArray

from teo_motion.sentence.composition import ARMS, LIMBS, REST, Composition, IdleSpan
from teo_motion.trajectory.limits import MotionLimits


def settle_idle_limbs(
    composition: Composition,
    *,
    times: NDArray[np.float64],
    limits: MotionLimits,
    arm_rest: float,
    cleared: Collection[tuple[int, int]] = (),
) -> NDArray[np.float64]:
    """Fix the free joints of a composition.

    Args:
        composition: The sentence.
        times: When each station is reached, as far as the limbs in use ask for it [s]. Shape (n,).
        limits: Limits of the joints.
        arm_rest: Least time at rest that is worth an arm's way there and back [s].
        cleared: Arms that must be out of the way, each with the station at which it must be at rest.

    Returns:
        The targets with idle limbs in place; still NaN where a limb is on its way. Shape (n, 28).
    """
    targets = composition.targets.copy()
    final = len(targets) - 1
    for span in composition.idle:
        columns = list(LIMBS[span.limb])
        before = targets[span.first, columns]
        wanted = [
            station for limb, station in cleared if limb == span.limb and span.first < station < span.last
        ]
        if wanted:
            targets[span.first + 1 : min(wanted), columns] = before
            targets[min(wanted) : span.last, columns] = REST[columns]
            continue
        way = float(np.max(fastest_moves(REST[columns] - before, columns, limits)))
        between = slice(span.first + 1, span.last)
        arrived = between.start + int(np.searchsorted(times[between], times[span.first] + way))
        if span.limb in ARMS and span.last != final and not _worth_it(span, arrived, times, arm_rest):
            targets[between, columns] = before
        else:
            targets[arrived : span.last, columns] = REST[columns]
    return targets


def _worth_it(span: IdleSpan, arrived: int, times: NDArray[np.float64], arm_rest: float) -> bool:
    return arrived < span.last and bool(times[span.last - 1] - times[arrived] >= arm_rest)


def fastest_moves(
    distances: NDArray[np.float64], columns: list[int], limits: MotionLimits
) -> NDArray[np.float64]:
    """Least times in which joints move from rest to rest under limits of velocity, acceleration and jerk.

    Symmetric S-curve: L. Biagiotti, C. Melchiorri, "Trajectory Planning for Automatic Machines and Robots"
    (2008), 3.4.

    Args:
        distances: Ways to go, of either sign [rad]. Shape (m,).
        columns: The joints of `limits` that go them.
        limits: Limits of the joints.

    Returns:
        Durations [s]. Shape (m,).
    """
    way = np.abs(distances)
    speed, push, jerk = (values[columns] for values in (limits.velocity, limits.acceleration, limits.jerk))
    # With a phase of constant velocity; then with one of constant acceleration; then with neither.
    ramp = np.where(speed * jerk >= push**2, speed / push + push / jerk, 2.0 * np.sqrt(speed / jerk))
    without_cruise = np.where(
        way >= 2.0 * push**3 / jerk**2,
        push / jerk + np.sqrt((push / jerk) ** 2 + 4.0 * way / push),
        np.cbrt(32.0 * way / jerk),
    )
    return np.where(way >= speed * ramp, ramp + way / speed, without_cruise)
