# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`ros2 bag convert`: writes bags anew, as a file says with the keys that rosbag2's own command reads.

The keys: rosbag2's README, "Converting bags".
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import yaml

from teo_ros2cli.bags.conversion import OutputBag, convert
from teo_ros2cli.bags.file_writer import DEFAULT_PRESET, PRESETS
from teo_ros2cli.bags.foreign_bag import open_any_bag
from teo_ros2cli.bags.selection import TopicSelection
from teo_ros2cli.cli.bag.console import bag_errors, warn
from teo_ros2cli.cli.options import full_name, pattern
from teo_ros2cli.errors import Ros2CliError

# Keys of rosbag2 that say what holds here anyway, with the values that mean it.
_ACCEPTED: Mapping[str, tuple[Any, ...]] = {
    "storage_id": ("", "mcap"),
    "rmw_serialization_format": ("", "cdr"),
    "compression_mode": ("", "none"),
    "compression_format": ("", "zstd"),
    "storage_config_uri": ("",),
    "compression_queue_size": (0, 1),
    "compression_threads": (0,),
    "all_services": (False,),
    "services": ([],),
    "exclude_services": ([],),
    "include_unpublished_topics": (False, True),
}
# Keys that are followed, with what holds unless they are given: the type of that is theirs.
_DEFAULTS: Mapping[str, Any] = {
    "uri": "",
    "max_bagfile_size": 0,
    "max_bagfile_duration": 0,
    "storage_preset_profile": "",
    "all_topics": False,
    "all": False,
    "topics": [],
    "topic_types": [],
    "regex": "",
    "exclude_regex": "",
    "exclude_topics": [],
    "exclude_topic_types": [],
    "include_hidden_topics": False,
}
_KINDS = {str: "a text", int: "a number", bool: "true or false", list: "a list"}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the verb's arguments."""
    parser.add_argument(
        "-i",
        "--input",
        action="append",
        nargs="+",
        required=True,
        metavar=("URI", "STORAGE_ID"),
        help="Bag to read: its directory or a file, of ROS 2 in MCAP or SQLite, or of ROS 1; repeatable. "
        "The storage identifier is accepted; the bag itself tells how it is stored.",
    )
    parser.add_argument(
        "-o", "--output-options", type=Path, required=True, help="YAML file that says which bags to write"
    )


@bag_errors()
def run(options: argparse.Namespace) -> int:
    """Read the bags, write those of the file, and say how many messages each has got.

    Raises:
        Ros2CliError: `outputs_invalid`, `bag_unwritable`, or as of `read_outputs`, `open_any_bag`, `convert`.
    """
    for words in options.input:
        if len(words) > 2:
            raise Ros2CliError(
                "invalid_input", f"-i takes a bag and its storage identifier, got {' '.join(words)}"
            )
    outputs = read_outputs(options.output_options)
    bags = [open_any_bag(Path(words[0])) for words in options.input]
    for bag in bags:
        for problem in bag.problems:
            warn(problem)
    try:
        counts = convert(bags, outputs, warn)
    except OSError as error:
        raise Ros2CliError("bag_unwritable", f"The bags cannot be written: {error}") from error
    for output, count in zip(outputs, counts, strict=True):
        print(f"'{output.directory}': {count} messages")
    return 0


def read_outputs(path: Path) -> tuple[OutputBag, ...]:
    """Read the file that says what is to come out; where it names no topics, all do.

    Raises:
        Ros2CliError: `outputs_invalid`, naming the key, what it takes and what came; `invalid_regex`.
    """
    try:
        tree = yaml.safe_load(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        raise Ros2CliError("outputs_invalid", f"'{path}' cannot be read: {error}") from error
    entries = tree.get("output_bags") if isinstance(tree, dict) else None
    if not isinstance(entries, list) or not entries:
        raise Ros2CliError(
            "outputs_invalid",
            f"'{path}' must have a list `output_bags` with a bag at least, such as - uri: out",
        )
    return tuple(_output(entry, f"'{path}', output_bags[{i}]") for i, entry in enumerate(entries))


def _output(entry: Any, where: str) -> OutputBag:
    if not isinstance(entry, dict):
        raise Ros2CliError("outputs_invalid", f"{where} must be a mapping, got {entry!r}")
    for key, value in entry.items():
        if key in _ACCEPTED:
            if value not in _ACCEPTED[key]:
                words = " or ".join(map(repr, _ACCEPTED[key]))
                raise Ros2CliError("outputs_invalid", f"{where}: `{key}` can only be {words}, got {value!r}")
        elif key not in _DEFAULTS:
            known = ", ".join(_DEFAULTS)
            raise Ros2CliError("outputs_invalid", f"{where}: there is no key `{key}`; there are {known}")
        elif type(value) is not type(_DEFAULTS[key]):
            kind = _KINDS[type(_DEFAULTS[key])]
            raise Ros2CliError("outputs_invalid", f"{where}: `{key}` must be {kind}, got {value!r}")
    values = {**_DEFAULTS, **entry}
    if not values["uri"]:
        raise Ros2CliError("outputs_invalid", f"{where} lacks `uri`, the directory to write")
    preset = values["storage_preset_profile"] or DEFAULT_PRESET
    if preset not in PRESETS:
        raise Ros2CliError(
            "outputs_invalid",
            f"{where}: `storage_preset_profile` must be one of {', '.join(PRESETS)}, got {preset!r}",
        )
    if min(values["max_bagfile_size"], values["max_bagfile_duration"]) < 0:
        raise Ros2CliError("outputs_invalid", f"{where}: sizes and durations must not be below 0")
    some = values["topics"] or values["topic_types"] or values["regex"]
    return OutputBag(
        directory=Path(values["uri"]),
        selection=TopicSelection(
            everything=values["all_topics"] or values["all"] or not some,
            names=frozenset(map(full_name, values["topics"])),
            types=frozenset(values["topic_types"]),
            pattern=pattern(values["regex"]),
            excluded_names=frozenset(map(full_name, values["exclude_topics"])),
            excluded_types=frozenset(values["exclude_topic_types"]),
            excluded_pattern=pattern(values["exclude_regex"]),
            include_hidden=values["include_hidden_topics"],
        ),
        preset=preset,
        max_size=values["max_bagfile_size"],
        max_duration=values["max_bagfile_duration"],
    )
