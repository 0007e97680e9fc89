# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What signs: translator, executor and driver. When one of them ends, all do."""

from pathlib import Path

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, Shutdown
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

_PARAMETERS = Path(get_package_share_directory("teo_bringup")) / "config" / "parameters.yaml"


def _node(package: str, executable: str) -> Node:
    return Node(
        package=package,
        executable=executable,
        namespace=LaunchConfiguration("namespace"),
        parameters=[LaunchConfiguration("params_file")],
        output="screen",
        on_exit=Shutdown(reason=f"{executable} ended"),
    )


def generate_launch_description() -> LaunchDescription:
    """Describe what is started."""
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                "params_file", default_value=str(_PARAMETERS), description="Parameters of the nodes."
            ),
            DeclareLaunchArgument("namespace", default_value="", description="Before every topic and node."),
            _node("teo_sign_translator", "translator_node"),
            _node("teo_lut_executor", "executor_node"),
            _node("teo_sim_driver", "driver_node"),
        ]
    )
