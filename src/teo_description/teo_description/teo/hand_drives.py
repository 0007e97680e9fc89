# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How fast the axes of the Dextra hand can be moved, by the gearmotors that it is built with.

A brushed micro metal gearmotor winds a finger's tendon on a spool of 4.5 mm radius (Finger.cpp of
roboticslab-uc3m/Dextra). Two gearboxes are in use: 968.41:1 in the firmware of the hand's Teensy 3.1,
379.17:1 in that of its Teensy 4.0, with a spool of its own for each (spool-1000, spool-380 among the parts).
Which winding the motors have is not published, so each gearbox is here with the slowest and the fastest that
is sold. No speed of the hand itself has been published; dextra-yarp-devices' simulation says 10 deg/s.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from teo_description.errors import DescriptionError
from teo_description.humanoid import load_humanoid
from teo_description.teo.tendons import HAND_AXES

# Radius of the spool that winds a tendon [mm].
_SPOOL_RADIUS_MM = 4.5

# Share of its speed without load that a loaded motor keeps [1]: at its greatest efficiency, where a gearmotor
# of 298:1 turns at 34 instead of 45 rpm (Pololu, data sheet of micro metal gearmotors, rev. 2.0, 2018). A
# tendon is then pulled with about 12 N at 379:1. What the springs of a finger ask for is not published.
_LOADED = 34.0 / 45.0

# Speed of the thumb's abductor without load [rad/s], a TowerPro MG90 servo: micro servos take 0.12 s for
# 60 deg, the slowest figure that they are sold with.
_SERVO_SPEED = math.radians(60.0) / 0.12

# Greatest speed of every joint of body, arms and head [rad/s]: maxVel of nodes/common-ipos.ini.
BODY_SPEED = math.radians(50.0)


@dataclass(frozen=True, kw_only=True)
class HandDrive:
    """The gearmotors of a hand.

    Attributes:
        transmission: Turns of the motor for one of the spool [1].
        published_speed: Speed without load of a gearmotor with the same winding [rpm] ...
        published_transmission: ... and this gearbox [1].
    """

    transmission: float
    published_speed: float
    published_transmission: float

    @property
    def tendon_speed(self) -> float:
        """Speed of a tendon under load [mm/s]."""
        turns = self.published_speed * self.published_transmission / self.transmission / 60.0
        return _LOADED * turns * math.tau * _SPOOL_RADIUS_MM

    def speeds(self) -> Mapping[str, float]:
        """Greatest speed of each of the twelve hand axes [rad/s].

        Thumb and abductor could be several times as fast as the fingers. They are not: the whole robot stops
        as late as its fastest joint, so no axis is given more than the fingers or, if that is more, the body.
        """
        drive = {
            axis.joint: math.radians((axis.high - axis.low) / axis.travel) * self.tendon_speed
            if axis.unit == "mm"
            else _LOADED * _SERVO_SPEED
            for axis in HAND_AXES
        }
        teo = load_humanoid("teo")
        most = max(drive[teo.hand("left")[-1]], BODY_SPEED)
        return {joint: min(drive[joint], most) for joint in teo.hand("left") + teo.hand("right")}


# The drives by name. Published speeds: LP 6V rows of the data sheet above; 75:1 HPCB 12V, Pololu item 5215.
HAND_DRIVES: Mapping[str, HandDrive] = MappingProxyType(
    {
        "spool_380": HandDrive(transmission=379.17, published_speed=45.0, published_transmission=297.92),
        "spool_380_high_power": HandDrive(
            transmission=379.17, published_speed=450.0, published_transmission=75.81
        ),
        "spool_1000": HandDrive(transmission=968.41, published_speed=13.0, published_transmission=986.41),
        "spool_1000_high_power": HandDrive(
            transmission=968.41, published_speed=450.0, published_transmission=75.81
        ),
    }
)

# The newest hand (Dextra TPMG90S, whose parts include TEO's wrist) has the spool for 379:1; of the windings
# the slowest: a hand with any of them follows.
DEFAULT_HAND_DRIVE = "spool_380"


def hand_speeds(drive: str) -> Mapping[str, float]:
    """Greatest speed of each of the twelve hand axes with a drive of `HAND_DRIVES` [rad/s].

    Raises:
        DescriptionError: ``unknown_hand_drive``.
    """
    if drive not in HAND_DRIVES:
        message = f"hand_drive: expected one of {', '.join(HAND_DRIVES)}, got {drive!r}"
        raise DescriptionError("unknown_hand_drive", message)
    return HAND_DRIVES[drive].speeds()
