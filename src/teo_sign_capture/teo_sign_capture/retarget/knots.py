# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The knots of an entry from a motion: smoothed within a tube and reduced; figures of knots.

What is left of the keypoints' noise is small in degrees but fast: fingers that tremble by 5 deg from frame
to frame move at 150 deg/s, three times what TEO's joints do, and the planner would slow the whole sign for
it. Of all motions that nowhere leave a tube around the captured one, `smoothest_motion` finds the one with
the least acceleration: it has no trembling smaller than the tube, and no stroke, however fast, loses more
than the tube's radius. `reduce_to_knots` then keeps the frames that the planner needs to play it.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import BPoly
from scipy.optimize import lsq_linear

from teo_common.arrays import Array
from teo_description.humanoid import Humanoid
from teo_description.robot import Robot
from teo_motion.trajectory.waypoint_chain import OVERSHOOT, waypoint_states
from teo_sign_capture.tracks.skeleton_track import smoothed

# [rad] Arms, head, trunk: with all joints of an arm at its edge the hand is 2 cm off.
BODY_TUBE = np.radians(2.0)
# [rad] Axes of the hands: half of what handshapes that people tell apart differ by (15 deg, `lut nearest`),
# and as well as bends are known from keypoints that are 4 mm off.
FINGER_TUBE = np.radians(8.0)

# Relative tolerance of the least squares: accelerations come out a billionth from the least, in the time of
# an exact search.
_LEAST_SQUARES_TOLERANCE = 1e-12


def smoothest_motion(
    humanoid: Humanoid, times: Array, joints: tuple[str, ...], positions: Array, *, share: float = 1.0
) -> Array:
    """Find the motion of least acceleration in the tube, within the joints' limits.

    Args:
        humanoid: The robot.
        times: [s], strictly increasing. Shape (n,).
        joints: Names of the m joints.
        positions: [rad]. Shape (n, m).
        share: Of the tubes' radii that may be used, 0 to 1.

    Returns:
        Positions [rad], no farther from the given ones than the tubes' radii. Shape (n, m).
    """
    if len(times) < 3 or share <= 0.0:
        return positions.copy()
    bending = _second_differences(times)
    limits = humanoid.limits(joints)
    radii = share * _kept_radii(humanoid, times, joints, positions)
    lower = np.maximum(positions - radii, np.minimum(limits.lower, positions))
    upper = np.minimum(positions + radii, np.maximum(limits.upper, positions))
    gentle = positions.copy()
    for column in range(positions.shape[1]):
        low, high = lower[:, column], upper[:, column]
        if low.max() <= high.min():  # one posture is in the tube throughout
            gentle[:, column] = np.clip(np.median(positions[:, column]), low.max(), high.min())
            continue
        # Wider by a rounding for a joint that stands on its limit: bounds must not be equal. From within the
        # tube ("trf"): SciPy's active set ("bvls") leaves points a rounding beyond the bound that they are
        # put on, and divides by their way back to it, which is nothing.
        found = lsq_linear(
            bending,
            np.zeros(len(bending)),
            (low - 1e-9, high + 1e-9),
            method="trf",
            tol=_LEAST_SQUARES_TOLERANCE,
        )
        gentle[:, column] = np.clip(found.x, low, high)
    return gentle


def tube_radii(humanoid: Humanoid, joints: tuple[str, ...]) -> Array:
    """Radius of each joint's tube [rad]. Shape (m,)."""
    return np.array([BODY_TUBE if joint in humanoid.body_joints else FINGER_TUBE for joint in joints])


# [s] Standard deviation of the Gaussian that takes trembling away; three quarters of a beat of 3 Hz are left.
_TREMBLE = 0.04
# [rad] Axis of a finger: what is left of 4 deg of noise stays below, an index that hooks a little does not.
_MOVES = np.radians(10.0)
# Of such a movement no more than half is lost from end to end.
_PART = 0.25


def _kept_radii(humanoid: Humanoid, times: Array, joints: tuple[str, ...], positions: Array) -> Array:
    """Radius of each joint's tube, smaller where a finger moves a little [rad]. Shape (m,)."""
    usual, way = tube_radii(humanoid, joints), np.ptp(smoothed(times, positions, _TREMBLE), axis=0)
    kept: Array = np.where(way < _MOVES, usual, np.minimum(usual, np.maximum(_PART * way, BODY_TUBE)))
    return kept


