# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Planning: how much processor time a sentence takes, and whether any of 10,000 random plans breaks a limit.

Limits are looked at in what a driver makes of a plan's points, a quintic between each two, every 2 ms.
"""

from __future__ import annotations

import multiprocessing
import os
import time
from contextlib import suppress
from itertools import product
from typing import NamedTuple

import numpy as np
from made_signs import random_table
from thumb_capsules import thumb_gap

from executed_motion import Reached, judged
from report import Figure, percentiles
from signs.random_signs import random_tokens
from teo_description.hand_geometry import hand_table, thumb_gaps
from teo_description.humanoid import SIDES
from teo_description.robot import Robot
from teo_motion.planner import Planner
from teo_motion.sentence.plan import Plan
from teo_motion.sentence.sentence_form import SentenceForm, SentenceType
from teo_signs.errors import PlanError
from teo_signs.look_up_table import Lut, default_lut_directory
from teo_signs.tokens import Kind, Token, parse_printed
from teo_sim_driver import Trajectory

_LETTERS = 10
_WORDS_OF_RANDOM = 6  # of the longest
_LOOK = 0.002  # [s]: a tenth of the time between two points
_BATCH = 50  # plans of one random table
_NEAREST = 3  # moments of a plan at which a library looks at the thumb: those nearest by the table of places
_OWN = 20  # one batch in so many plans from the package's table: ways round the body take a second each
_SIGNS, _WORDS, _SCALES = 8, 3, (0.1, 0.5, 1.0, 2.0)

# Glosses as the translator makes them; what the table lacks is spelled.
_PRINTED = (
    "TÚ BIEN",
    "MI NOMBRE A-N-A",
    "BIEN DÍA",
    "YO EDAD 7",
    "HOLA",
    "VAMOS COMER",
    "DAME MANO",
    "TÚ COLEGIO IR",
    "HOLA MI NOMBRE M-A-R-T-A",
    "CUIDADO ESO ROMPER",
)


class _Batch(NamedTuple):
    """What a number of plans did to the limits."""

    refused: int
    broken: int
    most: Reached


def measure(plans: int = 10_000, sentences: int = 200) -> list[Figure]:
    """Times of so many sentences, then the limits of random plans."""
    figures = [*_times(sentences), *_planning_of_random(sentences), _planning_of_letters(sentences // 4)]
    shares = [range(begin, min(begin + _BATCH, plans)) for begin in range(0, plans, _BATCH)]
    with multiprocessing.get_context("spawn").Pool(os.cpu_count()) as pool:
        batches = pool.map(_random_plans, shares, chunksize=4)
    refused, broken = sum(batch.refused for batch in batches), sum(batch.broken for batch in batches)
    most = Reached(*np.max([batch.most for batch in batches], axis=0).tolist())
    return [
        *figures,
        Figure(f"limit violations in {plans} random plans", str(broken)),
        Figure(
            "the most seen in them, over the limit",
            f"velocity {most.velocity:.5f}, acceleration {most.acceleration:.4f}, jerk {most.jerk:.6f}; "
            f"position {most.beyond:.1e} rad beyond",
        ),
        Figure("refused among them, for self-collision", str(refused)),
    ]


def _times(count: int) -> list[Figure]:
    """Processor time that planning typical sentences takes, self-collision included."""
    planner = Planner(Lut.open(default_lut_directory()), robot=Robot.load())
    sentences = [parse_printed(text) for text in _PRINTED]
    for sentence in sentences:
        planner.plan(sentence)  # reads the entries
    asked = SentenceForm(type=SentenceType.YES_NO_QUESTION, negated=True)
    seconds, with_head, signing = [], [], []
    for index in range(count):
        sentence = sentences[index % len(sentences)]
        began = time.process_time()
        plan = planner.plan(sentence)
        seconds.append(time.process_time() - began)
        signing.append(plan.duration)
        began = time.process_time()
        planner.plan(sentence, form=asked)
        with_head.append(time.process_time() - began)
    return [
        percentiles("plan a sentence", seconds),
        percentiles("the same as negated questions, head and all", with_head),
        Figure("signing time of those sentences", f"median {np.median(signing):.1f} s"),
    ]


def _planning_of_random(count: int) -> list[Figure]:
    """The same of sentences of words and letters drawn from the table, and their thumbs, by a library."""
    table, robot = Lut.open(default_lut_directory()), Robot.load()
    planner, dice = Planner(table, robot=robot), np.random.default_rng(3)
    signs, hand_shapes, seconds, deepest = dict(table), hand_table(robot), [], 0.0
    for _ in range(count):
        tokens = random_tokens(dice, signs, most=_WORDS_OF_RANDOM, scales=(1.0,))
        began = time.process_time()
        plans = []
        with suppress(PlanError):
            plans.append(planner.plan(tokens))
        seconds.append(time.process_time() - began)
        for plan, side in product(plans, SIDES):
            axes = plan.positions[:, robot.humanoid.columns(robot.humanoid.hand(side))]
            nearest = axes[np.argsort(thumb_gaps(hand_shapes, axes))[:_NEAREST]]
            deepest = max(deepest, *(-thumb_gap(robot, hand, side.capitalize()) for hand in nearest))
    return [
        percentiles("plan a random sentence", seconds),
        Figure(f"deepest thumb in a finger in these {count}", f"{1000.0 * deepest:.1f} mm"),
    ]


def _planning_of_letters(count: int) -> Figure:
    table = Lut.open(default_lut_directory())
    planner, dice = Planner(table, robot=Robot.load()), np.random.default_rng(0)
    letters = [gloss for gloss, sign in table.items() if sign.kind == "letter"]
    seconds = []
    for _ in range(count):
        word = dice.choice(letters, _LETTERS).tolist()
        began = time.process_time()
        planner.plan([Token(gloss=letter, kind=Kind.LETTER) for letter in word])
        seconds.append(time.process_time() - began)
    return percentiles(f"plan a word of {_LETTERS} letters", seconds)


def _random_plans(numbers: range) -> _Batch:
    """Plans of one random table, or in some batches of the package's own."""
    dice = np.random.default_rng(numbers.start)
    own = (numbers.start // _BATCH) % _OWN == 0
    table = dict(Lut.open(default_lut_directory())) if own else random_table(dice, signs=6)
    # Every sign of the table, whatever its standing: numbers that are only sketched cannot be spelled.
    robot = Robot.load() if own else None
    planner = Planner(table, robot=robot, max_duration=1e4, least_standing="sketched")
    refused, found = 0, []
    for _ in numbers:
        tokens = random_tokens(dice, table, most=_SIGNS, scales=_SCALES, words=_WORDS)
        try:
            found.append(as_driven(planner.plan(tokens)))
        except PlanError as error:
            if error.code != "self_collision":
                raise RuntimeError(f"batch {numbers}: {error.code}") from error
            refused += 1
    broken = sum(len(reached.broken()) for reached in found)
    return _Batch(refused, broken, Reached(*np.max(found, axis=0).tolist()))


def as_driven(plan: Plan) -> Reached:
    """What a driver that executes a plan does to the limits."""
    path = Trajectory.quintic(*(values.copy() for values in plan.samples))
    times = np.arange(0.0, plan.duration + 4.0 * _LOOK, _LOOK)
    return judged(path.states(times).positions, _LOOK)
