# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`ros2 bag play`: publishes what a bag holds."""

from __future__ import annotations

import argparse
import math
import re
from collections.abc import Callable, Mapping
from pathlib import Path

from teo_ros2cli.bags.bag import Bag
from teo_ros2cli.bags.foreign_bag import open_any_bag
from teo_ros2cli.bags.selection import TopicSelection
from teo_ros2cli.cli.bag.console import DOWN, RIGHT, SPACE, UP, bag_errors, keys, stop_signals, warn
from teo_ros2cli.cli.options import full_name, non_negative_float, pattern, positive_float, positive_int
from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.graph.cli_node import cli_node
from teo_ros2cli.graph.player import Player, PlayerSettings
from teo_ros2cli.qos import read_overrides

# Rate of `/clock` if none is given [1/s].
_DEFAULT_CLOCK = 40.0
_RATE_STEP = 1.1
# Time that reliable subscriptions get to receive the last messages before the publishers leave [s].
_ACKNOWLEDGEMENT = 1.0


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the verb's arguments."""
    parser.add_argument("bag_path", type=Path, help="Bag to open: its directory or a file of it")
    parser.add_argument("-s", "--storage", default="", help="Accepted; the bag itself tells how it is stored")
    parser.add_argument(
        "--read-ahead-queue-size",
        type=positive_int,
        default=1000,
        help="Size of message queue that is read ahead of playing. Default: 1000.",
    )
    parser.add_argument(
        "-r",
        "--rate",
        type=positive_float,
        default=1.0,
        help="Rate at which to play back messages. Valid range > 0.0.",
    )
    parser.add_argument(
        "--topics", nargs="+", default=[], metavar="Topic", help="Topics to replay. Default: all."
    )
    parser.add_argument(
        "-e", "--regex", default="", help="Play only topics containing provided regular expression."
    )
    parser.add_argument(
        "--exclude-topics", nargs="+", default=[], metavar="Topic", help="Topics not being played."
    )
    parser.add_argument(
        "-x", "--exclude-regex", default="", help="Exclude topics containing provided regular expression."
    )
    parser.add_argument(
        "--qos-profile-overrides-path",
        type=Path,
        help="Path to a yaml file defining overrides of the QoS profile for specific topics.",
    )
    parser.add_argument(
        "-l",
        "--loop",
        action="store_true",
        help="Start again at the beginning on reaching the end, indefinitely.",
    )
    parser.add_argument(
        "--remap",
        "-m",
        nargs="+",
        default=[],
        metavar="OLD:=NEW",
        help='Topics to be remapped: "old_topic:=new_topic".',
    )
    clock = parser.add_mutually_exclusive_group()
    clock.add_argument(
        "--clock",
        metavar="HZ",
        type=positive_float,
        nargs="?",
        const=_DEFAULT_CLOCK,
        default=0.0,
        help=f"Publish to /clock at a specific frequency in Hz ({_DEFAULT_CLOCK:g} if none is given). "
        f"Default: not. The bag's own /clock is left out.",
    )
    clock.add_argument(
        "--clock-topics",
        nargs="+",
        default=[],
        metavar="Topic",
        help="Topics that make /clock go on when a message of them is published.",
    )
    clock.add_argument(
        "--clock-topics-all", action="store_true", help="Publish /clock before each message that is played."
    )
    parser.add_argument(
        "-d",
        "--delay",
        type=non_negative_float,
        default=0.0,
        help="Sleep duration before play (each loop), in seconds.",
    )
    parser.add_argument(
        "--playback-duration", type=float, default=-1.0, help="Playback duration, in seconds. Negative: all."
    )
    until = parser.add_mutually_exclusive_group()
    until.add_argument(
        "--playback-until-sec", type=float, help="Playback until timestamp, in seconds since the epoch."
    )
    until.add_argument(
        "--playback-until-nsec", type=int, help="Playback until timestamp, in nanoseconds since the epoch."
    )
    parser.add_argument(
        "--start-offset", type=non_negative_float, default=0.0, help="Start this many seconds into the bag."
    )
    parser.add_argument(
        "--wait-for-all-acked",
        type=non_negative_float,
        metavar="TIMEOUT",
        help="Wait at the end until all published messages are acknowledged, for so many milliseconds; 0 for "
        "ever. Default: 1000.",
    )
    parser.add_argument(
        "--disable-keyboard-controls", action="store_true", help="Disables keyboard controls for playback"
    )
    parser.add_argument("-p", "--start-paused", action="store_true", help="Start the playback player paused.")
    parser.add_argument(
        "--disable-loan-message", action="store_true", help="Accepted; messages are never loaned."
    )
    parser.add_argument("--node-name", default="rosbag2_player", help="Name of the player node.")