def _second_differences(times: Array) -> Array:
    """Matrix that takes positions to accelerations, up to a common factor. Shape (n - 2, n)."""
    steps = np.diff(times) / np.median(np.diff(times))
    rows = np.zeros((len(times) - 2, len(times)))
    for row, (before, after) in enumerate(pairwise(steps.tolist())):
        # Root of the time that the acceleration holds for, so that its square is an integral.
        weight = np.sqrt((before + after) / 2.0) * 2.0 / (before + after)
        rows[row, row : row + 3] = weight * np.array([1.0 / before, -1.0 / before - 1.0 / after, 1.0 / after])
    return rows


Indices = NDArray[np.int64]

# [rad] 9 mm at the end of TEO's stretched arm for one joint, below what retargeting errs by; fewer knots
# leave the planner more room to make the motion smooth.
TOLERANCE = np.radians(1.0)


def reduce_to_knots(times: Array, positions: Array, tolerance: float = TOLERANCE) -> Indices:
    """Choose frames such that what passes through them stays near all others.

    Both the straight lines between knots, which are the recorded motion by the format of an entry, and the
    spline by which the planner passes them stay within the tolerance. The frame that is farthest off becomes
    a knot until none is (Douglas and Peucker 1973, with the spline for the line).

    Args:
        times: [s], strictly increasing. Shape (n,).
        positions: [rad]. Shape (n, m).
        tolerance: Greatest difference of any joint in any frame [rad].

    Returns:
        Indices of the knots, increasing, the first and the last among them. Shape (k,).
    """
    count = len(times)
    knots = sorted({0, count - 1})
    while len(knots) < count:
        chosen = np.array(knots)
        away = deviations(times, positions, times[chosen], positions[chosen]).max(axis=1)
        away[chosen] = 0.0
        worst = int(np.argmax(away))
        if away[worst] <= tolerance:
            break
        knots.append(worst)
        knots.sort()
    return np.array(knots, dtype=np.int64)


def deviations(times: Array, positions: Array, knot_times: Array, knots: Array) -> Array:
    """How far the lines and the spline through knots are from every frame of a motion [rad]. Shape (n, m)."""
    if len(knots) < 2:
        return np.zeros(positions.shape)
    away: Array = np.maximum(
        *(np.abs(played(knot_times, knots, times) - positions) for played in (_lines, passed))
    )
    return away


def passed(knot_times: Array, knots: Array, times: Array) -> Array:
    """The motion with which the planner passes knots where no limit is in its way.

    Args:
        knot_times: [s]. Shape (k,), k >= 2.
        knots: [rad]. Shape (k, m).
        times: [s]. Shape (n,).

    Returns:
        Positions [rad]. Shape (n, m).
    """
    velocities, accelerations = waypoint_states(knot_times, knots, np.ones_like(knots), swing=OVERSHOOT)
    states = np.stack([knots, velocities, accelerations], axis=1)
    positions: Array = BPoly.from_derivatives(knot_times, states)(times)
    return positions


def _lines(knot_times: Array, knots: Array, times: Array) -> Array:
    return np.column_stack([np.interp(times, knot_times, column) for column in knots.T])


# Poses from one knot to the next at which the clearance is measured.
_POSES_BETWEEN = 5


def least_clearance(robot: Robot, joints: tuple[str, ...], knots: Sequence[Array] | Array) -> float:
    """Smallest distance between parts of a robot over a motion in straight lines between its knots [m].

    Args:
        robot: The robot; joints not named are at home.
        joints: Names of the m joints that move.
        knots: Positions [rad]. Shape (n, m).
    """
    steps = np.linspace(0.0, 1.0, _POSES_BETWEEN, endpoint=False)
    poses = [first + step * (second - first) for first, second in pairwise(knots) for step in steps]
    return min(
        robot.clearance(robot.configuration(dict(zip(joints, pose.tolist(), strict=True)))).distance
        for pose in (*poses, knots[-1])
    )


def clearance_mm(robot: Robot, joints: tuple[str, ...], knots: Array) -> float:
    """`least_clearance` as entries give it [mm]."""
    return round(1000.0 * least_clearance(robot, joints, knots), 1)


def limit_margin_deg(humanoid: Humanoid, joints: tuple[str, ...], knots: Array) -> float:
    """Smallest distance of arm, head and trunk joints from their limits [deg].

    Fingers do not count: a straight one is at its limit by nature.
    """
    body = [index for index, joint in enumerate(joints) if joint in humanoid.body_joints]
    limits = humanoid.limits(joints)
    margins = np.minimum(knots - limits.lower, limits.upper - knots)[:, body]
    return round(float(np.degrees(margins.min())), 1)
