# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What learns signs: the retriever, and the node that turns what it sees into entries of the table."""

from launch import LaunchDescription

from teo_bringup.up import launch_description


def generate_launch_description() -> LaunchDescription:
    """Describe what is started."""
    return launch_description("retriever", "capture")
