# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Whether the joints do what they were told."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from teo_sim_driver.motion.bezier import FloatArray
from teo_sim_driver.motion.trajectory import MotionState


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
