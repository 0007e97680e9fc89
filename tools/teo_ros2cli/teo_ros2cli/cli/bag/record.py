# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`ros2 bag record`: records topics into a bag."""

from __future__ import annotations

import argparse
import datetime
import os
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from teo_ros2cli.bags.mcap_file import DEFAULT_PRESET, PRESETS
from teo_ros2cli.bags.selection import TopicSelection
from teo_ros2cli.bags.writer import BagWriter
from teo_ros2cli.cli.bag.console import SPACE, bag_errors, keys, stop_signals, warn
from teo_ros2cli.cli.options import full_name, key_value, non_negative_int, pattern, positive_int
from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.graph.cli_node import cli_node, executor_of
from teo_ros2cli.graph.discovery import settle
from teo_ros2cli.graph.recorder import Recorder, RecorderSettings
from teo_ros2cli.qos import read_overrides

# Longest time in which a signal or a key is not looked at [s].
_STEP = 0.05


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the verb's arguments."""
    parser.add_argument(
        "topics_positional", nargs="*", metavar="topic", help="Topics to record (same as --topics)"
    )
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        help="Destination of the bagfile to create, defaults to a timestamped folder in the current "
        "directory.",
    )
    parser.add_argument(
        "-s", "--storage", default="mcap", choices=("mcap",), help="Storage identifier to be used"
    )
    _add_selection(parser)
    parser.add_argument(
        "--include-unpublished-topics",
        action="store_true",
        help="Discover and record topics which have no publisher yet, so that their first message is not "
        "missed.",
    )
    parser.add_argument(
        "--include-hidden-topics", action="store_true", help="Discover and record hidden topics as well."
    )
    parser.add_argument(
        "--no-discovery",
        action="store_true",
        help="Disables topic auto discovery during recording: only topics present at startup will be "
        "recorded.",
    )
    parser.add_argument(
        "-p",
        "--polling-interval",
        type=positive_int,
        default=100,
        help="Time in ms to wait between querying available topics for recording. Default: 100.",
    )
    parser.add_argument(
        "--ignore-leaf-topics", action="store_true", help="Ignore topics without a subscription."
    )
    parser.add_argument(
        "--qos-profile-overrides-path",
        type=Path,
        help="Path to a yaml file defining overrides of the QoS profile for specific topics.",
    )
    parser.add_argument(
        "-f", "--serialization-format", default="cdr", choices=("cdr", ""), help="Accepted; always cdr."
    )
    parser.add_argument(
        "-b",
        "--max-bag-size",
        type=non_negative_int,
        default=0,
        help="Maximum size in bytes before the bagfile will be split. Default: 0, no splitting by size.",
    )
    parser.add_argument(
        "-d",
        "--max-bag-duration",
        type=non_negative_int,
        default=0,
        help="Maximum duration in seconds before the bagfile will be split. Default: 0, no splitting by "
        "time.",
    )
    parser.add_argument(
        "--max-cache-size",
        type=non_negative_int,
        default=100 * 1024 * 1024,
        help="Maximum size in bytes of messages that wait for being written. Default: 100 MiB. 0 for no "
        "limit.",
    )
    parser.add_argument(
        "--disable-keyboard-controls", action="store_true", help="Disables keyboard controls for recorder"
    )
    parser.add_argument("--start-paused", action="store_true", help="Start the recorder in a paused state.")
    parser.add_argument(
        "--use-sim-time",
        action="store_true",
        help="Use simulation time for message timestamps by subscribing to the /clock topic. Until first "
        "/clock message is received, no messages will be written to bag.",
    )
    parser.add_argument("--node-name", default="rosbag2_recorder", help="Specify the recorder node name.")
    parser.add_argument(
        "--custom-data",
        type=key_value,
        metavar="KEY=VALUE",
        nargs="*",
        action="extend",
        default=[],
        help='Store the custom data in metadata under "rosbag2_bagfile_information/custom_data". The last '
        "value of a key holds.",
    )
    parser.add_argument(
        "--storage-preset-profile",
        default=DEFAULT_PRESET,
        choices=tuple(PRESETS),
        help=f"How the file is laid out: uncompressed chunks, no chunks, zstd chunks of 256 KiB or of 4 MiB. "
        f"Default: {DEFAULT_PRESET}.",
    )
    parser.add_argument(
        "--compression-mode", default="none", choices=("none",), help="Accepted; chunks are compressed."
    )
    parser.add_argument(
        "--log-level",
        default="info",
        choices=("debug", "info", "warn", "error", "fatal"),
        help="Logging level.",
    )


