# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How well each robot shows each language: letters told apart, signs within tolerance, refused, how slow.

`python -m signs.robots` in `bench`; `--every 10` looks at each tenth sign. What is counted says `lut fit`,
which is the same code; a sentence's seconds are those of three words and a spelled name, as planned.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import NamedTuple

import numpy as np

from report import Figure
from teo_description.robot import Robot
from teo_motion.planner import Planner
from teo_sign_authoring.alphabet.letter_likeness import letter_likenesses
from teo_sign_authoring.transfer.fit import fit_table, median_stretch, within_share
from teo_sign_authoring.transfer.language_signs import LanguageSigns
from teo_sign_languages import Language, available_languages, load_language
from teo_signs.errors import PlanError
from teo_signs.look_up_table import Lut
from teo_signs.tokens import Kind, Token

# Words of a sentence, and letters of its name; sentences that are looked at.
_WORDS, _LETTERS, _SENTENCES = 3, 3, 12


class RobotFigures(NamedTuple):
    """How well a robot shows a language."""

    letters: str
    within: str
    refused: str
    stretch: str
    sentence: str


def robot_figures(language: Language, robot: str, every: int = 1) -> RobotFigures:
    """Look at a robot's table of a language, at each so manieth sign."""
    signs = LanguageSigns(language, Robot.load(robot))
    lut = Lut.open(language.table(robot), language=language.code, robot=robot)
    likenesses = [one for one in letter_likenesses(signs.robot, language, lut) if one.posture == 0]
    fits = fit_table(
        language.code, robot, signs.glosses[::every], language.table(robot), jobs=1, done=lambda _: None
    )
    return RobotFigures(
        letters=f"{sum(one.right for one in likenesses)} of {len(language.alphabet.letters)}",
        within=f"{100.0 * within_share(fits):.0f} % of {len(fits)}",
        refused=f"{sum(bool(fit.refused) for fit in fits)}",
        stretch=f"{median_stretch(fits):.2f}",
        sentence=f"{_seconds(signs.robot, lut):.1f} s",
    )


def _seconds(robot: Robot, lut: Lut) -> float:
    """Median duration of sentences of words and letters at random, the same for every robot [s]."""
    random = np.random.default_rng(0)
    tables = [lut.language.table(name) for name in lut.language.robots]
    files = sorted(path.name for path in tables[0].glob("*.json"))
    glosses = [Path(name).stem for name in files if all((table / name).exists() for table in tables)]
    words = [gloss for gloss in glosses if lut[gloss].kind == "lexical"]
    letters = [gloss for gloss in glosses if lut[gloss].kind == "letter"]
    planner = Planner(lut, robot=robot, least_standing="sketched", language=lut.language)
    found = []
    for _ in range(_SENTENCES):
        tokens = [Token(gloss=gloss) for gloss in random.choice(words, _WORDS).tolist()]
        tokens += [
            Token(gloss=gloss, kind=Kind.LETTER) for gloss in random.choice(letters, _LETTERS).tolist()
        ]
        try:
            found.append(planner.plan(tokens).duration)
        except PlanError:  # counted among the refused where a sign is to blame
            continue
    return float(np.median(found))


def measure(every: int = 10) -> list[Figure]:
    """Of every language and robot that has a table of it."""
    return [
        Figure(f"{language.code} on {robot}: {name.replace('_', ' ')}", value)
        for code in available_languages()
        for language in [load_language(code)]
        for robot in language.robots
        for name, value in robot_figures(language, robot, every)._asdict().items()
    ]


def main() -> None:
    """Print the figures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--every", type=int, default=10, help="look at each so manieth sign")
    for figure in measure(parser.parse_args().every):
        print(f"{figure.what}: {figure.value}")


if __name__ == "__main__":
    main()
