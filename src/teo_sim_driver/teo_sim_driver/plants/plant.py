# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The joints: told where to be, they say where they are; what can be wrong with them, and the fault seen."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from teo_description import JointLimits
from teo_sim_driver.motion.bezier import FloatArray
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


# A step of a joint that follows at full speed is this much longer [1]: positions are differences, rounded.
_ROUNDING = 1e-6


@dataclass(frozen=True, kw_only=True)
class Faults:
    """What is wrong with the joints and with what is heard of them. The default is nothing."""

    frozen: tuple[str, ...] = ()
    """Joints that stay where they are, whatever they are told."""
    limit_switches: tuple[str, ...] = ()
    """Joints whose limit switch is pressed."""
    lag: float = 0.0
    """Time constant of a first-order lag of every joint behind what it is told [s]."""
    tracking_error: float = 0.0
    """How far every joint is beyond where it was told to be [rad]."""
    encoder_step: float = 0.0
    """Positions are measured in whole steps of this size [rad]; 0 for exactly."""
    state_delay: float = 0.0
    """Joint states are published this much later than they were measured [s]."""
    state_loss: float = 0.0
    """Part of the joint states that is lost, 0..1."""


class FaultyPlant:
    """Joints to which faults happen."""

    def __init__(self, plant: Plant, limits: JointLimits, start: FloatArray) -> None:
        """Stand still, without faults.

        Args:
            plant: The joints.
            limits: Of the joints: one that a fault has held back catches up no faster.
            start: Their positions [rad]. Shape (joints,).
        """
        self._plant = plant
        self._limits = limits
        self._told = start
        self._behind = False  # whether a fault has held a joint back
        self._measured = MotionState.at_rest(start)
        self.faults = Faults()
        """What is wrong; may be exchanged at any time."""

    def step(self, asked: MotionState, duration: float) -> MotionState:
        """Move as told, as far as the faults allow, and return what the encoders say; see `Plant`."""
        if self.faults == Faults() and not self._behind:
            self._told, self._measured = asked.positions, self._plant.step(asked, duration)
            return self._measured
        goal = asked.positions
        if self.faults.lag > 0.0:
            goal = self._told + (goal - self._told) * -np.expm1(-duration / self.faults.lag)
        if self.faults.frozen:
            stuck = np.isin(self._limits.names, self.faults.frozen)
            goal = np.where(stuck, self._told, goal)
        most = self._limits.velocity * duration * (1.0 + _ROUNDING)
        goal = self._told + np.clip(goal - self._told, -most, most)
        self._behind = bool(np.abs(asked.positions - goal).max() > 0.0)
        told = _moved(self._told, goal, duration)
        self._told = goal
        measured = self._plant.step(told, duration).positions + self.faults.tracking_error
        if self.faults.encoder_step > 0.0:
            measured = np.round(measured / self.faults.encoder_step) * self.faults.encoder_step
        self._measured = _moved(self._measured.positions, measured, duration)
        return self._measured


def _moved(before: FloatArray, after: FloatArray, duration: float) -> MotionState:
    """Where joints are that were elsewhere so long ago [s]."""
    moved = after - before
    still = np.zeros_like(moved)
    return MotionState(after, moved / duration if duration > 0.0 else still, still)


class StateLine:
    """The way of a joint state from the encoders to the topic: some come late, some never."""

    def __init__(self) -> None:
        self._waiting: deque[tuple[int, MotionState]] = deque()
        # Seeded, so that a run can be repeated.
        self._chance = np.random.default_rng(0)

    def send(self, state: MotionState, now: int, faults: Faults) -> list[tuple[int, MotionState]]:
        """Enter what was measured now [ns]; return what arrives now, each with when it was measured [ns]."""
        if faults.state_loss == 0.0 or self._chance.random() >= faults.state_loss:
            self._waiting.append((now, state))
        arrived = []
        while self._waiting and now - self._waiting[0][0] >= faults.state_delay * 1e9:
            arrived.append(self._waiting.popleft())
        return arrived


def fault(
    joints: Sequence[str], asked: MotionState, measured: MotionState, tolerance: float, pressed: Sequence[str]
) -> str:
    """A sentence on what is wrong, empty if nothing is.

    Args:
        joints: Their names.
        asked: What was sent to them.
        measured: Where they are.
        tolerance: How far a joint may be from where it was told to be [rad].
        pressed: Joints whose limit switch is pressed.
    """
    if pressed:
        return f"the limit switch of {', '.join(pressed)} is pressed"
    error = np.abs(measured.positions - asked.positions)
    j = int(np.argmax(error))
    if error[j] <= tolerance:
        return ""
    return (
        f"{joints[j]} does not follow: expected {asked.positions[j]:.4f} rad within {tolerance:g} rad, "
        f"it is at {measured.positions[j]:.4f} rad"
    )


def where_to_hold(asked: MotionState, measured: MotionState, tolerance: float) -> FloatArray | None:
    """Where drives hold that are switched on again: those that did not follow, where they are.

    Args:
        asked: What was sent to them.
        measured: Where they are.
        tolerance: How far a joint may be from where it was told to be [rad].

    Returns:
        Positions [rad]; None if all of them followed. Shape (joints,).
    """
    astray = np.abs(measured.positions - asked.positions) > tolerance
    return np.where(astray, measured.positions, asked.positions) if astray.any() else None