def _add_selection(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--topics", nargs="+", default=[], metavar="Topic", help="Space-delimited list of topics to record."
    )
    parser.add_argument(
        "--topic-types",
        nargs="+",
        default=[],
        metavar="TopicType",
        help="Space-delimited list of topic types to record.",
    )
    parser.add_argument("-a", "--all", action="store_true", help="Record all topics (exclude hidden topics).")
    parser.add_argument(
        "--all-topics", action="store_true", help="Record all topics (exclude hidden topics)."
    )
    parser.add_argument(
        "-e",
        "--regex",
        default="",
        help="Record only topics containing provided regular expression. Note: --all or --all-topics will "
        "override --regex.",
    )
    parser.add_argument(
        "--exclude-regex",
        "-x",
        default="",
        help="Exclude topics containing provided regular expression. Works on top of the other selections.",
    )
    parser.add_argument(
        "--exclude-topic-types",
        nargs="+",
        default=[],
        metavar="TopicType",
        help="Topic types not being recorded.",
    )
    parser.add_argument(
        "--exclude-topics", nargs="+", default=[], metavar="Topic", help="Topics not being recorded."
    )


@bag_errors()
def run(options: argparse.Namespace) -> int:
    """Record until SIGINT or SIGTERM comes, then finish the bag.

    Raises:
        Ros2CliError: `nothing_selected`, `invalid_regex`, `invalid_overrides`, `output_exists`,
            `output_unwritable`, or `bag_unwritable`.
    """
    stopped = stop_signals()
    if options.topics_positional:
        warn('Positional "topics" argument deprecated. Please use optional "--topics" argument instead.')
    selection = _selection(options)
    overrides = read_overrides(options.qos_profile_overrides_path)
    directory = options.output or Path(datetime.datetime.now().strftime("rosbag2_%Y_%m_%d-%H_%M_%S"))
    if directory.exists():
        raise Ros2CliError("output_exists", f"Output folder '{directory}' already exists.")

    from rclpy.logging import LoggingSeverity

    settings = RecorderSettings(
        selection=selection,
        polling_interval=options.polling_interval * 1e-3,
        discovery=not options.no_discovery,
        include_unpublished=options.include_unpublished_topics,
        ignore_leaf=options.ignore_leaf_topics,
        overrides=overrides,
        cache_size=options.max_cache_size,
        start_paused=options.start_paused,
        use_sim_time=options.use_sim_time,
    )
    with (
        cli_node(options.node_name, use_sim_time=options.use_sim_time, own_signals=True) as node,
        keys(not options.disable_keyboard_controls) as pressed,
    ):
        log = node.get_logger()
        log.set_level(LoggingSeverity[options.log_level.upper()])
        writer = BagWriter(
            Path.cwd() / directory,
            preset=options.storage_preset_profile,
            max_duration=options.max_bag_duration * 1_000_000_000,
            max_size=options.max_bag_size,
            custom_data=dict(options.custom_data),
            ros_distro=os.environ.get("ROS_DISTRO", "jazzy"),
        )
        recorder = Recorder(node, writer, settings)
        try:
            if pressed is not None:
                log.info("Press SPACE for pausing/resuming")
            log.info("Listening for topics...")
            if not settings.discovery:
                settle(node)
            log.info("Recording..." if not settings.start_paused else "Waiting for recording: paused.")
            _spin(node, recorder, stopped, pressed)
            log.info("Writing remaining messages from cache to the bag. It may take a while")
        finally:
            recorder.finish()
            log.info("Recording stopped")
    return 0


def _spin(
    node: Any, recorder: Recorder, stopped: Callable[[], bool], pressed: Callable[[], str] | None
) -> None:
    with executor_of(node) as executor:
        while not stopped():
            recorder.look(time.monotonic())
            if pressed is not None and pressed() == SPACE:
                recorder.toggle_paused()
            executor.spin_once(timeout_sec=_STEP)


def _selection(options: argparse.Namespace) -> TopicSelection:
    names = [*options.topics_positional, *options.topics]
    everything = options.all or options.all_topics
    if not everything and not names and not options.topic_types and not options.regex:
        raise Ros2CliError(
            "nothing_selected",
            "Need to specify at least one option out of --all, --all-topics, --topics, --topic-types or "
            "--regex",
        )
    return TopicSelection(
        everything=everything,
        names=frozenset(map(full_name, names)),
        types=frozenset(options.topic_types),
        pattern=pattern(options.regex),
        excluded_names=frozenset(map(full_name, options.exclude_topics)),
        excluded_types=frozenset(options.exclude_topic_types),
        excluded_pattern=pattern(options.exclude_regex),
        include_hidden=options.include_hidden_topics,
    )
