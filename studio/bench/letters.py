# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The manual alphabet: is what a robot plays for a letter most like the recording it was made from?

How they are compared says `teo_sign_authoring.alphabet.letter_likeness`.
"""

from __future__ import annotations

import numpy as np

from report import Figure
from teo_description.robot import Robot
from teo_motion.planner import Planner
from teo_sign_authoring.alphabet.letter_likeness import Likeness, letter_likenesses
from teo_sign_languages import DEFAULT_LANGUAGE
from teo_signs.look_up_table import Lut, default_lut_directory
from teo_signs.tokens import Kind, Token


def measure(language: str = DEFAULT_LANGUAGE, robot: str = "teo") -> list[Figure]:
    """How long those that move take, which letters are most like their own recording, which look alike."""
    lut = Lut.open(default_lut_directory(language, robot), language=language, robot=robot)
    found = letter_likenesses(Robot.load(robot), lut.language, lut)
    captured = [one for one in found if one.posture == 0]
    # Letters have as many alternatives as were found for them; without one they are as captured.
    played = list({one.letter: one for one in found}.values())
    planner = Planner(lut, robot=Robot.load(robot))
    moving = [
        gloss for gloss, sign in lut.items() if sign.kind == "letter" and np.ptp(sign.knots, axis=0).any()
    ]
    plans = [planner.plan([Token(gloss=gloss, kind=Kind.LETTER)]) for gloss in moving]
    seconds = sum(plan.timings[0].duration for plan in plans)
    return [
        Figure(f"the {len(moving)} letters that move, together", f"{seconds:.1f} s"),
        Figure("letters most like their own recording, as captured", _count(captured)),
        Figure("letters most like their own recording, in their last alternative", _count(played)),
        *(
            Figure(f"{one.letter}, alternative {one.posture}: looks like", _apart(one))
            for one in found
            if one.look_alikes or not one.right
        ),
    ]


def _count(found: list[Likeness]) -> str:
    """How many are right, and which are not."""
    wrong = [f"{one.letter} as {one.ranking[0]}" for one in found if not one.right]
    return f"{len(found) - len(wrong)} of {len(found)}; not: {', '.join(wrong) or 'none'}"


def _apart(one: Likeness) -> str:
    """How different the own recording is, and its look-alikes."""
    names = [one.letter, *(name for name in one.look_alikes if name != one.letter)]
    return ", ".join(f"{name} {one.distances[name]:.1f}" for name in names)
