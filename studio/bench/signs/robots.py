# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How well each robot shows each language: letters told apart, signs within tolerance, refused, how slow.

What is counted says `lut fit`, which is the same code; a sentence's seconds are those of three words and a
spelled name, as planned.
"""

from __future__ import annotations

from collections.abc import Iterator

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


def measure(every: int = 10) -> list[Figure]:
    """Figures of every language and robot that has a table of it, at each so manieth sign."""
    return [
        figure
        for language in map(load_language, available_languages())
        for robot in language.robots
        for figure in _figures(language, robot, every)
    ]


def _figures(language: Language, robot: str, every: int) -> Iterator[Figure]:
    signs = LanguageSigns(language, Robot.load(robot))
    lut = Lut.open(language.table(robot), language=language.code, robot=robot)
    likenesses = [one for one in letter_likenesses(signs.robot, language, lut) if one.posture == 0]
    fits = fit_table(
        language.code, robot, signs.glosses[::every], language.table(robot), jobs=1, done=lambda _: None
    )
    right = f"{sum(one.right for one in likenesses)} of {len(language.alphabet.letters)}"
    for what, value in (
        ("letters most like their recording, as captured", right),
        ("signs within tolerance", f"{100.0 * within_share(fits):.0f} % of {len(fits)}"),
        ("signs refused", f"{sum(bool(fit.refused) for fit in fits)}"),
        ("time over the time asked for, median", f"{median_stretch(fits):.2f}"),
        ("a sentence", f"{_seconds(signs.robot, lut):.1f} s"),
    ):
        yield Figure(f"{language.code} on {robot}: {what}", value)


def _seconds(robot: Robot, lut: Lut) -> float:
    """Median duration of sentences of words and letters at random, the same for every robot [s]."""
    random = np.random.default_rng(0)
    names = [{path.stem for path in lut.language.table(name).glob("*.json")} for name in lut.language.robots]
    glosses = sorted(set.intersection(*names))
    words, letters = (
        [gloss for gloss in glosses if lut[gloss].kind == kind] for kind in ("lexical", "letter")
    )
    planner = Planner(lut, robot=robot, least_standing="sketched", language=lut.language)
    found = []
    for _ in range(_SENTENCES):
        tokens = [Token(gloss=gloss) for gloss in random.choice(words, _WORDS).tolist()]
        name = random.choice(letters, _LETTERS).tolist()
        tokens += [Token(gloss=gloss, kind=Kind.LETTER) for gloss in name]
        try:
            found.append(planner.plan(tokens).duration)
        except PlanError:  # counted among the refused where a sign is to blame
            continue
    return float(np.median(found))
