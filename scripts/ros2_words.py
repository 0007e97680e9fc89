# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Writes which words of the genuine `ros2` our own has: `python scripts/ros2_words.py`; a test compares."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Mapping
from pathlib import Path

import yaml

from teo_ros2cli.cli.dispatch import Entry, Group, add_arguments
from teo_ros2cli.main import COMMANDS

_PACKAGE = Path(__file__).parents[1] / "tools" / "teo_ros2cli"
FILE = _PACKAGE / "COMMANDS.md"
GENUINE = _PACKAGE / "test" / "golden" / "genuine_words.yaml"
_HEAD = """\
# The words of `ros2`

Which verbs and options of ros2cli 0.32 and rosbag2 0.26 (ROS 2 Jazzy) this package's `ros2` has; `--help`
explains them. `scripts/ros2_words.py` makes this page from the genuine command's words
([genuine_words.yaml](test/golden/genuine_words.yaml)) and from this one's own parsers; a test compares them.
`--no-daemon` is accepted: there is no daemon. A verb or an option that is missing is refused with the usage
and status 2. Verbs that these tables do not name have every option.

"""
# Every verb that looks at the graph takes these; some genuine ones do not.
_ACCEPTED = ("--spin-time", "--use-sim-time", "--no-daemon")
# Why a verb is not there, by command and verb; verb "" is for all of a command.
_ABSENT = {
    ("bag", "burst"): "`play --start-paused` and the key for the next message do it",
    ("bag", "list"): "of plugins, of which there are none",
    ("component", "standalone"): "starts a container of `rclcpp_components`, which is not among the wheels",
    ("doctor", "hello"): "`multicast` and `topic pub` from one machine to the other show as much",
    ("launch", ""): "`launch` is not among the wheels; `ros2 run teo_bringup up` starts nodes without",
    ("pkg", "create"): "its templates belong to `ros2pkg`",
    ("security", ""): "the wheels' Fast DDS has no security plugins",
}


def words_table() -> str:
    """Give the text of the page."""
    genuine: dict[str, dict[str, list[str]]] = yaml.safe_load(GENUINE.read_text(encoding="utf-8"))
    own = dict(_own(COMMANDS))
    wanted = {
        (command, verb): options for command, verbs in genuine.items() for verb, options in verbs.items()
    }
    assert own.keys() <= wanted.keys(), "a verb that the genuine command lacks"
    rows: dict[str, list[str]] = {"other": [], "absent": []}
    for words, theirs in sorted(wanted.items()):
        name = f"`{' '.join(filter(None, words))}`"
        if words not in own:
            why = _ABSENT.get(words)
            row = f"| {name} | {why} |\n" if why else f"| `{words[0]}` | {_ABSENT[words[0], '']} |\n"
            if row not in rows["absent"]:
                rows["absent"].append(row)
            continue
        missing = [option for option in theirs if option not in own[words]]
        added = [option for option in own[words] if option not in theirs and option not in _ACCEPTED]
        if missing or added:
            rows["other"].append(f"| {name} | {_list(missing)} | {_list(added)} |\n")
    return (
        f"{_HEAD}| with other options | missing | only here |\n|---|---|---|\n{''.join(rows['other'])}\n"
        f"| missing | why |\n|---|---|\n{''.join(rows['absent'])}"
    )


def _own(
    entries: Mapping[str, Entry | Group], before: str = ""
) -> Iterator[tuple[tuple[str, str], list[str]]]:
    for name, entry in entries.items():
        if isinstance(entry, Group):
            yield from _own(entry.entries, name)
            continue
        parser = argparse.ArgumentParser(add_help=False)
        add_arguments(parser, entry)
        # argparse shows its options in no other form that a program can read.
        options = [action.option_strings for action in parser._actions if action.option_strings]
        longest = [max(strings, key=len) for strings in options]
        yield (before or name, name if before else ""), longest


def _list(options: list[str]) -> str:
    return " ".join(f"`{option}`" for option in options)


if __name__ == "__main__":
    FILE.write_text(words_table(), encoding="utf-8")
