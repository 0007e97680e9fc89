# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Whether the robot can execute a trajectory from where it is, exactly as it is given."""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from teo_description import JointLimits
from teo_sim_driver.bezier import FloatArray, first_excess
from teo_sim_driver.errors import Refusal, TrajectoryError
from teo_sim_driver.message import SECOND, TrajectoryLike
from teo_sim_driver.reading import Fields, MessageFields, Points, listed, read
from teo_sim_driver.rules import POSITION_TOLERANCE, REST_VELOCITY, VELOCITY_TOLERANCE, Rules
from teo_sim_driver.trajectory import MotionState, Trajectory

# Segments checked at once: bounds the memory to some MB whatever the message's length.
_CHUNK = 1024


class Scheduled(NamedTuple):
    """A trajectory that was found good, and when it starts."""

    delay: float
    """From now to the start [s], >= 0."""
    trajectory: Trajectory
    """From the robot's state at the start to the last point."""


def check(message: Fields, *, limits: JointLimits, rules: Rules, held: Collection[str] = ()) -> Points:
    """Check all of a message that can be judged without knowing where the robot is; takes its time.

    Args:
        message: As received.
        limits: Of the commanded joints, in the driver's order.
        rules: Limits on the message.
        held: Names of joints that the robot has and the driver never moves.

    Raises:
        TrajectoryError: with one reason, the first found; nothing of the message may be executed.
    """
    points = read(message, joints=limits.names, held=held, rules=rules)
    columns = points.columns
    limits = JointLimits(
        names=tuple(limits.names[i] for i in columns),
        lower=limits.lower[columns],
        upper=limits.upper[columns],
        velocity=limits.velocity[columns],
    )
    _check_points(points, limits)
    trajectory = Trajectory(
        points.times / SECOND,
        points.positions,
        points.velocities,
        points.accelerations,
        np.minimum(points.degrees[:-1], points.degrees[1:]),
    )
    _check_between(
        trajectory, limits, lambda segment: f"between points {segment} and {segment + 1}", _BETWEEN
    )
    return _in_order(points)


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
        state_in: The state of the commanded joints in so many seconds from now, if nothing new came.

    Raises:
        TrajectoryError: with one reason, the first found; nothing of the message may be executed.
    """
    delay, passed = _schedule(points, now, rules)
    start = state_in(delay)
    points = _with_all_joints(points, start, limits)
    due = _times_from_start(points, passed)
    if due[0] <= 0.0:
        _check_start(points, due, start, limits, rules)
    trajectory, first = _from_state(points, due, start)
    _check_between(
        trajectory.first_segment(),
        limits,
        lambda _: f"between the robot's present state and point {first}",
        _START,
    )
    return Scheduled(delay, trajectory)


def validate(
    message: TrajectoryLike,
    *,
    limits: JointLimits,
    rules: Rules,
    now: int,
    state_in: Callable[[float], MotionState],
    held: Collection[str] = (),
) -> Scheduled:
    """Check a message in every respect and make it ready: `check` and `schedule` in one.

    Raises:
        TrajectoryError: with one reason, the first found; nothing of the message may be executed.
    """
    points = check(MessageFields(message), limits=limits, rules=rules, held=held)
    return schedule(points, limits=limits, rules=rules, now=now, state_in=state_in)


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


def _in_order(points: Points) -> Points:
    """Columns in the driver's order."""
    order = np.argsort(points.columns)
    return replace(
        points,
        columns=points.columns[order],
        positions=points.positions[:, order],
        velocities=points.velocities[:, order],
        accelerations=points.accelerations[:, order],
    )


# A point of a late trajectory that is due sooner is passed like those before it [s]: half of the usual step,
# in which joints that are a little beside the path, as the sender could not know, cannot be back on it.
_SOONEST = 0.005


def _with_all_joints(points: Points, start: MotionState, limits: JointLimits) -> Points:
    """All joints in the driver's order; those that the message leaves out hold their position."""
    count = len(limits.names)
    if len(points.columns) == count:
        return points
    left_out = np.setdiff1d(np.arange(count), points.columns)
    moving = left_out[np.abs(start.velocities[left_out]) > REST_VELOCITY]
    if len(moving):
        raise TrajectoryError(
            Refusal.MISSING_JOINTS,
            f"{listed([limits.names[i] for i in moving])} would be in motion and cannot be left out",
        )

    def spread(values: FloatArray, background: FloatArray) -> FloatArray:
        table = np.tile(background, (len(values), 1))
        table[:, points.columns] = values
        return table

    still = np.zeros(count)
    return Points(
        points.stamp,
        np.arange(count),
        points.times,
        spread(points.positions, start.positions),
        spread(points.velocities, still),
        spread(points.accelerations, still),
        points.degrees,
    )


