# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Humanoids as data: URDF, joint groups, limits, self-collision and a renderer without a display."""

from teo_description.errors import DescriptionError
from teo_description.humanoid import Humanoid, JointLimits, available_robots, load_humanoid

__all__ = ["DescriptionError", "Humanoid", "JointLimits", "available_robots", "load_humanoid"]
