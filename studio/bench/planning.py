# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Planning: how long a sentence takes, and whether any of 10,000 random plans breaks a limit.

Limits are looked at in what a driver makes of a plan's points, a quintic between each two, every 2 ms.
"""

from __future__ import annotations

import multiprocessing
import os
import time
from typing import NamedTuple

import numpy as np

from report import Figure, percentiles
from teo_description.robot import Robot
from teo_motion.planner import Planner
from teo_motion.sentence.plan import Plan
from teo_motion.sentence.sentence_form import SentenceForm, SentenceType
from teo_motion.trajectory.limits import MotionLimits, Reached
from teo_names import COMMANDED_JOINTS, joint_limits
from teo_signs.errors import PlanError
from teo_signs.look_up_table import Lut, default_lut_directory
from teo_signs.sign import Sign
from teo_signs.tokens import Kind, Token, parse_printed
from teo_sim_driver import Trajectory

SENTENCES = 200
PLANS = 10_000
_LETTERS = 10
_LOOK = 0.002  # [s]: a tenth of the time between two points
_BATCH = 50  # plans of one random table
_OWN = 20  # one batch in so many plans from the package's table: ways round the body take a second each
_KINDS = {"lexical": Kind.LEXICAL, "letter": Kind.LETTER, "number": Kind.NUMBER}

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


class Broken(NamedTuple):
    """What a number of plans did to the limits."""

    plans: int
    refused: int
    violations: int
    beyond: float  # as those of `Reached`, as the three below
    velocity: float
    acceleration: float
    jerk: float


def measure(plans: int = PLANS) -> list[Figure]:
    """Times of sentences, then the limits of random plans."""
    figures = [*_times(), _planning_of_letters()]
    shares = [range(begin, min(begin + _BATCH, plans)) for begin in range(0, plans, _BATCH)]
    with multiprocessing.get_context("spawn").Pool(os.cpu_count()) as pool:
        batches = pool.map(_random_plans, shares, chunksize=4)
    worst = _worst(batches)
    total = Broken(
        plans=sum(batch.plans for batch in batches),
        refused=sum(batch.refused for batch in batches),
        violations=sum(batch.violations for batch in batches),
        **worst._asdict(),
    )
    figures.append(Figure(f"limit violations in {total.plans} random plans", str(total.violations)))
    figures.append(
        Figure(
            "the most seen in them, over the limit",
            f"velocity {total.velocity:.5f}, acceleration {total.acceleration:.4f}, jerk {total.jerk:.6f}; "
            f"position {total.beyond:.1e} rad beyond",
        )
    )
    if total.refused:
        figures.append(Figure("refused among them, for self-collision", str(total.refused)))
    return figures


def _times() -> list[Figure]:
    """Planning time of typical sentences, self-collision included."""
    planner = Planner(Lut.open(default_lut_directory()), robot=Robot.load())
    sentences = [parse_printed(text) for text in _PRINTED]
    for sentence in sentences:
        planner.plan(sentence)  # reads the entries
    asked = SentenceForm(type=SentenceType.YES_NO_QUESTION, negated=True)
    seconds, with_head, signing = [], [], []
    for index in range(SENTENCES):
        sentence = sentences[index % len(sentences)]
        began = time.perf_counter()
        plan = planner.plan(sentence)
        seconds.append(time.perf_counter() - began)
        signing.append(plan.duration)
        began = time.perf_counter()
        planner.plan(sentence, form=asked)
        with_head.append(time.perf_counter() - began)
    return [
        percentiles("plan a sentence", seconds),
        percentiles("the same as negated questions, head and all", with_head),
        Figure("signing time of those sentences", f"median {np.median(signing):.1f} s"),
    ]


def _planning_of_letters() -> Figure:
    planner = Planner(Lut.open(default_lut_directory()), robot=Robot.load())
    generator = np.random.default_rng(0)
    letters = [gloss for gloss, sign in Lut.open(default_lut_directory()).items() if sign.kind == "letter"]
    seconds = []
    for _ in range(SENTENCES // 4):
        word = generator.choice(letters, _LETTERS).tolist()
        tokens = [Token(gloss=letter, kind=Kind.LETTER) for letter in word]
        began = time.perf_counter()
        planner.plan(tokens)
        seconds.append(time.perf_counter() - began)
    return percentiles(f"plan a word of {_LETTERS} letters", seconds)


def _random_plans(numbers: range) -> Broken:
    """Plans of one random table, or in some batches of the package's own."""
    generator = np.random.default_rng(numbers.start)
    own = (numbers.start // _BATCH) % _OWN == 0
    table = dict(Lut.open(default_lut_directory())) if own else _random_table(generator)
    # Every sign of the table, whatever its standing: numbers that are only sketched cannot be spelled.
    robot = Robot.load() if own else None
    planner = Planner(table, robot=robot, max_duration=1e4, least_standing="sketched")
    refused, found = 0, []
    for _ in numbers:
        try:
            found.append(check(planner.plan(_random_tokens(generator, table))))
        except PlanError as error:
            if error.code != "self_collision":
                raise RuntimeError(f"batch {numbers}: {error.code}") from error
            refused += 1
    violations = sum(item.violations for item in found)
    return Broken(len(numbers), refused, violations, *_worst(found))


def check(plan: Plan) -> Broken:
    """What a driver that executes a plan does to the limits."""
    path = Trajectory.quintic(*(values.copy() for values in vars(plan.samples).values()))
    times = np.arange(0.0, plan.duration + 4.0 * _LOOK, _LOOK)
    reached = MotionLimits.of_robot().reached(path.states(times).positions, _LOOK)
    # Rounding, and for positions the 1.5e-5 rad of one encoder count.
    broken = (reached.beyond > 1.5e-5) + sum(share > 1.0 + 1e-6 for share in reached[1:])
    return Broken(1, 0, int(broken), *reached)


def _worst(found: list[Broken]) -> Reached:
    """The most of each, of one or more."""
    return Reached(*np.max([item[3:] for item in found], axis=0).tolist())


def _random_tokens(generator: np.random.Generator, table: dict[str, Sign]) -> list[Token]:
    glosses = sorted(table)
    tokens = []
    for _ in range(generator.integers(1, 9)):
        sign = table[str(generator.choice(glosses))]
        scale = float(generator.choice([0.1, 0.5, 1.0, 2.0]))
        word = int(generator.integers(3))
        tokens.append(Token(gloss=sign.gloss, kind=_KINDS[sign.kind], duration_scale=scale, word_index=word))
    return tokens


def _random_table(generator: np.random.Generator) -> dict[str, Sign]:
    """Signs anywhere within the limits, on them, shaking, or with a knot for every frame of a video."""
    donor = next(iter(Lut.open(default_lut_directory()).values()))
    groups = [
        tuple(name for name in COMMANDED_JOINTS if "Right" in name),
        tuple(name for name in COMMANDED_JOINTS if "Left" in name),
        COMMANDED_JOINTS,
    ]
    table = {}
    for number in range(6):
        joints = groups[generator.integers(len(groups))]
        limits = joint_limits(joints)
        shape = (int(generator.integers(1, 7)), len(joints))
        gaps = generator.choice([0.001, 0.02, 0.1, 0.3, 1.0], shape[0] - 1)
        match generator.integers(4):
            case 3:  # as captured from video: knots at every frame, joints that swing
                shape = (int(generator.integers(8, 20)), len(joints))
                gaps = np.full(shape[0] - 1, 0.04)
                phase = generator.uniform(0.0, 2.0 * np.pi, shape[1])
                turned = phase + np.arange(shape[0])[:, None] * generator.uniform(0.2, 2.0)
                middle = generator.uniform(limits.lower, limits.upper)
                swing = generator.uniform(0.0, 0.3, shape[1]) * np.sin(turned)
                knots = np.clip(middle + swing, limits.lower, limits.upper)
            case 0:
                knots = generator.uniform(limits.lower, limits.upper, shape)
            case 1:
                walk = np.cumsum(generator.normal(0.0, 0.1, shape), axis=0)
                middle = generator.uniform(limits.lower, limits.upper)
                knots = np.clip(middle + walk, limits.lower, limits.upper)
            case _:
                knots = np.where(generator.random(shape) < 0.5, limits.lower, limits.upper)
        table[f"SIGN{number}"] = Sign(
            gloss=f"SIGN{number}",
            language="ssp",
            kind="lexical",
            handedness="both",
            joints=joints,
            times=np.concatenate([[0.0], np.cumsum(gaps)]),
            knots=knots,
            provenance=donor.provenance,
            quality={},
        )
    return table


def main() -> None:
    """Print the figures."""
    for figure in measure():
        print(f"{figure.what}: {figure.value}")


if __name__ == "__main__":
    main()
