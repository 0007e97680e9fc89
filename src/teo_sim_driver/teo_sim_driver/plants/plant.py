# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The joints: told where to be, they say where they are."""

from __future__ import annotations

from typing import Protocol

from teo_sim_driver.motion.trajectory import MotionState


class Plant(Protocol):
    """The commanded joints, in the driver's order."""

    def step(self, asked: MotionState, duration: float) -> MotionState:
        """Move, and return what the encoders say.

        Args:
            asked: What is sent to the joints.
            duration: Since the last step [s].
        """


class IdealPlant:
    """Joints that are where they are told to be."""

    def step(self, asked: MotionState, duration: float) -> MotionState:  # noqa: ARG002  # they need no time
        """See `Plant`."""
        return asked
