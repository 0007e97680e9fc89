# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How long sentences are signed, beside the least that their postures need.

Known sentences are translated and planned, each from rest to rest: as the planner does, from arms that hang
and with words as captured, and with the fastest motors in the hands.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence

import numpy as np

from glosses.systems import lines
from report import Figure
from teo_description.robot import Robot
from teo_motion.planner import Planner
from teo_motion.sentence.plan import Plan
from teo_motion.sentence.signing_style import RestPosture
from teo_motion.trajectory.limits import MotionLimits
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.pipeline.translator import Translator
from teo_signs.errors import PlanError
from teo_signs.look_up_table import Lut, default_lut_directory
from teo_signs.sign import Sign
from teo_signs.tokens import Token
from words import founded_signs, tokens_of

_FASTEST = "spool_380_high_power"  # motors sold for the hand


def measure(every: int = 48) -> list[Figure]:
    """Durations of every so manieth known sentence."""
    table = Lut.open(default_lut_directory())
    sentences = _known_sentences(every)
    as_captured = {
        gloss: dataclasses.replace(sign, alternatives=()) if sign.kind == "lexical" else sign
        for gloss, sign in table.items()
    }
    return [
        *_figures("as planned", table, RestPosture.READY, "", sentences),
        *_figures("hanging arms, words as captured", as_captured, RestPosture.HANGING, "", sentences),
        *_figures(f"as planned, hands of {_FASTEST}", table, RestPosture.READY, _FASTEST, sentences),
    ]


def _known_sentences(every: int) -> list[list[Token]]:
    answers = Translator.load().translate_all(lines("known.txt")[::every], founded_signs())
    return [
        tokens_of(sentence)
        for answer in answers
        if not isinstance(answer, TranslationError)
        for sentence in answer.sentences
    ]


def _figures(
    what: str,
    signs: Mapping[str, Sign],
    rest: RestPosture,
    hand_drive: str,
    sentences: Sequence[Sequence[Token]],
) -> list[Figure]:
    limits = MotionLimits.of_robot(hand_drive=hand_drive)
    planner = Planner(signs, robot=Robot.load(), limits=limits, max_duration=1e4, rest_posture=rest)
    plans, refused = [], 0
    for tokens in sentences:
        try:
            plans.append(planner.plan(tokens))
        except PlanError:
            refused += 1
    seconds = [plan.duration for plan in plans]
    bounds = [_bound(plan, limits) for plan in plans]
    return [
        Figure(
            f"{len(plans)} known sentences, {what}",
            f"median {np.median(seconds):.1f} s, mean {np.mean(seconds):.1f} s; {refused} refused",
        ),
        Figure(
            f"{what}: if every joint were always at its limit",
            f"median {np.median(bounds):.1f} s, mean {np.mean(bounds):.1f} s",
        ),
    ]


def _bound(plan: Plan, limits: MotionLimits) -> float:
    """Seconds of a sentence in the postures of its plan, were every joint at its limits on every way."""
    columns = list(range(len(limits.names)))
    total, before = 0.0, 0.0
    for timing in plan.timings:
        away = plan.at(timing.start)[0] - plan.at(before)[0]
        total += float(limits.least_times(away, columns).max()) + timing.duration / timing.stretch
        before = timing.start + timing.duration
    away = plan.positions[-1] - plan.at(before)[0]
    return total + float(limits.least_times(away, columns).max())
