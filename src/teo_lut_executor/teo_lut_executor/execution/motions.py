# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The motion in force, and the one that was sent to take over from it."""

from __future__ import annotations

from teo_lut_executor.execution.path_monitor import PathMonitor
from teo_motion.sentence.plan import Plan


class Motions:
    """What the robot was sent.

    Attributes:
        present: In force.
        continuation: Sent, and takes over later.
    """

    def __init__(self) -> None:
        """Begin with nothing sent."""
        self.present: PathMonitor | None = None
        self.continuation: PathMonitor | None = None

    def advance(self, duration: float) -> None:
        """Let path time pass [s]."""
        for motion in self._sent():
            motion.advance(duration)

    def synchronise(self, remaining: float) -> None:
        """Take the driver's word for the path time that is left to the end [s]."""
        for motion in self._sent():
            motion.synchronise(remaining)

    def add(self, motion: PathMonitor) -> None:
        """Take a motion that was sent: in force at once, or when it takes over from the one that is."""
        if self.present is None:
            self.present = motion
        else:
            self.continuation = motion

    def take_over(self) -> Plan | None:
        """Let the continuation be in force if its time has come, and return it."""
        following = self.continuation
        if following is None or following.elapsed < 0.0:
            return None
        self.present, self.continuation = following, None
        return following.motion

    def of(self, plan: Plan) -> PathMonitor | None:
        """The motion of a plan, if it was sent."""
        return next((motion for motion in self._sent() if motion.motion is plan), None)

    def clear(self) -> None:
        """Nothing is in force any more."""
        self.present = self.continuation = None

    def _sent(self) -> tuple[PathMonitor, ...]:
        return tuple(motion for motion in (self.present, self.continuation) if motion is not None)