@bag_errors()
def run(options: argparse.Namespace) -> int:
    """Play the bag until its end, or until SIGINT or SIGTERM comes.

    Raises:
        Ros2CliError: `invalid_remap`, `invalid_regex`, `invalid_overrides`, or as of `open_any_bag`.
    """
    stopped = stop_signals()
    selection = _selection(options)
    remap = dict(map(_remapping, options.remap))
    overrides = read_overrides(options.qos_profile_overrides_path)
    bag = open_any_bag(options.bag_path)
    for problem in bag.problems:
        warn(problem)
    _check_selected(options, bag)

    until = options.playback_until_nsec
    if options.playback_until_sec is not None and options.playback_until_sec >= 0:
        until = round(options.playback_until_sec * 1e9)
    settings = PlayerSettings(
        selection=selection,
        remap=remap,
        rate=options.rate,
        start_offset=options.start_offset,
        duration=options.playback_duration if options.playback_duration >= 0 else None,
        until=until if until is not None and until >= 0 else None,
        delay=options.delay,
        loop=options.loop,
        clock=options.clock,
        clock_before=_clock_topics(options),
        start_paused=options.start_paused,
        overrides=overrides,
        read_ahead=options.read_ahead_queue_size,
        wait_acknowledged=_acknowledgement_time(options.wait_for_all_acked),
    )
    with (
        cli_node(options.node_name, own_signals=True) as node,
        keys(not options.disable_keyboard_controls) as pressed,
    ):
        log = node.get_logger()
        log.info(f"Set rate to {settings.rate:g}")
        player = Player(node, bag, settings, stopped=stopped, command=_key_action(pressed))
        if pressed is not None:
            for name, effect, _ in _KEYS.values():
                log.info(f"Press {name} for {effect}")
        if not player.topics:
            log.warning("There is no topic to play.")
        log.info(f"Playback until timestamp: {-1 if settings.until is None else settings.until}")
        player.play()
        log.info(f"Played {player.played} messages.")
    return 0


def _acknowledgement_time(milliseconds: float | None) -> float:
    """Return how long to wait for acknowledgements at the end [s]."""
    if milliseconds is None:
        return _ACKNOWLEDGEMENT
    return milliseconds * 1e-3 if milliseconds > 0 else math.inf


# By the characters that a key sends: its name, what it is for, and that.
_KEYS: Mapping[str, tuple[str, str, Callable[[Player], None]]] = {
    SPACE: ("SPACE", "Pause/Resume", lambda player: player.toggle_paused()),
    RIGHT: ("CURSOR_RIGHT", "Play Next Message", lambda player: player.play_next()),
    UP: ("CURSOR_UP", "Increase Rate 10%", lambda player: player.change_rate(_RATE_STEP)),
    DOWN: ("CURSOR_DOWN", "Decrease Rate 10%", lambda player: player.change_rate(1 / _RATE_STEP)),
}


def _key_action(pressed: Callable[[], str] | None) -> Callable[[Player], None]:
    def act(player: Player) -> None:
        if pressed is not None and (key := _KEYS.get(pressed())):
            key[-1](player)

    return act


def _clock_topics(options: argparse.Namespace) -> Callable[[str], bool]:
    """Return what tells whether `/clock` is published before a topic's messages."""
    topics = frozenset(map(full_name, options.clock_topics))
    return lambda topic: options.clock_topics_all or topic in topics


def _selection(options: argparse.Namespace) -> TopicSelection:
    excluded = set(map(full_name, options.exclude_topics))
    if options.clock or options.clock_topics or options.clock_topics_all:
        excluded.add("/clock")
    return TopicSelection(
        everything=not options.topics and not options.regex,
        names=frozenset(map(full_name, options.topics)),
        pattern=pattern(options.regex),
        excluded_names=frozenset(excluded),
        excluded_pattern=pattern(options.exclude_regex),
        include_hidden=True,
    )


def _check_selected(options: argparse.Namespace, bag: Bag) -> None:
    known = {topic.name for topic, _ in bag.metadata.topics}
    for name in map(full_name, options.topics):
        if name not in known:
            warn(f"Topic '{name}' is not in the bag; it holds {', '.join(sorted(known)) or 'none'}")


_REMAP = re.compile(r"(?P<old>[^:=]+):=(?P<new>[^:=]+)")


def _remapping(rule: str) -> tuple[str, str]:
    match = _REMAP.fullmatch(rule)
    if match is None:
        raise Ros2CliError("invalid_remap", f"Remapping {rule!r} is not of the form old_topic:=new_topic")
    return full_name(match["old"]), full_name(match["new"])
