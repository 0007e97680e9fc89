# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the real Dextra hands would be told: the topic `dextra_setpoints`."""

from __future__ import annotations

from array import array

import numpy as np
from rclpy.node import Node
from rclpy.qos import QoSProfile
from std_msgs.msg import Float64MultiArray, MultiArrayDimension, MultiArrayLayout

from teo_description import COMMANDED_JOINTS
from teo_description.tendons import HAND_AXES, hand_setpoints
from teo_sim_driver.motion.bezier import FloatArray

# Steps between hand set-points [1]: 50 Hz at the usual rate, as often as TEO's CAN bus is synchronised.
_EVERY = 2

_JOINTS = tuple(axis.joint for axis in HAND_AXES)
_COUNT = len(_JOINTS)
if COMMANDED_JOINTS[-_COUNT:] != _JOINTS:
    raise RuntimeError(
        f"expected the hand axes to be the last commanded joints, got {COMMANDED_JOINTS[-_COUNT:]}"
    )
_LAYOUT = MultiArrayLayout(
    dim=[
        MultiArrayDimension(label="hand: left, right", size=2, stride=_COUNT),
        MultiArrayDimension(
            label="axis: abductor [deg], thumb, index, middle, ring, pinky [mm]", size=6, stride=_COUNT // 2
        ),
    ]
)


class HandPublisher:
    """Publishes the hands' set-points when they change."""

    def __init__(self, node: Node, qos: QoSProfile) -> None:
        self._publisher = node.create_publisher(Float64MultiArray, "dextra_setpoints", qos)
        self._last: FloatArray | None = None
        self._steps = 0

    def step(self, positions: FloatArray) -> None:
        """Enter the positions of the commanded joints [rad]. Shape (joints,)."""
        self._steps += 1
        hands = positions[-_COUNT:]
        if self._steps % _EVERY != 1 or (self._last is not None and np.array_equal(hands, self._last)):
            return
        self._last = hands
        setpoints = hand_setpoints(_JOINTS, hands)
        self._publisher.publish(Float64MultiArray(layout=_LAYOUT, data=array("d", setpoints.tobytes())))
