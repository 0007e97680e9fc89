"""`ros2 topic`: its verbs."""

from __future__ import annotations

from collections.abc import Sequence

from teo_ros2cli.cli.dispatch import Entry, choose

VERBS = {
    "bw": Entry("teo_ros2cli.cli.topic_bw", "Display bandwidth used by topic"),
    "delay": Entry("teo_ros2cli.cli.topic_delay", "Display delay of topic from timestamp in header"),
    "echo": Entry("teo_ros2cli.cli.topic_echo", "Output messages from a topic"),
    "find": Entry("teo_ros2cli.cli.topic_list", "Output a list of available topics of a given type", "find"),
    "hz": Entry("teo_ros2cli.cli.topic_hz", "Print the average receiving rate to screen"),
    "info": Entry("teo_ros2cli.cli.topic_info", "Print information about a topic"),
    "list": Entry("teo_ros2cli.cli.topic_list", "Output a list of available topics"),
    "pub": Entry("teo_ros2cli.cli.topic_pub", "Publish a message to a topic"),
    "type": Entry("teo_ros2cli.cli.topic_list", "Print a topic's type", "type"),
}


def run_words(words: Sequence[str]) -> int:
    """Run the verb that the words name."""
    return choose("ros2 topic", "Various topic related sub-commands", "verb", VERBS, words)
