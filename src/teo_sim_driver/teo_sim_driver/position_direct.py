# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The edge to the real robot: what its position-direct topics are to be told.

TEO's control boards are YARP devices, each behind a controlBoard_nws_ros2 (robotology/yarp-devices-ros2). It
listens on ``/teo/<board>/position_direct`` (yarp_control_msgs/PositionDirect: names, positions), takes
positions in radians of every axis that its device calls revolute, and hands on degrees. The Dextra calls all
of its axes revolute (dextra-yarp-devices, IAxisInfoRawImpl.cpp), also those that it counts in millimetres of
tendon: they are sent as if they were degrees, in radians. Set-points are due every 0.02 s, the period of the
boards' CAN bus, and the mode POSITION_DIRECT has to be set before (service ``set_modes``).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from teo_description import COMMANDED_JOINTS
from teo_description.tendons import HAND_AXES, hand_setpoints
from teo_sim_driver.groups import LIMBS
from teo_sim_driver.motion.bezier import FloatArray

# Names of the control boards, of this project's groups of joints.
_BOARDS = {
    "head": "head",
    "trunk": "trunk",
    "left_arm": "leftArm",
    "right_arm": "rightArm",
    "left_hand": "leftHand",
    "right_hand": "rightHand",
}


class PositionDirect(NamedTuple):
    """What one control board is told."""

    topic: str
    names: tuple[str, ...]
    """Of its axes, in its order."""
    positions: tuple[float, ...]
    """[rad]; of tendons, millimetres that are passed off as degrees."""


def position_direct(positions: FloatArray, robot: str = "/teo") -> list[PositionDirect]:
    """Set-points for every control board that signs.

    Args:
        positions: Of the commanded joints, in the driver's order [rad]. Shape (28,).
        robot: What the names of its ports and topics begin with; ``/teoSim`` for its simulation.

    Raises:
        DescriptionError: ``outside_hand_range``.
    """
    values = dict(zip(COMMANDED_JOINTS, positions.tolist(), strict=True))
    setpoints = np.radians(hand_setpoints(COMMANDED_JOINTS, positions))
    values.update(zip((axis.joint for axis in HAND_AXES), setpoints.tolist(), strict=True))
    return [
        PositionDirect(
            f"{robot}/{_BOARDS[group.name]}/position_direct",
            group.joints,
            tuple(values[name] for name in group.joints),
        )
        for group in LIMBS
    ]
