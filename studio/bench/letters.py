# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The manual alphabet: is what a robot plays for a letter most like the recording it was made from?

How they are compared says `teo_sign_authoring.alphabet.letter_likeness`.
`python bench/letters.py --language ase` prints the whole table of confusions.
"""

from __future__ import annotations

import argparse

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table

from report import Figure
from teo_description.robot import Robot
from teo_sign_authoring.alphabet.letter_likeness import Likeness, letter_likenesses
from teo_sign_languages import DEFAULT_LANGUAGE
from teo_signs.look_up_table import Lut, default_lut_directory

# Share of the letters that must be most like their own recording: 28 of thirty.
TARGET = 28 / 30


def measure() -> list[Figure]:
    """How many letters are most like their own recording, which are not, and which look alike."""
    found = likenesses(DEFAULT_LANGUAGE)
    captured = [one for one in found if one.posture == 0]
    # Letters have as many alternatives as were found for them; without one they are as captured.
    played = list({one.letter: one for one in found}.values())
    alike = dict.fromkeys(f"{one.letter}/{name}" for one in found for name in one.look_alikes)
    return [
        Figure("letters most like their own recording, as captured", _count(captured)),
        Figure("letters most like their own recording, in their last alternative", _count(played)),
        Figure("letters that the hand hardly separates", ", ".join(alike) or "none"),
    ]


def _count(found: list[Likeness]) -> str:
    """How many are right, and which are not."""
    wrong = [f"{one.letter} as {one.ranking[0]}" for one in found if not one.right]
    right = f"{len(found) - len(wrong)} of {len(found)} (target {round(TARGET * len(found))})"
    return right + (f"; not: {', '.join(wrong)}" if wrong else "")


def likenesses(language: str, robot: str = "teo") -> list[Likeness]:
    """Every letter of a language's table for a robot against every recording."""
    lut = Lut.open(default_lut_directory(language, robot), language=language, robot=robot)
    return letter_likenesses(Robot.load(robot), lut.language, lut)


def main() -> None:
    """Print what each letter is taken for, and which the hand cannot separate."""
    console = Console(width=160)  # thirty columns
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--language", default=DEFAULT_LANGUAGE, help="code of the sign language")
    parser.add_argument("--robot", default="teo", help="name of the robot")
    options = parser.parse_args()
    found = likenesses(options.language, options.robot)
    letters = list(found[0].distances)
    table = Table(options.robot, *letters, title="difference from each recording", box=SIMPLE_HEAD, padding=0)
    for one in found:
        nearest = one.ranking[0]
        cells = [
            f"[{'bold green' if one.right else 'bold red'}]{one.distances[name]:.1f}[/]"
            if name == nearest
            else f"[bold]{one.distances[name]:.1f}[/]"
            if name == one.letter
            else f"[dim]{one.distances[name]:.0f}[/]"
            for name in letters
        ]
        table.add_row(f"[bold]{one.letter}[/]{one.posture or ''}", *cells)
    console.print(table)
    for one in found:
        if not one.right:
            console.print(f"{one.letter} is taken for {one.ranking[0]}: {_differences(one)}")
    for one in found:
        if one.right and one.look_alikes:
            console.print(f"{one.letter} is hardly separated from {_differences(one)}")
    for name, some in (("as captured", 0), ("in their first alternative", 1)):
        console.print(f"{name}: {_count([one for one in found if one.posture == some])}")


def _differences(one: Likeness) -> str:
    """The own recording and its look-alikes, with how different each is."""
    names = [one.letter, *(name for name in one.look_alikes if name != one.letter)]
    return ", ".join(f"{name} {one.distances[name]:.1f}" for name in names)


if __name__ == "__main__":
    main()
