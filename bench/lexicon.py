"""The words of the table: how well founded, how much slower than written, how often in their own way."""

from __future__ import annotations

import multiprocessing
import os
from collections import Counter
from itertools import pairwise

import numpy as np
from report import Figure

from teo_description import joint_limits
from teo_description.robot import Robot
from teo_lut_executor.lut import Lut
from teo_lut_executor.plan_error import PlanError
from teo_lut_executor.planner import Planner
from teo_lut_executor.sign import Sign
from teo_lut_executor.sign_schema import STANDINGS
from teo_lut_executor.tokens import Token

SENTENCES = 500
_SIGNS = 3
_WORST = 10
_BATCH = 25  # sentences that one process plans in a row
_LOOKS = 9  # at the straight way between two knots, both ends included

_ERRORS = {
    "place": ("place_error_mm", "mm"),
    "palm": ("palm_angle_error_deg", "deg"),
    "fingers": ("finger_angle_error_deg", "deg"),
}


def measure() -> list[Figure]:
    """Figures of the package's table."""
    lut = Lut.open()
    words = [sign for sign in lut.values() if sign.kind == "lexical"]
    return [
        _standings(words),
        *_stretches(lut, words),
        _refusals(),
        *(_errors(words, name) for name in _ERRORS),
        _violations(list(lut.values())),
    ]


def _standings(words: list[Sign]) -> Figure:
    counts = Counter(sign.provenance.standing for sign in words)
    shown = ", ".join(f"{counts[standing]} {standing}" for standing in STANDINGS)
    return Figure("words by standing", f"{len(words)}: {shown}")


def _stretches(lut: Lut, words: list[Sign]) -> list[Figure]:
    planner = Planner(lut, least_standing="sketched")
    stretch = {word.gloss: planner.plan([Token(gloss=word.gloss)]).stretch for word in words}
    slowest = sorted(stretch, key=lambda gloss: -stretch[gloss])[:_WORST]
    return [
        Figure("slower than written, of 50 deg/s", f"median {np.median(list(stretch.values())):.2f} times"),
        Figure("slowest words", ", ".join(f"{gloss} {stretch[gloss]:.1f}" for gloss in slowest)),
    ]


def _refusals() -> Figure:
    batches = range(0, SENTENCES, _BATCH)
    with multiprocessing.get_context("spawn").Pool(os.cpu_count()) as pool:
        found = pool.map(_refused_of_batch, batches, chunksize=1)
    refused = [sentence for batch in found for sentence in batch]
    named = ": " + "; ".join(refused) if refused else ""
    return Figure(
        f"refused for self-collision, of {SENTENCES} random sentences of {_SIGNS} words",
        f"{len(refused)} ({100.0 * len(refused) / SENTENCES:.1f} %){named}",
    )


def _refused_of_batch(seed: int) -> list[str]:
    """The sentences of a batch that cannot be signed."""
    lut = Lut.open()
    words = [gloss for gloss in lut.glosses() if lut[gloss].kind == "lexical"]
    planner = Planner(lut, robot=Robot.load(), least_standing="sketched")
    random = np.random.default_rng(seed)
    refused: list[str] = []
    for _ in range(_BATCH):
        glosses = [str(gloss) for gloss in random.choice(words, _SIGNS)]
        try:
            planner.plan([Token(gloss=gloss) for gloss in glosses])
        except PlanError as error:
            if error.code != "self_collision":
                raise
            refused.append(" ".join(glosses))
    return refused


def _errors(words: list[Sign], name: str) -> Figure:
    key, unit = _ERRORS[name]
    found = {sign.gloss: sign.quality[key] for sign in words if key in sign.quality}
    worst = max(found, key=lambda gloss: found[gloss])
    return Figure(
        f"{name}, off what is written (largest of each word)",
        f"median {np.median(list(found.values())):.0f} {unit}, worst {found[worst]:.0f} {unit} ({worst})",
    )


def _violations(signs: list[Sign]) -> Figure:
    """A second look at every entry: limits, and straight ways between knots."""
    robot = Robot.load()
    bad = [sign.gloss for sign in signs if _outside(sign) or _touching(robot, sign)]
    return Figure(
        f"entries outside a limit or touching, of {len(signs)}", f"{len(bad)} {', '.join(bad)}".strip()
    )


def _outside(sign: Sign) -> bool:
    limits = joint_limits(sign.joints)
    return bool(((sign.knots < limits.lower - 1e-6) | (sign.knots > limits.upper + 1e-6)).any())


def _touching(robot: Robot, sign: Sign) -> bool:
    rows = [sign.knots[0]]
    for first, second in pairwise(sign.knots):
        rows += [first + share * (second - first) for share in np.linspace(0.0, 1.0, _LOOKS)[1:]]
    poses = (dict(zip(sign.joints, row.tolist(), strict=True)) for row in rows)
    return any(robot.clearance(robot.configuration(pose)).distance < 0.0 for pose in poses)
