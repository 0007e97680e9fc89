# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How near the parts of a robot come that touch in signs."""

from __future__ import annotations

import re

from teo_description.robot import Robot


def touching(robot: Robot, pose: dict[str, float]) -> float:
    """How near a hand is to anything, or one arm to the other [m]; far away is 1 m."""
    near = [
        item
        for item in robot.contacts(robot.configuration(pose), 0.06)
        if re.search("Hand|Finger|FrontalRightWrist|FrontalLeftWrist", item.first + item.second)
        or not re.search("root|Trunk|Neck|Hip|Knee", item.first + item.second)
    ]
    return min((item.distance for item in near), default=1.0)
