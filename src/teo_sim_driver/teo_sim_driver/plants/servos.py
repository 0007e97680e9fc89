# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What drives each joint, as far as it is published: the torque it can give and the inertia that it adds.

Motors, gears and drives of the body: roboticslab-uc3m/teo-configuration-files (share/robots/teo/nodes) and
teo-developer-manual (docs/csv/motores-motores.csv). The URDF's 30 N m are placeholders, with which the trunk
could not hold what it carries when it bows.
"""

from __future__ import annotations

from typing import NamedTuple

from teo_description import COMMANDED_JOINTS
from teo_description.joints import BODY_JOINTS


class Servo(NamedTuple):
    """The drive of a joint, seen from the joint."""

    torque: float
    """The most that it gives, without losses [N m]."""
    inertia: float
    """Of the motor's rotor [kg m^2]."""


# Torque constants of the motors, by maxon's order number [N m/A].
_TORQUE_CONSTANTS = {339282: 0.0706, 339287: 0.101, 400108: 0.101, 411815: 0.0533}

# Greatest currents of the drives, Technosoft iPOS [A].
_CURRENTS = {3602: 3.2, 3604: 10.0, 4808: 20.0}

# Of each joint of the body: motor, ratio of the gear, drive.
_BODY = {
    "AxialNeck": (339282, 100, 3604),
    "FrontalNeck": (339282, 100, 3604),
    "AxialTrunk": (411815, 160, 4808),
    "FrontalTrunk": (339287, 480, 4808),
    **dict.fromkeys(("FrontalLeftShoulder", "SagittalLeftShoulder", "FrontalLeftElbow"), (411815, 160, 3604)),
    **dict.fromkeys(("AxialLeftShoulder", "AxialLeftWrist", "AxialRightWrist"), (400108, 100, 3604)),
    **dict.fromkeys(("FrontalLeftWrist", "FrontalRightWrist"), (339282, 100, 3602)),
    **dict.fromkeys(
        ("FrontalRightShoulder", "SagittalRightShoulder", "FrontalRightElbow"), (411815, 160, 3604)
    ),
    "AxialRightShoulder": (411815, 100, 3604),
}

# Inertia of a rotor behind the smallest gear of the body, 100:1 [kg m^2]; those of TEO's are not public, this
# is one of 1e-5 kg m^2, as flat motors of 50 W have.
_BODY_INERTIA = 0.1

# Torque of a hand axis [N m]: a stalled gearmotor pulls the tendon with 50 N, as it does with 12 N when it
# turns at 34 of 45 rpm (`teo_description.hand_drives`); 20 mm of tendon bend a finger by 78 deg.
_HAND_TORQUE = 0.73

# Inertia of the rotor of such a motor, 1.5 g of 3 mm radius, behind 379:1 and the tendon [kg m^2].
_HAND_INERTIA = 0.01


def _body(motor: int, ratio: int, drive: int) -> Servo:
    return Servo(_TORQUE_CONSTANTS[motor] * _CURRENTS[drive] * ratio, _BODY_INERTIA)


SERVOS = {
    name: _body(*_BODY[name]) if name in BODY_JOINTS else Servo(_HAND_TORQUE, _HAND_INERTIA)
    for name in COMMANDED_JOINTS
}
