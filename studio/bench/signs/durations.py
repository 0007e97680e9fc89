# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How long sentences are signed, beside the least that their postures need, and what takes the time.

Known sentences are translated and planned, each from rest to rest: as the planner does, from arms that hang
and with words as captured, and with the fastest motors in the hands. Of the first, the time goes by rooms
(raising, signs, spelled words, ways between them, lowering) and by what bounds it: at each instant the joint
that is nearest to one of its limits.
"""

from __future__ import annotations

import dataclasses
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import pairwise

import numpy as np

from glosses.systems import lines
from report import Figure
from teo_common.arrays import Array
from teo_description.robot import Robot
from teo_motion.planner import Planner
from teo_motion.sentence.plan import Plan, sample_at
from teo_motion.sentence.signing_style import RestPosture
from teo_motion.trajectory.limits import MotionLimits
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.pipeline.translator import Translator
from teo_signs.errors import PlanError
from teo_signs.look_up_table import Lut, default_lut_directory
from teo_signs.sign import Sign
from teo_signs.tokens import Kind, Token
from words import founded_signs, tokens_of

_FASTEST = "spool_380_high_power"  # motors sold for the hand

# What joints are told apart as, by what their names have in them; the first that fits.
_GROUPS = {
    "Thumb": "thumb",
    "Abductor": "thumb",
    "Finger": "fingers",
    "Wrist": "wrists",
    "Elbow": "elbows",
    "Shoulder": "shoulders",
    "": "head and trunk",
}
_QUANTITIES = ("velocity", "acceleration or jerk", "acceleration or jerk")
# Nearer to a limit than this, a motion is bounded by it [1]; what is farther from all stands still or waits
# for its time.
_BOUNDED = 0.5


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
    rooms = (part for plan in plans for part in _rooms(plan))
    bounded = (part for plan in plans for part in _bounded_by(plan, limits))
    return [
        Figure(
            f"{len(plans)} known sentences, {what}",
            f"median {np.median(seconds):.1f} s, mean {np.mean(seconds):.1f} s; {refused} refused",
        ),
        Figure(
            f"{what}: if every joint were always at its limit",
            f"median {np.median(bounds):.1f} s, mean {np.mean(bounds):.1f} s",
        ),
        Figure(f"{what}: by room", _shares(rooms)),
        Figure(f"{what}: by what bounds it", _shares(bounded)),
    ]


def _shares(parts: Iterable[tuple[str, float]]) -> str:
    """What takes how much of the whole, the most first; what takes less than 1 % is left out."""
    seconds: defaultdict[str, float] = defaultdict(float)
    for name, part in parts:
        seconds[name] += part
    total = sum(seconds.values())
    most_first = sorted(seconds, key=lambda name: seconds[name], reverse=True)
    shares = {name: seconds[name] / total for name in most_first}
    return ", ".join(f"{name} {100.0 * share:.0f} %" for name, share in shares.items() if share >= 0.01)


def _rooms(plan: Plan) -> Iterator[tuple[str, float]]:
    """Parts of a plan, each with its room and seconds."""
    first, last = plan.timings[0], plan.timings[-1]
    yield "raising", first.start
    yield "lowering", plan.duration - last.start - last.duration
    for timing in plan.timings:
        pause = timing.token.kind is Kind.PAUSE
        yield "spelling" if timing.token.spelled else "pauses" if pause else "signs", timing.duration
    for one, other in pairwise(plan.timings):
        same = one.token.spelled and other.token.spelled and one.token.word_index == other.token.word_index
        yield "spelling" if same else "ways", other.start - one.start - one.duration


def _bounded_by(plan: Plan, limits: MotionLimits) -> Iterator[tuple[str, float]]:
    """Steps of a plan, each with the joints and the limit that are nearest to each other, and its seconds."""
    times: Array = (plan.times[:-1] + plan.times[1:]) / 2.0
    samples = sample_at(plan.motions, times)
    jerks = np.stack(
        [
            motion.pieces.jerks[np.searchsorted(motion.starts, times, side="right") - 1]
            for motion in plan.motions
        ],
        axis=1,
    )
    used = np.stack(
        [
            np.abs(samples.velocities) / limits.velocity,
            np.abs(samples.accelerations) / limits.acceleration,
            np.abs(jerks) / limits.jerk,
        ]
    )
    for step, at in zip(np.diff(plan.times).tolist(), range(len(times)), strict=True):
        quantity, joint = np.unravel_index(int(used[:, at].argmax()), used[:, at].shape)
        group = next(group for part, group in _GROUPS.items() if part in limits.names[joint])
        bounded = used[quantity, at, joint] >= _BOUNDED
        yield f"{group} {_QUANTITIES[quantity]}" if bounded else "none", step


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
