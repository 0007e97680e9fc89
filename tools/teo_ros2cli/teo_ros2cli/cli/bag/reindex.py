# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`ros2 bag reindex`: repairs a bag whose recorder did not finish."""

from __future__ import annotations

import argparse
import shutil
from pathlib import Path

from teo_ros2cli.bags.bag import open_bag
from teo_ros2cli.bags.reindex import reindex
from teo_ros2cli.cli.bag.console import bag_errors, warn
from teo_ros2cli.errors import Ros2CliError


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the verb's arguments."""
    parser.add_argument("bag_path", type=Path, help="Bag to repair: its directory or a file of it")
    parser.add_argument(
        "storage_id", nargs="?", default="mcap", choices=("mcap",), help="Storage identifier of the bag"
    )
    parser.add_argument(
        "-o", "--output", type=Path, help="Repair a copy, and leave the bag as it is (default: in place)"
    )


@bag_errors()
def run(options: argparse.Namespace) -> int:
    """Repair the bag's files, write its metadata, and say what could not be saved.

    Raises:
        Ros2CliError: `output_exists`; `bag_unwritable`, the disk is full or the bag belongs to somebody else;
            others as of `open_bag`.
    """
    path: Path = options.bag_path
    try:
        if options.output is not None:
            open_bag(path)  # what is no bag is not copied
            if options.output.exists():
                raise Ros2CliError("output_exists", f"Output '{options.output}' already exists.")
            (shutil.copytree if path.is_dir() else shutil.copy2)(path, options.output)
            path = options.output
        bag = reindex(path, print)
    except OSError as error:
        raise Ros2CliError("bag_unwritable", f"'{path}' cannot be repaired: {error}") from error
    for problem in bag.problems:
        warn(problem)
    print(f"Reindexing complete: {bag.metadata.messages} messages in {len(bag.files)} file(s).")
    return 0
