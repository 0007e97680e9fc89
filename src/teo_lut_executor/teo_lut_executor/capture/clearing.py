"""Hands that would go into TEO's body, or into each other, are moved off."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import maximum_filter1d

from teo_lut_executor.capture.arm_problem import ArmProblem
from teo_lut_executor.capture.arm_trajectory import Bounds, refine_arms
from teo_lut_executor.capture.skeleton_track import SkeletonTrack
from teo_lut_executor.capture.touches import LEAST, WANTED, WholeRobot
from teo_lut_executor.lut_error import LutError

Array = NDArray[np.float64]

_PASSES = 16
"""Each finds anew what is near, and solves the motion with it; after three most hands are off."""
_PUSHED = 3
"""Passes after which a posture that still touches begins anew from the nearest moment that does not (hands
that have gone into each other too far are pushed to the wrong side), and what is wanted of it counts less."""
_LESS, _AROUND = 0.3, 2
"""By how much less each time, and in how many frames before and after as well."""
_STILL = 1e-4
"""[rad] A posture that moves by less keeps its distances to a tenth of a millimetre."""


def clear_arms(
    problem: ArmProblem, whole: WholeRobot, track: SkeletonTrack, bounds: list[Bounds], arms: Array
) -> tuple[Array, Array]:
    """Move a motion of the arms off all that it would touch.

    Args:
        problem: What is wanted of the arms.
        whole: The robot.
        track: The person, for times and errors.
        bounds: Of each arm [rad].
        arms: Shape (T, m) [rad].

    Returns:
        The arms, and the smallest distance between parts of the robot in each frame [m], shape (T,).

    Raises:
        LutError: "self_collision" where no way off is found.
    """
    frames = np.arange(len(arms))
    distances = np.array([whole.clearance(frame, arms[frame]).distance for frame in frames.tolist()])
    measured, shares = arms, np.ones(len(arms))
    for turn in range(_PASSES):
        if distances.min() >= LEAST:
            return arms, distances
        if turn >= _PUSHED:
            arms = _begun_anew(arms, distances)
            shares = shares * np.where(maximum_filter1d(distances < LEAST, 2 * _AROUND + 1), _LESS, 1.0)
        touches = whole.touches(np.flatnonzero(distances < 2.0 * WANTED), arms)
        arms = refine_arms(problem, track.times, bounds, arms, touches=touches, shares=shares)
        changed = np.flatnonzero(np.abs(arms - measured).max(axis=1) > _STILL)
        measured = measured.copy()
        for frame in changed.tolist():
            distances[frame] = whole.clearance(frame, arms[frame]).distance
            measured[frame] = arms[frame]
    worst = int(distances.argmin())
    if distances[worst] >= LEAST:
        return arms, distances
    found = whole.clearance(worst, arms[worst])
    raise LutError(
        "self_collision",
        f"{track.source}: expected a posture that TEO can take at {track.times[worst]:.2f} s, got one in "
        f"which {found.first} comes within {1000.0 * found.distance:.0f} mm of {found.second} (at least "
        f"{1000.0 * LEAST:.0f}) however it is moved: leave this part out, or show the sign farther from the "
        "body",
    )


def _begun_anew(arms: Array, distances: Array) -> Array:
    """The arms with each posture that touches replaced by the nearest in time that does not."""
    clear = np.flatnonzero(distances >= LEAST)
    if not clear.size:
        return arms
    nearest = clear[np.abs(np.arange(len(arms))[:, None] - clear).argmin(axis=1)]
    begun: Array = arms[nearest]
    return begun
