# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What signs: translator, executor and driver. When one of them ends, all do."""

from launch import LaunchDescription

from teo_bringup.graph import SIGNING
from teo_bringup.up import launch_description


def generate_launch_description() -> LaunchDescription:
    """Describe what is started."""
    return launch_description(*SIGNING)
