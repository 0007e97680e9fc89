"""What the real Dextra hands would be told; the conversion of one axis is in `teo_description.tendons`."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from teo_description import DescriptionError
from teo_description.tendons import LEFT_AXES, RIGHT_AXES
from teo_sim_driver.bezier import FloatArray
from teo_sim_driver.errors import DriverError

AXES = LEFT_AXES + RIGHT_AXES
"""All axes, in the order of the set-points."""


def setpoints(names: Sequence[str], positions: FloatArray) -> FloatArray:
    """What both hands' devices are told for these joint positions.

    Args:
        names: joint names, the twelve hand axes among them.
        positions: of the joints [rad]. Shape (joints,).

    Returns:
        Set-points [deg] and [mm], in the order of `AXES`. Shape (12,).

    Raises:
        DriverError: ``outside_hand_range``, or ``missing_hand_joint``.
    """
    index = {name: i for i, name in enumerate(names)}
    missing = [axis.joint for axis in AXES if axis.joint not in index]
    if missing:
        raise DriverError(
            "missing_hand_joint", f"expected all twelve hand axes, missing: {', '.join(missing)}"
        )
    try:
        return np.array([axis.setpoint(float(positions[index[axis.joint]])) for axis in AXES])
    except DescriptionError as error:
        raise DriverError(error.code, str(error)) from error
