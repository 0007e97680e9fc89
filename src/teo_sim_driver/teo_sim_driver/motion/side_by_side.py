# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Trajectories of different joints brought together in one, and slowing down some joints on their path."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from teo_sim_driver.motion.bezier import LINEAR, FloatArray
from teo_sim_driver.motion.path_time import Braking, PathPace, fastest_ahead
from teo_sim_driver.motion.trajectory import SAME_TIME, Trajectory

# Time between the points of a stop [s]: a step of the driver.
_STEP = 0.01


class Part(NamedTuple):
    """What some of the joints do."""

    columns: NDArray[np.intp]
    """Which joints. Shape (m,)."""
    trajectory: Trajectory
    """Of these joints, from the same moment on as the other parts; afterwards they stand still."""


def side_by_side(parts: Sequence[Part]) -> Trajectory:
    """Bring parts together, each of which goes on exactly as it would alone.

    A polynomial that is split at a point remains the same polynomial, so that points of one part are put into
    the others without changing them.

    Args:
        parts: Their columns are all the joints, each once.
    """
    if len(parts) == 1:
        return parts[0].trajectory
    times = np.unique(np.concatenate([part.trajectory.times for part in parts]))
    times = times[np.concatenate([[True], np.diff(times) > SAME_TIME])]
    joints = sum(len(part.columns) for part in parts)
    positions, velocities, accelerations = np.empty((3, len(times), joints))
    degrees = np.empty((len(times) - 1, joints), np.int8)
    for columns, alone in parts:
        own = np.searchsorted(times, alone.times, side="right") - 1
        segment = np.searchsorted(own, np.arange(len(times)), side="right") - 1
        inside = segment < len(alone.times) - 1
        for table, sampled, given in zip(
            (positions, velocities, accelerations),
            alone.states(times),
            (alone.positions, alone.velocities, alone.accelerations),
            strict=True,
        ):
            sampled[own] = given
            table[:, columns] = sampled
        still = np.full((len(times) - 1, len(columns)), LINEAR, np.int8)
        still[inside[:-1]] = alone.degrees[segment[:-1][inside[:-1]]]
        degrees[:, columns] = still
    return Trajectory(times, positions, velocities, accelerations, degrees)


def slowed_down(trajectory: Trajectory, start: float, limits: FloatArray, braking: Braking) -> Trajectory:
    """From a moment on along the path until the joints stand still on it.

    Args:
        trajectory: Of the joints that are to stop.
        start: Where on it they begin to [s].
        limits: Velocity limit of each of them [rad/s]. Shape (joints,).
        braking: What slowing down may add to their motion.
    """
    pace = PathPace()
    pace.turn(0.0, fastest_ahead(trajectory, start, limits, braking), braking)
    steps = math.ceil(pace.remaining / _STEP)
    here = trajectory.sample(start)
    if steps == 0:
        return Trajectory.hold(here.positions)
    times = np.linspace(0.0, pace.remaining, steps + 1)
    place = start
    rows = [here]
    for duration in np.diff(times):
        place += pace.advance(float(duration))
        rows.append(trajectory.sample(place).at_pace(pace.rate, pace.acceleration))
    positions, velocities, accelerations = (np.array(values) for values in zip(*rows, strict=True))
    velocities[-1] = accelerations[-1] = 0.0
    return Trajectory.quintic(times, positions, velocities, accelerations)
