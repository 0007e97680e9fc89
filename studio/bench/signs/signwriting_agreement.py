# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Signs compiled from SignWriting: how many are read, how fast, and how far they are as measured ones.

`PYTHONPATH=bench:$PYTHONPATH python -m signs.signwriting_agreement FILE`, with a dictionary as
`lut import --signwriting` reads it. The truth are the package's own scores whose form was measured on a
dictionary's videos (standing measured or recorded): community and normative dictionary may have different
signs for a word, so that an agreement of all is not to be expected.
"""

from __future__ import annotations

import sys
import time
from collections import Counter
from pathlib import Path
from typing import NamedTuple

import numpy as np

from report import Figure
from teo_description.robot import Robot
from teo_sign_authoring.notation.score_file import default_scores_directory, read_scores
from teo_sign_authoring.notation.score_schema import Score
from teo_sign_authoring.notation.targets import HandTarget, Posture, postures
from teo_sign_authoring.signwriting.compiler import compile_fsw
from teo_sign_authoring.signwriting.dictionary_file import GlossNames, read_dictionary
from teo_sign_authoring.signwriting.written_sign import UnreadableError
from teo_signs.errors import LutError

# A place that is nearer is the same part of the body or the space [m]; a palm that is turned less looks the
# same way.
_SAME_PLACE, _SAME_PALM = 0.15, np.cos(np.radians(60.0))
# Handshapes whose six axes differ less on the mean are told apart by few [rad].
_SAME_SHAPE = np.radians(15.0)
# A hand that goes less far than this stays [m]; ways within 60 deg are the same.
_MOVES, _SAME_WAY = 0.04, 0.5


class Agreement(NamedTuple):
    """Whether a compiled sign is as the measured one."""

    hands: bool
    shape: bool
    place: bool
    palm: bool
    movement: bool


def agreement(compiled: Score, measured: Score) -> Agreement:
    """Compare two scores of a word: what any posture of the one shares with any of the other."""
    robot = Robot.load()
    ours, theirs = postures(robot, compiled), postures(robot, measured)
    pairs = [(one.right, other.right) for one in ours for other in theirs]
    return Agreement(
        hands=(compiled.hands == "right") == (measured.hands == "right"),
        shape=any(float(np.abs(one.shape - other.shape).mean()) < _SAME_SHAPE for one, other in pairs),
        place=any(_is_same_place(one, other) for one, other in pairs),
        palm=any(float(one.palm @ other.palm) > _SAME_PALM for one, other in pairs),
        movement=_is_same_way(ours, theirs),
    )


def _is_same_place(one: HandTarget, other: HandTarget) -> bool:
    if one.other or other.other:
        return bool(one.other) and bool(other.other)
    return float(np.linalg.norm(one.point - other.point)) < _SAME_PLACE


def _is_same_way(ours: list[Posture], theirs: list[Posture]) -> bool:
    """Whether some part of one movement goes the way of some part of the other, or both stay."""
    first, second = _ways(ours), _ways(theirs)
    if not first or not second:
        return not first and not second
    return any(float(one @ other) > _SAME_WAY for one in first for other in second)


def _ways(moments: list[Posture]) -> list[np.ndarray]:
    points = [moment.right.point for moment in moments if not moment.right.other] or [
        moment.right.point for moment in moments
    ]
    ways = np.diff(np.array(points), axis=0)
    lengths = np.linalg.norm(ways, axis=1)
    return [way / length for way, length in zip(ways, lengths, strict=True) if length > _MOVES]


def measure(path: Path) -> list[Figure]:
    """Figures of a dictionary."""
    entries, names = read_dictionary(path), GlossNames()
    measured = {
        score.gloss: score
        for score in read_scores(default_scores_directory())
        if score.standing in ("measured", "recorded")
    }
    results: Counter[str] = Counter()
    compared: list[Agreement] = []
    words: set[str] = set()
    began = time.process_time()
    spent = 0.0
    for entry in entries:
        try:
            compilation = compile_fsw("X", entry.fsw, source="bench")
        except (UnreadableError, LutError) as error:
            results[f"refused: {error.code}"] += 1
            continue
        finally:
            spent, began = spent + time.process_time() - began, time.process_time()
        results["with losses" if compilation.losses else "whole"] += 1
        gloss = names.gloss(entry.term)
        if gloss in measured:
            words.add(gloss)
            compared.append(agreement(compilation.score, measured[gloss]))
        began = time.process_time()
    figures = [
        Figure("entries", ", ".join(f"{count} {what}" for what, count in results.most_common())),
        Figure("compiling an entry (processor time)", f"{1e3 * spent / len(entries):.1f} ms"),
        Figure("words that are measured too", f"{len(words)}, in {len(compared)} entries"),
    ]
    for index, name in enumerate(Agreement._fields):
        alike = sum(each[index] for each in compared)
        figures.append(Figure(f"{name} as measured", f"{alike} of {len(compared)}"))
    return figures


if __name__ == "__main__":
    for figure in measure(Path(sys.argv[1])):
        print(f"{figure.what}: {figure.value}")
