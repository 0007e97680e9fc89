# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the launch files of this package have in common."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from ament_index_python.packages import get_package_share_directory

from teo_sign_languages import DEFAULT_LANGUAGE

if TYPE_CHECKING:
    from launch import LaunchDescription


def launch_description(*nodes: tuple[str, str]) -> LaunchDescription:
    """Describe nodes that start together, all in one namespace, and end together.

    The arguments `params_file`, `namespace`, `robot`, `language` and `use_sim_time` are declared for
    `ros2 launch`.

    Args:
        nodes: Package and executable of each.
    """
    # Here, as this package is installed where there is no `launch` too: `start` does without it.
    from launch import LaunchDescription
    from launch.actions import DeclareLaunchArgument, Shutdown
    from launch.substitutions import LaunchConfiguration
    from launch_ros.actions import Node

    parameters = Path(get_package_share_directory("teo_bringup")) / "config" / "parameters.yaml"
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                "params_file", default_value=str(parameters), description="Parameters of the nodes."
            ),
            DeclareLaunchArgument("namespace", default_value="", description="Before every topic and node."),
            DeclareLaunchArgument(
                "robot",
                default_value="teo",
                description="Name of the robot, whatever the parameter file says.",
            ),
            DeclareLaunchArgument(
                "language",
                default_value=DEFAULT_LANGUAGE,
                description="Sign language, by its ISO 639-3 code, whatever the parameter file says.",
            ),
            DeclareLaunchArgument(
                "use_sim_time", default_value="false", description="Take the time from the topic clock."
            ),
            *(
                Node(
                    package=package,
                    executable=executable,
                    namespace=LaunchConfiguration("namespace"),
                    parameters=[
                        LaunchConfiguration("params_file"),
                        {
                            "robot": LaunchConfiguration("robot"),
                            "language": LaunchConfiguration("language"),
                            "use_sim_time": LaunchConfiguration("use_sim_time"),
                        },
                    ],
                    output="screen",
                    on_exit=Shutdown(reason=f"{executable} ended"),
                )
                for package, executable in nodes
            ),
        ]
    )
