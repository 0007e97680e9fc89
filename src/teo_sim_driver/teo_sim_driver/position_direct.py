# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The edge to the real TEO: what its position-direct topics are to be told.

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

from teo_description.errors import DescriptionError
from teo_description.hand_setpoints import hand_setpoints
from teo_description.humanoid import Humanoid
from teo_sim_driver.motion.bezier import FloatArray


class PositionDirect(NamedTuple):
    """What one control board is told."""

    topic: str
    names: tuple[str, ...]
    """Of its axes, in its order."""
    positions: tuple[float, ...]
    """[rad]; of tendons, millimetres that are passed off as degrees."""


def position_direct(humanoid: Humanoid, positions: FloatArray, robot: str = "/teo") -> list[PositionDirect]:
    """Set-points for every control board that signs.

    Args:
        humanoid: A robot whose description names its control boards.
        positions: Of the commanded joints, in the driver's order [rad]. Shape (joints,).
        robot: What the names of its ports and topics begin with; ``/teoSim`` for its simulation.

    Raises:
        DescriptionError: ``outside_hand_range``; ``no_boards``.
    """
    controllers = humanoid.file.controllers
    if controllers is None:
        message = f"expected a robot whose robot.yaml names its control boards, got {humanoid.name}"
        raise DescriptionError("no_boards", message)
    told = positions.copy()
    hands = humanoid.columns(humanoid.hand("left") + humanoid.hand("right"))
    told[hands] = np.radians(hand_setpoints(humanoid, positions[hands]))
    return [
        PositionDirect(
            f"{robot}/{controllers.boards[limb]}/position_direct",
            joints,
            tuple(told[humanoid.columns(joints)].tolist()),
        )
        for limb, joints in humanoid.limbs.items()
    ]
