"""What the driver reads of a trajectory message: trajectory_msgs/JointTrajectory has this shape."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol


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
