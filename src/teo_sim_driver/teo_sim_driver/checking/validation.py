# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Whether a trajectory keeps within the joint limits, at its points and between; in a thread of its own."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Collection
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import replace
from typing import Generic, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from teo_description import JointLimits
from teo_sim_driver.checking.reading import CdrTrajectory, Points, read
from teo_sim_driver.motion.bezier import FloatArray, first_excess
from teo_sim_driver.motion.path_time import SECOND
from teo_sim_driver.motion.trajectory import Trajectory
from teo_sim_driver.rules import (
    POSITION_TOLERANCE,
    REST_VELOCITY,
    VELOCITY_TOLERANCE,
    JointGroup,
    Refusal,
    Rules,
    TrajectoryError,
)

# Segments checked at once: bounds the memory to some MB whatever the message's length.
_CHUNK = 1024


class Codes(NamedTuple):
    """Why a segment is refused, by what is wrong with it."""

    position: Refusal
    velocity: Refusal
    speed: Refusal


_BETWEEN = Codes(
    Refusal.POSITION_BETWEEN_POINTS, Refusal.VELOCITY_BETWEEN_POINTS, Refusal.SPEED_BETWEEN_POINTS
)


def check(
    data: bytes,
    *,
    limits: JointLimits,
    rules: Rules,
    held: Collection[str] = (),
    group: Collection[str] = (),
) -> Points:
    """Check all of a message that can be judged without knowing where the robot is; takes its time.

    Args:
        data: The message, serialized.
        limits: Of the commanded joints, in the driver's order.
        rules: Limits on the message.
        held: Names of joints that the robot has and the driver never moves.
        group: Names of the joints that the message is to be about; all of `limits` if empty.

    Raises:
        TrajectoryError: with one reason, the first found; nothing of the message may be executed.
    """
    points = read(CdrTrajectory(data), joints=limits.names, held=held, rules=rules, group=group)
    limits = of_joints(limits, points.columns)
    _check_points(points, limits)
    trajectory = through(points, points.times / SECOND, slice(None))
    check_between(trajectory, limits, lambda segment: f"between points {segment} and {segment + 1}", _BETWEEN)
    return _in_order(points)


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


def _check_points(points: Points, limits: JointLimits) -> None:
    low, high = limits.lower - POSITION_TOLERANCE, limits.upper + POSITION_TOLERANCE
    for i, j in first_place((points.positions < low) | (points.positions > high)):
        raise TrajectoryError(
            Refusal.POSITION_LIMIT,
            f"point {i}: expected {limits.names[j]} within "
            f"{limits.lower[j]:.4f} .. {limits.upper[j]:.4f} rad, got {points.positions[i, j]:.6g} rad",
        )
    top = limits.velocity * (1.0 + VELOCITY_TOLERANCE)
    for i, j in first_place(np.abs(points.velocities) > top):
        raise TrajectoryError(
            Refusal.VELOCITY_LIMIT,
            f"point {i}: expected {limits.names[j]} within +-{limits.velocity[j]:.4f} rad/s, "
            f"got {points.velocities[i, j]:.6g} rad/s",
        )
    for _, j in first_place(np.abs(points.velocities[-1:]) > REST_VELOCITY):
        raise TrajectoryError(
            Refusal.MOVING_AT_END,
            f"last point: expected {limits.names[j]} at rest, got {points.velocities[-1, j]:.6g} rad/s",
        )


def of_joints(limits: JointLimits, columns: NDArray[np.intp]) -> JointLimits:
    """The limits of some of the joints."""
    return JointLimits(
        names=tuple(limits.names[i] for i in columns),
        lower=limits.lower[columns],
        upper=limits.upper[columns],
        velocity=limits.velocity[columns],
    )


def per_joint(degrees: NDArray[np.int8], points: Points) -> NDArray[np.int8]:
    """A message has the same degree for all its joints."""
    return np.broadcast_to(degrees[:, None], (len(degrees), len(points.columns))).copy()


