# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The way in: trajectories are checked beside the steps, one after the other, and come out in their order."""

from __future__ import annotations

from collections import deque
from collections.abc import Collection
from concurrent.futures import Future, ThreadPoolExecutor
from typing import Generic, NamedTuple, TypeVar

from teo_description import JointLimits
from teo_sim_driver.checking.reading import Points
from teo_sim_driver.checking.validation import check
from teo_sim_driver.errors import Refusal, TrajectoryError
from teo_sim_driver.groups import JointGroup
from teo_sim_driver.rules import Rules

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
        self._waiting.append(Checked(sender, self._worker.submit(self._check, message, rules, joints)))

    def take(self) -> list[Checked[Sender]]:
        """What has been checked since the last call, in the order in which it was put."""
        done = []
        while self._waiting and self._waiting[0].result.done():
            done.append(self._waiting.popleft())
        return done

    def close(self) -> None:
        """End the thread, when it has done what it is at."""
        self._worker.shutdown(cancel_futures=True)

    def _check(self, message: bytes, rules: Rules, group: tuple[str, ...]) -> Points:
        return check(message, limits=self._limits, rules=rules, held=self._held, group=group)
