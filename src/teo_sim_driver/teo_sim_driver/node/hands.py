# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the real hands would be told, where their controllers count in something else than joint angles."""

from __future__ import annotations

from array import array

import numpy as np
from rclpy.node import Node
from rclpy.qos import QoSProfile
from std_msgs.msg import Float64MultiArray, MultiArrayDimension, MultiArrayLayout

from teo_description.hand_setpoints import hand_setpoints, setpoint_axes
from teo_description.humanoid import SIDES, Humanoid
from teo_description.schema.hand import AXES
from teo_sim_driver.motion.bezier import FloatArray

# Steps between hand set-points [1]: 50 Hz at the usual rate, as often as TEO's CAN bus is synchronised.
_EVERY = 2


class HandPublisher:
    """Publishes the hands' set-points when they change, on `dextra_setpoints`."""

    def __init__(self, node: Node, qos: QoSProfile, humanoid: Humanoid) -> None:
        """Publish those of a humanoid whose hands have `setpoint_axes`."""
        self._publisher = node.create_publisher(Float64MultiArray, "dextra_setpoints", qos)
        self._humanoid = humanoid
        self._columns = humanoid.columns(humanoid.hand("left") + humanoid.hand("right"))
        count = len(self._columns)
        units = (axis.unit for axis in setpoint_axes(humanoid, "left"))
        axes = ", ".join(f"{name} [{unit}]" for name, unit in zip(AXES, units, strict=True))
        self._layout = MultiArrayLayout(
            dim=[
                MultiArrayDimension(label=f"hand: {', '.join(SIDES)}", size=len(SIDES), stride=count),
                MultiArrayDimension(label=f"axis: {axes}", size=count // 2, stride=count // 2),
            ]
        )
        self._last: FloatArray | None = None
        self._steps = 0

    def step(self, positions: FloatArray) -> None:
        """Enter the positions of the commanded joints [rad]. Shape (joints,)."""
        self._steps += 1
        hands = positions[self._columns]
        if self._steps % _EVERY != 1 or (self._last is not None and np.array_equal(hands, self._last)):
            return
        self._last = hands
        setpoints = hand_setpoints(self._humanoid, hands)
        self._publisher.publish(Float64MultiArray(layout=self._layout, data=array("d", setpoints.tobytes())))
