"""`ros2 bag`: its verbs."""

from __future__ import annotations

from collections.abc import Sequence

from teo_ros2cli.cli.dispatch import Entry, choose

VERBS = {
    "info": Entry("teo_ros2cli.cli.bag_info", "Print information about a bag to the screen"),
    "play": Entry("teo_ros2cli.cli.bag_play", "Play back ROS data from a bag"),
    "record": Entry("teo_ros2cli.cli.bag_record", "Record ROS data to a bag"),
}


def run_words(words: Sequence[str]) -> int:
    """Run the verb that the words name."""
    return choose("ros2 bag", "Various rosbag related sub-commands", "verb", VERBS, words)
