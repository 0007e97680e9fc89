"""A trajectory message without ROS: to check and to execute trajectories in a program of one's own."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

SECOND = 1_000_000_000
"""[ns]"""


@dataclass
class PlainTime:
    """Like builtin_interfaces/Time and Duration."""

    sec: int = 0
    nanosec: int = 0

    @classmethod
    def of(cls, nanoseconds: int) -> PlainTime:
        """Split a time [ns]."""
        return cls(*divmod(nanoseconds, SECOND))


@dataclass
class PlainHeader:
    """Like std_msgs/Header."""

    stamp: PlainTime = field(default_factory=PlainTime)


@dataclass
class PlainPoint:
    """Like trajectory_msgs/JointTrajectoryPoint."""

    positions: Sequence[float] = ()
    velocities: Sequence[float] = ()
    accelerations: Sequence[float] = ()
    effort: Sequence[float] = ()
    time_from_start: PlainTime = field(default_factory=PlainTime)


@dataclass
class PlainTrajectory:
    """Like trajectory_msgs/JointTrajectory."""

    joint_names: Sequence[str] = ()
    points: Sequence[PlainPoint] = ()
    header: PlainHeader = field(default_factory=PlainHeader)


def plain_trajectory(
    names: Sequence[str],
    times: Iterable[float],
    positions: ArrayLike,
    velocities: ArrayLike | None = None,
    accelerations: ArrayLike | None = None,
    *,
    stamp: int = 0,
) -> PlainTrajectory:
    """Make a message from arrays.

    Args:
        names: joints, one for each column.
        times: from the start [s]. Shape (n,).
        positions: [rad]. Shape (n, joints).
        velocities: [rad/s]. Shape (n, joints).
        accelerations: [rad/s^2]. Shape (n, joints).
        stamp: when it starts [ns]; 0 is now.
    """
    moments = [PlainTime.of(round(time * SECOND)) for time in times]
    points = [
        PlainPoint(
            positions=row.tolist(),
            velocities=[] if velocities is None else np.asarray(velocities)[i].tolist(),
            accelerations=[] if accelerations is None else np.asarray(accelerations)[i].tolist(),
            time_from_start=moments[i],
        )
        for i, row in enumerate(np.asarray(positions, dtype=np.float64))
    ]
    return PlainTrajectory(list(names), points, PlainHeader(PlainTime.of(stamp)))
