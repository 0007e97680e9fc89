# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Where the robot is, as its joint states tell."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from teo_motion.trajectory.ruckig_segment import State

# Below this a joint counts as standing still [rad/s]: TEO's drives estimate speed from encoder counts.
_STILL = 0.01


class RobotState:
    """Keeps the latest position and velocity of each joint, from one publisher of joint states or several."""

    def __init__(self, names: tuple[str, ...]) -> None:
        """Follow some joints; others in the joint states are passed over."""
        self._column = {name: column for column, name in enumerate(names)}
        self._positions = np.full(len(names), np.nan)
        self._velocities = np.zeros(len(names))
        self._seen = np.full(len(names), -np.inf)
        self._still_since = np.inf

    def update(
        self, names: Sequence[str], positions: Sequence[float], velocities: Sequence[float], now: float
    ) -> str:
        """Take a joint state.

        Args:
            names: Its joints.
            positions: [rad], one for each.
            velocities: [rad/s], one for each, or empty: then the joints count as standing still.
            now: When it arrived [s].

        Returns:
            Why it was not taken; empty if it was.
        """
        if len(positions) != len(names) or len(velocities) not in (0, len(names)):
            return (
                f"expected {len(names)} positions and as many velocities or none, got {len(positions)} and "
                f"{len(velocities)}"
            )
        moves = velocities if len(velocities) else [0.0] * len(names)
        given = [
            (self._column[name], position, velocity)
            for name, position, velocity in zip(names, positions, moves, strict=True)
            if name in self._column
        ]
        if not given:
            return ""
        columns, position, velocity = (np.array(values) for values in zip(*given, strict=True))
        if not (np.isfinite(position).all() and np.isfinite(velocity).all()):
            return "expected finite positions and velocities, got others"
        self._positions[columns] = position
        self._velocities[columns] = np.where(np.abs(velocity) < _STILL, 0.0, velocity)
        self._seen[columns] = now
        if self._velocities.any():
            self._still_since = np.inf
        elif self._still_since == np.inf:
            self._still_since = now
        return ""

    @property
    def complete(self) -> bool:
        """Whether every joint has been heard of."""
        return bool(np.isfinite(self._positions).all())

    @property
    def missing(self) -> tuple[str, ...]:
        """Joints not heard of yet."""
        return tuple(name for name, column in self._column.items() if np.isnan(self._positions[column]))

    @property
    def oldest(self) -> float:
        """When the joint was heard of that has been silent longest [s]; minus infinity if one never was."""
        return float(self._seen.min())

    @property
    def is_still(self) -> bool:
        """Whether no joint moves."""
        return not self._velocities.any()

    def still_for(self, now: float) -> float:
        """How long no joint has moved [s]; minus infinity if one does."""
        return float(now - self._still_since)

    def shift_clock(self, by: float) -> None:
        """Follow a clock that was set by so much [s]."""
        self._seen += by
        self._still_since += by

    def state(self) -> State:
        """Positions and velocities, no acceleration; NaN for joints not heard of."""
        return State(
            position=self._positions.copy(),
            velocity=self._velocities.copy(),
            acceleration=np.zeros(len(self._positions)),
        )

    def farthest(self, positions: NDArray[np.float64]) -> tuple[float, str]:
        """The greatest distance of a joint from given positions [rad], and which joint."""
        distances = np.abs(self._positions - positions)
        column = int(np.argmax(distances))
        return float(distances[column]), list(self._column)[column]
