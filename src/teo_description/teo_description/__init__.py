# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""TEO's robot description: URDF, joint groups, limits, self-collision and a renderer without a display."""

from teo_description.errors import DescriptionError
from teo_description.hand_drives import DEFAULT_HAND_DRIVE, HAND_DRIVES
from teo_description.home import HOME
from teo_description.joints import (
    ALL_JOINTS,
    BODY_JOINTS,
    COMMANDED_JOINTS,
    HEAD,
    LEFT_ARM,
    LEFT_HAND,
    LEFT_LEG,
    LEG_JOINTS,
    RIGHT_ARM,
    RIGHT_HAND,
    RIGHT_LEG,
    TRUNK,
    mirrored_name,
)
from teo_description.limits import JointLimits, description_hash, joint_limits, urdf_path, urdf_text

__all__ = [
    "ALL_JOINTS",
    "BODY_JOINTS",
    "COMMANDED_JOINTS",
    "DEFAULT_HAND_DRIVE",
    "HAND_DRIVES",
    "HEAD",
    "HOME",
    "LEFT_ARM",
    "LEFT_HAND",
    "LEFT_LEG",
    "LEG_JOINTS",
    "RIGHT_ARM",
    "RIGHT_HAND",
    "RIGHT_LEG",
    "TRUNK",
    "DescriptionError",
    "JointLimits",
    "description_hash",
    "joint_limits",
    "mirrored_name",
    "urdf_path",
    "urdf_text",
]
