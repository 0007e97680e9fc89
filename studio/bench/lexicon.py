# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The words of the table: how well founded, how much slower than written, how often in their own way."""

from __future__ import annotations

import dataclasses
import multiprocessing
import os
from collections import Counter

import numpy as np

from executed_motion import ContactJudge
from planning import as_driven
from report import Figure
from teo_description.robot import Robot
from teo_motion.planner import Planner
from teo_motion.sentence.plan import Plan, sample_at
from teo_sign_capture.recognition import MOMENTS, SignIndex, distance_between, sign_appearance
from teo_signs.errors import PlanError
from teo_signs.look_up_table import Lut, default_lut_directory
from teo_signs.sign import Sign
from teo_signs.sign_schema import STANDINGS
from teo_signs.tokens import Kind, Token

_SIGNS = 3
_WORST = 10
_BATCH = 25  # sentences that one process plans in a row
_LOOK = 0.01  # [s] between postures looked at for contacts: a hand goes a few millimetres meanwhile
_ONE_MOTION = 1e-6  # distances that differ by less are those of one motion under two names

_ERRORS = {
    "place": ("place_error_mm", "mm"),
    "palm": ("palm_angle_error_deg", "deg"),
    "fingers": ("finger_angle_error_deg", "deg"),
}


def measure(sentences: int = 500, every: int = 1) -> list[Figure]:
    """Figures of the package's table.

    Args:
        sentences: So many random ones are planned.
        every: Each so manieth entry is planned and judged.
    """
    lut = Lut.open(default_lut_directory())
    words = [sign for sign in lut.values() if sign.kind == "lexical"]
    return [
        _standings(words),
        *_stretches(lut, words[::every]),
        _refusals(sentences),
        *(_errors(words, name) for name in _ERRORS),
        _violations(list(lut.glosses())[::every]),
    ]


def _standings(words: list[Sign]) -> Figure:
    counts = Counter(sign.provenance.standing for sign in words)
    shown = ", ".join(f"{counts[standing]} {standing}" for standing in STANDINGS)
    return Figure("words by standing", f"{len(words)}: {shown}")


def _stretches(lut: Lut, words: list[Sign]) -> list[Figure]:
    """How much slower than asked for words are, and which look more like another sign, as they are played."""
    robot = Robot.load()
    planner = Planner(lut, robot=robot, least_standing="sketched")
    plans = {word.gloss: planner.plan([Token(gloss=word.gloss)]) for word in words}
    stretch = {gloss: plan.stretch for gloss, plan in plans.items()}
    slowest = sorted(stretch, key=lambda gloss: -stretch[gloss])[:_WORST]
    index = SignIndex.of_signs(robot, lut.values())
    confused = []
    for word in words:
        shown = sign_appearance(robot, _played(word, plans[word.gloss]))
        (nearest,) = index.nearest(shown, 1)
        if nearest.distance < distance_between(shown, sign_appearance(robot, word)) - _ONE_MOTION:
            confused.append(f"{word.gloss} for {nearest.gloss}")
    return [
        Figure("slower than written, of 50 deg/s", f"median {np.median(list(stretch.values())):.2f} times"),
        Figure("slowest words", ", ".join(f"{gloss} {stretch[gloss]:.1f}" for gloss in slowest)),
        Figure(
            "words above three times", f"{sum(value > 3.0 for value in stretch.values())} of {len(words)}"
        ),
        Figure(
            "words that look more like another sign, as they are played",
            f"{len(confused)}{': ' if confused else ''}{', '.join(confused)}",
        ),
    ]


def _played(word: Sign, plan: Plan) -> Sign:
    """A word as a plan moves it."""
    (timing,) = plan.timings
    times = np.linspace(0.0, timing.duration, MOMENTS)
    columns = [plan.names.index(joint) for joint in word.joints]
    knots = sample_at(plan.motions, timing.start + times).positions[:, columns]
    return dataclasses.replace(word, times=times, knots=knots, alternatives=())


def _refusals(sentences: int) -> Figure:
    batches = range(0, sentences, _BATCH)
    with multiprocessing.get_context("spawn").Pool(os.cpu_count()) as pool:
        found = pool.map(_refused_of_batch, batches, chunksize=1)
    refused = [sentence for batch in found for sentence in batch]
    named = ": " + "; ".join(refused) if refused else ""
    return Figure(
        f"refused for self-collision, of {sentences} random sentences of {_SIGNS} words",
        f"{len(refused)} ({100.0 * len(refused) / sentences:.1f} %){named}",
    )


def _refused_of_batch(seed: int) -> list[str]:
    """The sentences of a batch that cannot be signed."""
    lut = Lut.open(default_lut_directory())
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


def _violations(glosses: list[str]) -> Figure:
    """Every entry as it is planned: contacts, and what a driver makes of the plan beside the limits.

    Pieces of a plan meet to within Ruckig's 1e-8 rad. Its points smooth that out; third differences between
    the plan's own positions, a millisecond apart, would take it for 20 rad/s^3 of jerk.
    """
    batches = [glosses[start : start + _BATCH] for start in range(0, len(glosses), _BATCH)]
    with multiprocessing.get_context("spawn").Pool(os.cpu_count()) as pool:
        found = [bad for batch in pool.map(bad_of_batch, batches, chunksize=1) for bad in batch]
    return Figure(
        f"entries that leave a limit or touch as planned, of {len(glosses)}",
        f"{len(found)}{': ' if found else ''}{'; '.join(found)}",
    )


def bad_of_batch(glosses: list[str]) -> list[str]:
    """Entries of a batch with something wrong, and what."""
    lut = Lut.open(default_lut_directory())
    planner, contacts = Planner(lut, robot=Robot.load(), least_standing="sketched"), ContactJudge()
    bad: list[str] = []
    for gloss in glosses:
        try:
            plan = planner.plan([Token(gloss=gloss, kind=Kind[lut[gloss].kind.upper()])])
        except PlanError as error:
            bad.append(f"{gloss} is refused: {error}")
            continue
        postures = sample_at(plan.motions, np.arange(0.0, plan.duration, _LOOK)).positions
        distance, parts = contacts.nearest(postures)
        bad += [f"{gloss} over its limit of {limit}" for limit in as_driven(plan).broken()]
        if distance < 0.0:
            bad.append(f"{gloss}: {parts}, {-1e3 * distance:.1f} mm in each other")
    return bad