def _check_points(points: Points, limits: JointLimits) -> None:
    low, high = limits.lower - POSITION_TOLERANCE, limits.upper + POSITION_TOLERANCE
    for i, j in _where((points.positions < low) | (points.positions > high)):
        raise TrajectoryError(
            Refusal.POSITION_LIMIT,
            f"point {i}: expected {limits.names[j]} within "
            f"{limits.lower[j]:.4f} .. {limits.upper[j]:.4f} rad, got {points.positions[i, j]:.6g} rad",
        )
    top = limits.velocity * (1.0 + VELOCITY_TOLERANCE)
    for i, j in _where(np.abs(points.velocities) > top):
        raise TrajectoryError(
            Refusal.VELOCITY_LIMIT,
            f"point {i}: expected {limits.names[j]} within +-{limits.velocity[j]:.4f} rad/s, "
            f"got {points.velocities[i, j]:.6g} rad/s",
        )
    for _, j in _where(np.abs(points.velocities[-1:]) > REST_VELOCITY):
        raise TrajectoryError(
            Refusal.MOVING_AT_END,
            f"last point: expected {limits.names[j]} at rest, got {points.velocities[-1, j]:.6g} rad/s",
        )


def _times_from_start(points: Points, passed: int) -> FloatArray:
    """When each point is due, from the moment that the execution starts [s]; <= 0 for what is due or past."""
    return np.asarray((points.times - passed) / SECOND)


def _check_start(
    points: Points, due: FloatArray, start: MotionState, limits: JointLimits, rules: Rules
) -> None:
    """Compare the robot with where the message says that it is at the start, or has been since its stamp."""
    past = int(np.searchsorted(due, 0.0, side="right"))
    where = points.positions[:past]
    if past < len(due):
        around = slice(past - 1, past + 1)
        between = Trajectory(
            due[around] - due[past - 1],
            points.positions[around],
            points.velocities[around],
            points.accelerations[around],
            np.minimum(points.degrees[past - 1 : past], points.degrees[past : past + 1]),
        )
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
        for _, j in _where(np.abs(start.velocities[None]) > REST_VELOCITY):
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
            np.concatenate([degrees[:1], np.minimum(degrees[:-1], degrees[1:])]),
        ),
        first,
    )


class _Codes(NamedTuple):
    """Why a segment is refused, by where it is."""

    position: Refusal
    velocity: Refusal
    speed: Refusal


_BETWEEN = _Codes(
    Refusal.POSITION_BETWEEN_POINTS, Refusal.VELOCITY_BETWEEN_POINTS, Refusal.SPEED_BETWEEN_POINTS
)
_START = _Codes(Refusal.START_LEAVES_LIMITS, Refusal.START_TOO_FAST, Refusal.START_TOO_FAST)


def _check_between(
    trajectory: Trajectory, limits: JointLimits, place: Callable[[int], str], codes: _Codes
) -> None:
    """Refuse what is over a limit between points; `place` names a segment."""
    top = limits.velocity * (1.0 + VELOCITY_TOLERANCE)
    low, high = limits.lower - POSITION_TOLERANCE, limits.upper + POSITION_TOLERANCE
    count = len(trajectory.degrees)
    for begin in range(0, count, _CHUNK):
        span = slice(begin, min(begin + _CHUNK, count))
        durations = trajectory.durations(span)
        steps = np.diff(trajectory.positions[span.start : span.stop + 1], axis=0)
        for i, j in _where(np.abs(steps) > top * durations[:, None]):
            raise TrajectoryError(
                codes.speed,
                f"{place(begin + i)}, {limits.names[j]} has {durations[i]:.6g} s for "
                f"{abs(steps[i, j]):.4f} rad: {abs(steps[i, j]) / durations[i]:.4g} rad/s; "
                f"limit {limits.velocity[j]:.4f} rad/s",
            )
        with np.errstate(over="ignore", invalid="ignore"):  # absurd accelerations overflow, and are refused
            for what, unit, code, control, lower, upper in (
                ("velocity", "rad/s", codes.velocity, trajectory.velocity_control(span), -top, top),
                ("position", "rad", codes.position, trajectory.position_control(span), low, high),
            ):
                excess = first_excess(control, lower, upper)
                if excess is None:
                    continue
                segment, j = begin + excess.segment, excess.joint
                moment = trajectory.times[segment] + excess.fraction * durations[excess.segment]
                raise TrajectoryError(
                    code,
                    f"{place(segment)}, the curve through the given points takes {limits.names[j]} to a "
                    f"{what} of {excess.value:.6g} {unit}, {moment:.3f} s after the start; it must stay "
                    f"within {lower[j]:.4f} .. {upper[j]:.4f}",
                )


def _where(bad: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """The first place where it is true, if any: (point, joint)."""
    flat = int(np.argmax(bad))
    return [(flat // bad.shape[1], flat % bad.shape[1])] if bad.flat[flat] else []
