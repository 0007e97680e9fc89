# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The verbs of `ros2 bag`: a module each, loaded when called. The bags themselves: `teo_ros2cli.bags`."""

from __future__ import annotations

from teo_ros2cli.cli.dispatch import Entry

VERBS = {
    "convert": Entry(f"{__name__}.convert", "Write bags anew: merged, filtered, in another layout"),
    "info": Entry(f"{__name__}.info", "Print information about a bag to the screen"),
    "play": Entry(f"{__name__}.play", "Play back ROS data from a bag"),
    "reindex": Entry(f"{__name__}.reindex", "Repair a bag that was not finished, and its metadata"),
    "record": Entry(f"{__name__}.record", "Record ROS data to a bag"),
}
