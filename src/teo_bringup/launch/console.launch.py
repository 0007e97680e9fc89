# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What shows it: the console, whose page watches a graph that is started elsewhere."""

from launch import LaunchDescription

from teo_bringup.up import launch_description


def generate_launch_description() -> LaunchDescription:
    """Describe what is started."""
    return launch_description("console")
