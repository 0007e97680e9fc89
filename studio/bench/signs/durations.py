# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How long sentences are signed, what takes the time, and how much slower than asked for words are.

In `bench/`: `python -m signs.durations [STEP]` translates and plans every STEP-th known sentence (6 without
it), each from rest to rest: as the planner does, with arms that hang at rest, with that and words as their
entries have them, and with faster motors in the hands. Beside each stands the least that its postures need.
"""

from __future__ import annotations

import dataclasses
import sys
from collections import defaultdict
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
from teo_signs.tokens import Kind, Token
from words import founded_signs, tokens_of

STEP = 6
# A word that takes so many times as long as asked for is counted as slow [1].
_SLOW = 3.0
# The fastest motors sold for the hand.
_FASTEST = "spool_380_high_power"


def measure(step: int = STEP) -> list[Figure]:
    """Durations of known sentences, and of their parts."""
    table = Lut.open(default_lut_directory())
    sentences = known_sentences(step)
    as_captured = {
        gloss: dataclasses.replace(sign, alternatives=()) if sign.kind == "lexical" else sign
        for gloss, sign in table.items()
    }
    figures = []
    for what, signs, rest, drive in (
        ("as planned", table, RestPosture.READY, ""),
        ("baseline: arms hang at rest", table, RestPosture.HANGING, ""),
        ("baseline: and words as captured", as_captured, RestPosture.HANGING, ""),
        (f"as planned with hands of {_FASTEST}", table, RestPosture.READY, _FASTEST),
    ):
        figures += _figures(what, signs, rest, drive, sentences)
    return figures


def known_sentences(step: int) -> list[list[Token]]:
    """Tokens of every step-th known sentence, as translated."""
    answers = Translator.load().translate_all(lines("known.txt")[::step], founded_signs())
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
    parts: dict[str, float] = defaultdict(float)
    for plan in plans:
        for part, time in _parts(plan).items():
            parts[part] += time
    stretches: dict[str, float] = {}
    for plan in plans:
        for timing in plan.timings:
            if timing.token.kind is Kind.LEXICAL:
                gloss = timing.token.gloss
                stretches[gloss] = max(timing.stretch, stretches.get(gloss, 0.0))
    slowest = max(stretches, key=lambda gloss: stretches[gloss])
    values = np.array(list(stretches.values()))
    shares = ", ".join(f"{part} {time / len(plans):.1f} s" for part, time in sorted(parts.items()))
    ways = _ways(planner, plans)
    bounds = [_bound(plan, limits) for plan in plans]
    return [
        Figure(
            f"{len(plans)} known sentences, {what}",
            f"median {np.median(seconds):.1f} s, mean {np.mean(seconds):.1f} s"
            + (f"; {refused} refused" if refused else ""),
        ),
        Figure(
            f"{what}: if every way took the least time of its slowest joint, and every sign what it asks for",
            f"median {np.median(bounds):.1f} s, mean {np.mean(bounds):.1f} s",
        ),
        Figure(f"{what}: in the mean", shares),
        Figure(f"{what}: ways between words over the bound of their slowest joint", f"{ways:.2f}"),
        Figure(
            f"{what}: time of {len(values)} words over the time asked for",
            f"median {np.median(values):.2f}, above {_SLOW:.0f} {100 * np.mean(values > _SLOW):.0f} %; "
            f"{slowest} {values.max():.1f}",
        ),
    ]


def _parts(plan: Plan) -> dict[str, float]:
    """Seconds of a plan by what they are spent on; the way to a letter is spelling."""
    parts: dict[str, float] = defaultdict(float)
    before = 0.0
    for index, timing in enumerate(plan.timings):
        way = timing.start - before
        spelled = timing.token.kind is Kind.LETTER
        parts["raising" if not index else "spelling" if spelled else "ways to words"] += way
        parts["spelling" if spelled else "words"] += timing.duration
        before = timing.start + timing.duration
    parts["lowering"] += plan.duration - before
    return parts


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


def _ways(planner: Planner, plans: Sequence[Plan]) -> float:
    """Time of the ways from word to word over the least time of their slowest joint [1]."""
    taken = bound = 0.0
    columns = list(range(len(planner.limits.names)))
    for plan in plans:
        for first, second in zip(plan.timings, plan.timings[1:], strict=False):
            if first.token.kind is Kind.LEXICAL and second.token.kind is Kind.LEXICAL:
                end = first.start + first.duration
                away = plan.at(second.start)[0] - plan.at(end)[0]
                taken += second.start - end
                bound += max(float(planner.limits.least_times(away, columns).max()), planner.style.transition)
    return taken / bound if bound else 1.0


def main() -> None:
    """Print the figures."""
    for figure in measure(int(sys.argv[1]) if len(sys.argv) > 1 else STEP):
        print(f"{figure.what}: {figure.value}")


if __name__ == "__main__":
    main()
