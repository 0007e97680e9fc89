# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What drives each joint: the torque it can give and the inertia that it adds.

Of a robot whose `robot.yaml` says nothing of its drives the torques are the URDF's efforts.
"""

from __future__ import annotations

from collections.abc import Mapping

from teo_description.humanoid import Humanoid
from teo_description.schema.controllers import Servo

# Inertia of a drive of which nothing is published [kg m^2]: those of TEO, a rotor of 1e-5 kg m^2 behind a
# gear of 100:1 in body and arms, and that of a small gearmotor in the hands.
BODY_INERTIA, HAND_INERTIA = 0.1, 0.01


def servos_of(humanoid: Humanoid) -> Mapping[str, Servo]:
    """The drive of each commanded joint."""
    if humanoid.file.controllers is not None:
        servos = humanoid.file.controllers.servos
        return {name: servos.body.get(name, servos.hand) for name in humanoid.commanded_joints}
    efforts = humanoid.effort_limits(humanoid.commanded_joints).tolist()
    return {
        name: Servo(torque=effort, inertia=BODY_INERTIA if name in humanoid.body_joints else HAND_INERTIA)
        for name, effort in zip(humanoid.commanded_joints, efforts, strict=True)
    }
