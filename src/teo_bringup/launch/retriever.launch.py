# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What sees: people's skeletons from the images of a depth camera, whose own driver is started elsewhere."""

from pathlib import Path

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, Shutdown
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

_PARAMETERS = Path(get_package_share_directory("teo_bringup")) / "config" / "parameters.yaml"


def generate_launch_description() -> LaunchDescription:
    """Describe what is started."""
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                "params_file", default_value=str(_PARAMETERS), description="Parameters of the nodes."
            ),
            DeclareLaunchArgument("namespace", default_value="", description="Before every topic and node."),
            Node(
                package="teo_skeleton_retriever",
                executable="retriever_node",
                namespace=LaunchConfiguration("namespace"),
                parameters=[LaunchConfiguration("params_file")],
                output="screen",
                on_exit=Shutdown(reason="retriever_node ended"),
            ),
        ]
    )
