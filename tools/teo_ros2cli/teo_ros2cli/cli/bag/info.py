# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`ros2 bag info`: what a bag holds."""

from __future__ import annotations

import argparse
from pathlib import Path

from teo_ros2cli.bags.foreign_bag import open_any_bag
from teo_ros2cli.bags.summary import summary
from teo_ros2cli.cli.bag.console import bag_errors, warn

# Largest bag that is read through to check it [bytes]: some seconds.
VERIFIED_SIZE = 1024**3


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the verb's arguments."""
    parser.add_argument("bag_path", type=Path, help="Bag to open: its directory or a file of it")
    parser.add_argument("-s", "--storage", default="", help="Accepted; the bag itself tells how it is stored")
    parser.add_argument("-t", "--topic-name", action="store_true", help="Only display topic names.")


@bag_errors()
def run(options: argparse.Namespace) -> int:
    """Print the summary, after a warning for each thing that is wrong with the bag.

    Raises:
        Ros2CliError: The bag cannot be read at all; codes as of `open_any_bag`.
    """
    bag = open_any_bag(options.bag_path)
    if not bag.problems and bag.size <= VERIFIED_SIZE:
        bag = open_any_bag(options.bag_path, verify=True)
    for problem in bag.problems:
        warn(problem)
    if options.topic_name:
        for topic, _ in bag.metadata.topics:
            print(topic.name)
        return 0
    if not bag.metadata.messages:
        warn(f"'{options.bag_path}' holds no messages")
    elif bag.problems:
        warn(f"{bag.metadata.messages} messages can be read")
    print(summary(bag.metadata, bag.size))
    return 0
