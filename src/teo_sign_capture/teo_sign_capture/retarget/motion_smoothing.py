# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The gentlest motion near a captured one.

What is left of the keypoints' noise is small in degrees but fast: fingers that tremble by 5 deg from frame
to frame move at 150 deg/s, three times what TEO's joints do, and the planner would slow the whole sign for
it. Of all motions that nowhere leave a tube around the captured one, this is the one with the least
acceleration: it has no trembling smaller than the tube, and no stroke, however fast, loses more than the
tube's radius.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from scipy.optimize import lsq_linear

from teo_common.arrays import Array
from teo_description.humanoid import Humanoid

# [rad] Arms, head, trunk: with all joints of an arm at its edge the hand is 2 cm off.
BODY_TUBE = np.radians(2.0)
# [rad] Axes of the hands: half of what handshapes that people tell apart differ by (15 deg, `lut nearest`),
# and as well as bends are known from keypoints that are 4 mm off.
FINGER_TUBE = np.radians(8.0)


# Relative tolerance of the least squares: accelerations come out a billionth from the least, in the time of
# an exact search.
_TOLERANCE = 1e-12


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
    radii = share * tube_radii(humanoid, joints)
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
            bending, np.zeros(len(bending)), (low - 1e-9, high + 1e-9), method="trf", tol=_TOLERANCE
        )
        gentle[:, column] = np.clip(found.x, low, high)
    return gentle


def tube_radii(humanoid: Humanoid, joints: tuple[str, ...]) -> Array:
    """Radius of each joint's tube [rad]. Shape (m,)."""
    return np.array([BODY_TUBE if joint in humanoid.body_joints else FINGER_TUBE for joint in joints])


def _second_differences(times: Array) -> Array:
    """Matrix that takes positions to accelerations, up to a common factor. Shape (n - 2, n)."""
    steps = np.diff(times) / np.median(np.diff(times))
    rows = np.zeros((len(times) - 2, len(times)))
    for row, (before, after) in enumerate(pairwise(steps.tolist())):
        # Root of the time that the acceleration holds for, so that its square is an integral.
        weight = np.sqrt((before + after) / 2.0) * 2.0 / (before + after)
        rows[row, row : row + 3] = weight * np.array([1.0 / before, -1.0 / before - 1.0 / after, 1.0 / after])
    return rows