def through(points: Points, times: FloatArray, rows: slice) -> Trajectory:
    """A trajectory through some of the points at these times [s]: a segment uses what both its ends give."""
    degrees = points.degrees[rows]
    return Trajectory(
        times,
        points.positions[rows],
        points.velocities[rows],
        points.accelerations[rows],
        per_joint(np.minimum(degrees[:-1], degrees[1:]), points),
    )


def check_between(
    trajectory: Trajectory,
    limits: JointLimits,
    place: Callable[[int], str],
    codes: Codes,
    *,
    most: int | None = None,
) -> None:
    """Refuse what is over a limit between points, in the first segments or all; `place` names a segment."""
    top = limits.velocity * (1.0 + VELOCITY_TOLERANCE)
    low, high = limits.lower - POSITION_TOLERANCE, limits.upper + POSITION_TOLERANCE
    count = len(trajectory.degrees[:most])
    for begin in range(0, count, _CHUNK):
        span = slice(begin, min(begin + _CHUNK, count))
        durations = trajectory.durations(span)
        steps = np.diff(trajectory.positions[span.start : span.stop + 1], axis=0)
        for i, j in first_place(np.abs(steps) > top * durations[:, None]):
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


def first_place(bad: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """The first place where it is true, if any: (point, joint)."""
    flat = int(np.argmax(bad))
    return [(flat // bad.shape[1], flat % bad.shape[1])] if bad.flat[flat] else []


# Trajectories that wait to be checked: as many as the subscription keeps.
MOST_WAITING = 10

# What a message needs besides its points [bytes]: header, and names of joints.
_HEAD = 16384
# Length and alignment of each of a point's four fields, and its time [bytes].
_POINT = 4 * 8 + 8

Sender = TypeVar("Sender")


class Checked(NamedTuple, Generic[Sender]):
    """A trajectory that has been checked."""

    sender: Sender
    result: Future[Points]
    """Done. Raises `TrajectoryError`, or whatever a fault of the driver raised."""


class Intake(Generic[Sender]):
    """Checks trajectories in a thread of its own, so that no step waits for it."""

    def __init__(self, limits: JointLimits, held: Collection[str]) -> None:
        """Start without work.

        Args:
            limits: Of the commanded joints, in the driver's order.
            held: Names of joints that the robot has and the driver never moves.
        """
        self._limits, self._held = limits, held
        self._worker = ThreadPoolExecutor(max_workers=1, thread_name_prefix="intake")
        self._waiting: deque[Checked[Sender]] = deque()

    def put(self, message: bytes, rules: Rules, sender: Sender, group: JointGroup | None = None) -> None:
        """Begin to check a message.

        Args:
            message: Serialized.
            rules: Limits on the message.
            sender: Comes out with the result.
            group: Joints that the message is to be about; None: all.

        Raises:
            TrajectoryError: refused at once: ``too_large`` or ``too_many_waiting``.
        """
        most = _HEAD + rules.max_points * (_POINT + 3 * 8 * len(self._limits.names))
        if len(message) > most:
            raise TrajectoryError(
                Refusal.TOO_LARGE,
                f"expected at most {most} bytes, room for {rules.max_points} points of all joints; got "
                f"{len(message)}: send fewer points, or in parts",
            )
        if len(self._waiting) >= MOST_WAITING:
            raise TrajectoryError(
                Refusal.TOO_MANY_WAITING,
                f"expected at most {MOST_WAITING} trajectories at once, got one more: send them more slowly",
            )
        joints = self._limits.names if group is None else group.joints
        result = self._worker.submit(
            check, message, limits=self._limits, rules=rules, held=self._held, group=joints
        )
        self._waiting.append(Checked(sender, result))

    def take(self) -> list[Checked[Sender]]:
        """What has been checked since the last call, in the order in which it was put."""
        done = []
        while self._waiting and self._waiting[0].result.done():
            done.append(self._waiting.popleft())
        return done

    def close(self) -> None:
        """End the thread, when it has done what it is at."""
        self._worker.shutdown(cancel_futures=True)
