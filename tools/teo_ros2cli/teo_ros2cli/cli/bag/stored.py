# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`ros2 bag info`, `convert` and `reindex`: bags that are stored already."""

from __future__ import annotations

import argparse
import shutil
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import yaml

from teo_ros2cli.bags.bag import open_bag
from teo_ros2cli.bags.foreign_bag import open_any_bag
from teo_ros2cli.bags.mcap_file import DEFAULT_PRESET, PRESETS
from teo_ros2cli.bags.metadata import BagMetadata
from teo_ros2cli.bags.rewriting import OutputBag, convert, reindex
from teo_ros2cli.bags.selection import TopicSelection
from teo_ros2cli.cli.bag.console import bag_errors, warn
from teo_ros2cli.cli.options import full_name, pattern
from teo_ros2cli.errors import Ros2CliError

# Largest bag that is read through to check it [bytes]: some seconds.
_VERIFIED_SIZE = 1024**3


def add_info_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the verb's arguments."""
    parser.add_argument("bag_path", type=Path, help="Bag to open: its directory or a file of it")
    parser.add_argument("-s", "--storage", default="", help="Accepted; the bag itself tells how it is stored")
    parser.add_argument("-t", "--topic-name", action="store_true", help="Only display topic names.")


@bag_errors()
def run_info(options: argparse.Namespace) -> int:
    """Print the summary, after a warning for each thing that is wrong with the bag.

    Raises:
        Ros2CliError: The bag cannot be read at all; codes as of `open_any_bag`.
    """
    bag = open_any_bag(options.bag_path)
    if not bag.problems and bag.size <= _VERIFIED_SIZE:
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


_LABEL_WIDTH = 19
_SECOND = 1_000_000_000


def summary(metadata: BagMetadata, size: int) -> str:
    """Return the text that `ros2 bag info` prints.

    Args:
        metadata: What the bag holds.
        size: Size of its files [bytes].
    """
    start = metadata.start if metadata.messages else 0
    topics = [
        f"Topic: {topic.name} | Type: {topic.type} | Count: {count} | Serialization Format: "
        f"{topic.serialization_format}"
        for topic, count in metadata.topics
    ]
    entries: list[tuple[str, Sequence[str]]] = [
        ("Files:", [record.path for record in metadata.files]),
        ("Bag size:", [size_text(size)]),
        ("Storage id:", [metadata.storage]),
        ("ROS Distro:", [metadata.ros_distro or "unknown"]),
        ("Duration:", [f"{_seconds_text(metadata.duration)}s"]),
        ("Start:", [moment_text(start)]),
        ("End:", [moment_text(start + metadata.duration)]),
        ("Messages:", [str(metadata.messages)]),
        ("Topic information:", topics),
    ]
    lines = [""]
    for label, values in entries:
        for i, value in enumerate(values or [""]):
            lines.append((label if i == 0 else "").ljust(_LABEL_WIDTH) + value)
    lines += ["Service:           0", "Service information: "]
    return "\n".join(lines)


def _seconds_text(nanoseconds: int) -> str:
    """Return a time with nine decimals [s]."""
    return f"{nanoseconds // _SECOND}.{nanoseconds % _SECOND:09d}"


def moment_text(nanoseconds: int) -> str:
    """Return a moment [ns since the epoch] in local time, and in seconds since the epoch."""
    local = time.localtime(nanoseconds // _SECOND)
    date = time.strftime("%b %e %Y %H:%M:%S", local)
    return f"{date}.{nanoseconds % _SECOND:09d} ({_seconds_text(nanoseconds)})"


def size_text(size: int) -> str:
    """Return a size [bytes] in the largest unit that leaves at least 1."""
    value = float(size)
    units = ("B", "KiB", "MiB", "GiB", "TiB")
    unit = 0
    while value >= 1024 and unit < len(units) - 1:
        value /= 1024
        unit += 1
    return f"{value:.{0 if unit == 0 else 1}f} {units[unit]}"


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


def add_convert_arguments(parser: argparse.ArgumentParser) -> None:
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
def run_convert(options: argparse.Namespace) -> int:
    """Read the bags, write those of the file, and say how many messages each has got.

    Raises:
        Ros2CliError: `outputs_invalid`, `bag_unwritable`, or as of `open_any_bag` and `rewriting.convert`.
    """
    for words in options.input:
        if len(words) > 2:
            raise Ros2CliError(
                "invalid_input", f"-i takes a bag and its storage identifier, got {' '.join(words)}"
            )
    outputs = _read_outputs(options.output_options)
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


def _read_outputs(path: Path) -> tuple[OutputBag, ...]:
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


def add_reindex_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the verb's arguments."""
    parser.add_argument("bag_path", type=Path, help="Bag to repair: its directory or a file of it")
    parser.add_argument(
        "storage_id", nargs="?", default="mcap", choices=("mcap",), help="Storage identifier of the bag"
    )
    parser.add_argument(
        "-o", "--output", type=Path, help="Repair a copy, and leave the bag as it is (default: in place)"
    )


@bag_errors()
def run_reindex(options: argparse.Namespace) -> int:
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
