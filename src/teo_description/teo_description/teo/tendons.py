# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The axes of the real Dextra hands, as their devices count them.

Inside the project the axis of a finger or thumb is the flexion of its proximal phalanx [rad]. The device
(RoboticsLab UC3M, repository dextra-yarp-devices) takes for a finger the tendon wound on its spool, 0..20 mm,
for the thumb 0..10 mm, and for the thumb's abductor the angle of its servo, 0..90 deg. No measured map from
tendon to angle is public: that of ``robots/teo/robot.yaml`` is the straight line between the ends of both
ranges, with a slack tendon and with all of it wound: 7 to 85 deg for a finger, -90 (standing out) to 90 deg
for the thumb.
"""

from __future__ import annotations

from teo_description.hand_setpoints import setpoint_axes
from teo_description.humanoid import load_humanoid

# The left device's axes, in its order: abductor, thumb, index, middle, ring, pinky.
LEFT_AXES = setpoint_axes(load_humanoid("teo"), "left")

# The right device's axes, in the same order.
RIGHT_AXES = setpoint_axes(load_humanoid("teo"), "right")

# Both devices' axes, in the order of `hand_setpoints`.
HAND_AXES = LEFT_AXES + RIGHT_AXES
