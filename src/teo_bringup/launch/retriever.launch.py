# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What sees: people's skeletons from the images of a depth camera, whose own driver is started elsewhere."""

from launch import LaunchDescription

from teo_bringup.up import launch_description


def generate_launch_description() -> LaunchDescription:
    """Describe what is started."""
    return launch_description("retriever")
