# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the driver reads of a trajectory message, and such messages without ROS.

Anything in the shape of trajectory_msgs/JointTrajectory is read (`TrajectoryLike`); `plain_trajectory` makes
one for a program of one's own.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike

from teo_sim_driver.motion.path_time import SECOND


class TimeLike(Protocol):
    """builtin_interfaces/Time or Duration."""

    @property
    def sec(self) -> int:
        """Whole seconds [s]."""

    @property
    def nanosec(self) -> int:
        """The rest [ns], 0..999,999,999, always forward."""


class HeaderLike(Protocol):
    """std_msgs/Header."""

    @property
    def stamp(self) -> TimeLike:
        """When the trajectory starts; 0 is now."""


class PointLike(Protocol):
    """trajectory_msgs/JointTrajectoryPoint."""

    @property
    def positions(self) -> Sequence[float]:
        """[rad], in the order of the message's joint names."""

    @property
    def velocities(self) -> Sequence[float]:
        """[rad/s], or empty."""

    @property
    def accelerations(self) -> Sequence[float]:
        """[rad/s^2], or empty."""

    @property
    def effort(self) -> Sequence[float]:
        """[N m]; this driver has no use for it, and refuses it."""

    @property
    def time_from_start(self) -> TimeLike:
        """When the point is to be reached."""


class TrajectoryLike(Protocol):
    """trajectory_msgs/JointTrajectory."""

    @property
    def header(self) -> HeaderLike:
        """Its stamp is read, its frame is not."""

    @property
    def joint_names(self) -> Sequence[str]:
        """Joints, in any order."""

    @property
    def points(self) -> Sequence[PointLike]:
        """In order of time."""


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
        names: Joints, one for each column.
        times: From the start [s]. Shape (n,).
        positions: [rad]. Shape (n, joints).
        velocities: [rad/s]. Shape (n, joints).
        accelerations: [rad/s^2]. Shape (n, joints).
        stamp: When it starts [ns]; 0 is now.
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
