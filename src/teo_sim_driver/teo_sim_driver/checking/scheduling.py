# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Whether a checked trajectory can be executed from where the robot is, exactly as it is given, and when."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from teo_description import JointLimits
from teo_sim_driver.checking.reading import Points
from teo_sim_driver.checking.validation import (
    Codes,
    check_between,
    first_place,
    of_joints,
    per_joint,
    through,
)
from teo_sim_driver.motion.bezier import FloatArray
from teo_sim_driver.motion.path_time import SECOND
from teo_sim_driver.motion.trajectory import MotionState, Trajectory
from teo_sim_driver.rules import REST_VELOCITY, Refusal, Rules, TrajectoryError

# A point of a late trajectory that is due sooner is passed like those before it [s]: half of the usual step,
# in which joints that are a little beside the path, as the sender could not know, cannot be back on it.
_SOONEST = 0.005

# How much a start may be shifted to where the robot is as the first point says [s]: two joint states and the
# way of a message.
_LONGEST_SHIFT = 0.025

# A robot that is slower than this does not tell by its place what time it is [rad/s].
_SLOW = 0.02

# Newton's method is there after two steps, or four where the path is executed at half the speed.
_STEPS_TO_MEET = 4

_START = Codes(Refusal.START_LEAVES_LIMITS, Refusal.START_TOO_FAST, Refusal.START_TOO_FAST)


class Scheduled(NamedTuple):
    """A trajectory that was found good, and when it starts."""

    delay: float
    """From now to the start [s], >= 0."""
    trajectory: Trajectory
    """From the robot's state at the start to the last point; of the message's joints, in order."""


def schedule(
    points: Points,
    *,
    limits: JointLimits,
    rules: Rules,
    now: int,
    state_in: Callable[[float], MotionState],
) -> Scheduled:
    """Make checked points ready to be executed from where the robot is; takes little time.

    The trajectory begins at the robot's own state at the start. Points that are due at the start or before
    are not executed: they say where the sender believes the robot to be, and are compared with where it is.

    Args:
        points: As `check` returned them.
        limits: Of the commanded joints, in the driver's order.
        rules: Limits on the message.
        now: [ns], on the clock of the message's stamp.
        state_in: The state of all commanded joints in so many seconds from now, if nothing new came.

    Raises:
        TrajectoryError: with one reason, the first found; nothing of the message may be executed.
    """
    delay, passed = _schedule(points, now, rules)
    if points.times[0] == 0 and passed == 0:
        delay, passed = _where_they_meet(points, delay, state_in)
    start = state_in(delay).of_joints(points.columns)
    limits = of_joints(limits, points.columns)
    due = (points.times - passed) / SECOND  # from the moment that the execution starts [s]; <= 0: due or past
    if due[0] <= 0.0:
        _check_start(points, due, start, limits, rules)
    trajectory, first = _from_state(points, due, start)
    check_between(
        trajectory,
        limits,
        lambda _: f"between the robot's present state and point {first}",
        _START,
        most=1,
    )
    return Scheduled(delay, trajectory)


def _schedule(points: Points, now: int, rules: Rules) -> tuple[float, int]:
    """Delay until the start [s], and how long ago the start was [ns]; one of them is 0."""
    if points.stamp is None:
        return 0.0, 0
    ahead = points.stamp - now
    if ahead + int(points.times[-1]) < 0:
        raise TrajectoryError(
            Refusal.ENDS_IN_THE_PAST,
            f"the last point was due {-(ahead + int(points.times[-1])) / SECOND:.3f} s ago: "
            "use a stamp of 0 to start now, and check that the clocks agree",
        )
    if ahead > rules.max_start_delay * SECOND:
        raise TrajectoryError(
            Refusal.STARTS_TOO_LATE,
            f"expected a start within {rules.max_start_delay:g} s, got one in {ahead / SECOND:.3f} s: "
            "check that the clocks agree",
        )
    return max(ahead, 0) / SECOND, max(-ahead, 0)


def _where_they_meet(
    points: Points, delay: float, state_in: Callable[[float], MotionState]
) -> tuple[float, int]:
    """When the robot, in motion, is where the first point says that it is: a little sooner or later.

    A sender knows the place of a robot in motion from joint states, some milliseconds late, and its clock is
    another one. To be exactly where it says at exactly that time, the robot would have to leap.

    Args:
        points: Of which the first is due at the start.
        delay: Until the start, as asked for [s].
        state_in: The state of all commanded joints in so many seconds from now.

    Returns:
        Delay until the start [s], and how long ago the start was [ns]; one of them is 0.
    """
    moment = delay
    for _ in range(_STEPS_TO_MEET):
        state = state_in(max(moment, 0.0)).of_joints(points.columns)
        speed = float(state.velocities @ state.velocities)
        if speed < _SLOW**2:
            return delay, 0
        ago = min(moment, 0.0)
        here = state.positions + ago * (state.velocities + 0.5 * ago * state.accelerations)
        behind = points.positions[0] - here
        moment += float(np.clip(behind @ state.velocities / speed, -_LONGEST_SHIFT, _LONGEST_SHIFT))
    moment = float(np.clip(moment, delay - _LONGEST_SHIFT, delay + _LONGEST_SHIFT))
    return max(moment, 0.0), round(max(-moment, 0.0) * SECOND)


def _check_start(
    points: Points, due: FloatArray, start: MotionState, limits: JointLimits, rules: Rules
) -> None:
    """Compare the robot with where the message says that it is at the start, or has been since its stamp."""
    past = int(np.searchsorted(due, 0.0, side="right"))
    where = points.positions[:past]
    if past < len(due):
        around = slice(past - 1, past + 1)
        between = through(points, due[around] - due[past - 1], around)
        where = np.vstack([where, between.sample(-float(due[past - 1])).positions])
    low, high = where.min(axis=0), where.max(axis=0)
    distance = np.maximum(low - start.positions, start.positions - high)
    j = int(np.argmax(distance))
    if distance[j] > rules.start_tolerance:
        raise TrajectoryError(
            Refusal.START_MISMATCH,
            f"expected {limits.names[j]} where the robot is, {start.positions[j]:.4f} rad, within "
            f"{rules.start_tolerance:g} rad; the trajectory starts at {where[-1, j]:.4f} rad: "
            "plan from the present joint state, or give the first point time to be reached",
        )
    if past == len(due):
        for _, j in first_place(np.abs(start.velocities[None]) > REST_VELOCITY):
            raise TrajectoryError(
                Refusal.START_MISMATCH,
                f"every point is due at once and {limits.names[j]} moves at {start.velocities[j]:.4f} rad/s: "
                "give the robot time to stop",
            )


def _from_state(points: Points, due: FloatArray, start: MotionState) -> tuple[Trajectory, int]:
    """The trajectory from the robot's state on, and the number of the message's first point in it."""
    first = int(np.searchsorted(due, 0.0, side="right"))
    if first == len(due):
        return Trajectory.hold(start.positions), first
    if due[0] < 0.0 and due[first] < _SOONEST and first < len(due) - 1:
        first += 1
    degrees = points.degrees[first:]
    return (
        Trajectory(
            np.concatenate([[0.0], due[first:]]),
            np.concatenate([start.positions[None], points.positions[first:]]),
            np.concatenate([start.velocities[None], points.velocities[first:]]),
            np.concatenate([start.accelerations[None], points.accelerations[first:]]),
            # A segment uses what both its ends give; the robot's own state gives everything.
            per_joint(np.concatenate([degrees[:1], np.minimum(degrees[:-1], degrees[1:])]), points),
        ),
        first,
    )
