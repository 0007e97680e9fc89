# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How fast TEO spells names of 3 to 10 letters, and whether random words keep every limit.

A word's time is from when its first letter stands to when its last one has been held, over its letters. The
baseline in the same run is the alphabet as captured, letter by letter, each held as long as its recording
holds it. The bound is the least time of the slowest joint from letter to letter, with the same strokes and
holds.
"""

from __future__ import annotations

import multiprocessing
import os
from dataclasses import replace
from functools import cache, partial
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from planning import as_driven
from report import Figure
from teo_common.text_folding import without_accents
from teo_description.humanoid import load_humanoid
from teo_description.robot import Robot
from teo_motion.planner import Planner
from teo_motion.sentence.plan import Plan
from teo_motion.sentence.posture_choice import choose_postures
from teo_motion.trajectory.limits import MotionLimits
from teo_names import COMMANDED_JOINTS
from teo_sign_translator.data_files import data_file
from teo_signs.errors import PlanError
from teo_signs.lexicon import Lexicon
from teo_signs.look_up_table import Lut, default_lut_directory
from teo_signs.sign import Sign
from teo_signs.tokens import Kind, Token

REST = load_humanoid().ready

_SHORTEST, _LONGEST = 3, 10
_BATCH = 25
_TEO = load_humanoid("teo")
_OTHERS = tuple(drive for drive in _TEO.hand_drives if drive != _TEO.default_hand_drive)


class Word(NamedTuple):
    """How long one word takes.

    Attributes:
        letters: How many.
        time: From its first letter to the end of its last [s].
        bound: The same if every way took the least time of its slowest joint [s].
        joints: The slowest joint of each way.
    """

    letters: int
    time: float
    bound: float
    joints: tuple[str, ...]


def measure(names: int = 200, words: int = 1000) -> list[Figure]:
    """So many names, now and as captured; then so many random words."""
    letters = _names(names)
    with multiprocessing.get_context("spawn").Pool(os.cpu_count()) as pool:
        now = pool.map(_spelled, letters, chunksize=10)
        before = pool.map(_spelled_as_captured, letters, chunksize=10)
        drives = {drive: pool.map(partial(_spelled, drive=drive), letters, chunksize=10) for drive in _OTHERS}
        shares = [range(begin, min(begin + _BATCH, words)) for begin in range(0, words, _BATCH)]
        checked = pool.map(_random_words, shares)
    slowest = [joint for word in now for joint in word.joints]
    order = sorted(set(slowest), key=slowest.count, reverse=True)
    joints = ", ".join(f"{joint} {slowest.count(joint)}" for joint in order[:5])
    what = f"seconds a letter, {len(letters)} names of {_SHORTEST} to {_LONGEST} letters"
    return [
        Figure(what, _figure(now)),
        Figure("baseline: letters as captured and held", _figure(before)),
        *(Figure(f"with the hand drive {drive}", _figure(other)) for drive, other in drives.items()),
        Figure(f"slowest joint, of {len(slowest)} ways", joints),
        Figure(
            f"{words} random words of {_SHORTEST} to {_LONGEST} letters",
            f"{sum(item[0] for item in checked)} limits broken, {sum(item[1] for item in checked)} refused "
            f"for self-collision, nearest approach {1000.0 * min(item[2] for item in checked):.0f} mm",
        ),
    ]


def _names(count: int) -> list[list[str]]:
    """The letters of the commonest names of the translator's lexicon, in its order."""
    words: list[list[str]] = []
    for line in data_file("lexicon/names.tsv").read_text(encoding="utf-8").splitlines():
        name = "" if line.startswith("#") else without_accents(line.split("\t")[0].upper())
        if not name.isalpha():
            continue
        token = Token(gloss=name, kind=Kind.LEXICAL)
        letters = [item.token.gloss for item in Lexicon(_alphabet()).resolve([token])]
        if _SHORTEST <= len(letters) <= _LONGEST:
            words.append(letters)
    return words[:count]


def _spelled(letters: list[str], drive: str = _TEO.default_hand_drive) -> Word:
    """Plan a word with the alphabet as it is, for a hand with this drive."""
    return _timed([Token(gloss=letter, kind=Kind.LETTER) for letter in letters], _planner(drive), _alphabet())


def _spelled_as_captured(letters: list[str]) -> Word:
    """Plan a word with each letter in its own posture, held as long as recorded."""
    table = _captured()
    hold = _planner().style.letter_hold
    tokens = []
    for letter in letters:
        sign = table[letter]
        still = sign.duration if len(sign.times) == 2 else hold
        tokens.append(Token(gloss=letter, kind=Kind.LETTER, duration_scale=max(still, hold) / hold))
    return _timed(tokens, Planner(table, robot=_robot()), table)


def _timed(tokens: list[Token], planner: Planner, table: dict[str, Sign]) -> Word:
    plan = planner.plan(tokens)
    first, last = plan.timings[0], plan.timings[-1]
    limits = planner.limits
    signed = choose_postures(Lexicon(table).resolve(tokens), start=REST, end=REST, limits=limits)
    ways, joints = 0.0, []
    for one, other in pairwise([item.sign for item in signed]):
        assert one is not None and other is not None
        columns = [COMMANDED_JOINTS.index(name) for name in other.joints]
        times = limits.least_times(other.knots[0] - one.knots[-1], columns)
        if one.gloss != other.gloss:
            joints.append(other.joints[int(times.argmax())])
        ways += float(times.max())
    time = last.start + last.duration - first.start
    within = sum(timing.duration for timing in plan.timings)
    return Word(len(tokens), time, ways + within, tuple(joints))


def _random_words(numbers: range) -> tuple[int, int, float]:
    """Limits broken, words refused, and the nearest that parts of TEO come to each other [m]."""
    broken, refused, nearest = 0, 0, np.inf
    letters = sorted(_alphabet())
    for number in numbers:
        generator = np.random.default_rng(number)
        word = generator.choice(letters, int(generator.integers(_SHORTEST, _LONGEST + 1))).tolist()
        try:
            plan: Plan = _planner().plan([Token(gloss=letter, kind=Kind.LETTER) for letter in word])
        except PlanError as error:
            if error.code != "self_collision":
                raise RuntimeError(f"{'-'.join(word)}: {error.code}") from error
            refused += 1
            continue
        broken += len(as_driven(plan).broken())
        if plan.nearest is not None:
            nearest = min(nearest, plan.nearest.distance)
    return broken, refused, nearest


def _figure(words: list[Word]) -> str:
    each = np.array([word.time / word.letters for word in words])
    bound = np.array([word.bound / word.letters for word in words])
    return (
        f"mean {each.mean():.2f}, median {np.median(each):.2f}, "
        f"90th percentile {np.percentile(each, 90):.2f}; bound of the slowest joint {bound.mean():.2f}"
    )


@cache
def _robot() -> Robot:
    return Robot.load()


@cache
def _alphabet() -> dict[str, Sign]:
    return {gloss: sign for gloss, sign in Lut.open(default_lut_directory()).items() if sign.kind == "letter"}


@cache
def _captured() -> dict[str, Sign]:
    return {letter: replace(sign, alternatives=()) for letter, sign in _alphabet().items()}


@cache
def _planner(drive: str = _TEO.default_hand_drive) -> Planner:
    return Planner(_alphabet(), robot=_robot(), limits=MotionLimits.of_robot(hand_drive=drive))
