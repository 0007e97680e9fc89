# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which sign of the table a demonstration is: written signs performed by bodies kept apart.

The synthetic signer performs scores (`signs/shown_takes.py`), with exact keypoints, laid into a picture
with a detector's noise and lifted, and as films whose points MediaPipe has found. Each is cut out as in a
capture and sought among all words and numbers of the table, beside a search by TEO's joints. Leave-one-out
is of takes: each is sought among the lifted takes of the draw's other bodies, the table put aside.

The units of `recognition.py` were chosen on the 26 signs of `KNOWN`, stopping and swung, exact and
lifted, and on seven films of other signs by the six bodies that have names. `NEW` was drawn when that was
finished, of other signs and people: looked at, it is known, and another is to be drawn.
"""

from __future__ import annotations

import time
from collections.abc import Sequence

import numpy as np
from threadpoolctl import threadpool_limits  # type: ignore[import-untyped]  # ships no types

from accuracy.people import random_people
from report import Figure, percentiles, share
from signs import score_clips
from signs.score_clips import Draw
from signs.shown_takes import EXACT, FILMED, LIFTED, ShownTake, shown_takes, sign_joints
from teo_common.arrays import Array
from teo_description.robot import Robot
from teo_sign_capture.recognition import SignIndex, sign_appearance
from teo_signs.likeness import nearest_pairs
from teo_signs.look_up_table import Lut, default_lut_directory
from teo_signs.sign import Sign
from teo_synthetic_signer.body.body_shapes import BODIES

BODIES |= random_people(3, 61_409, "learner")

KNOWN = score_clips.KNOWN._replace(signs=12)
NEW = Draw(
    seed=60_331,
    signs=12,
    bodies=("learner_0", "learner_1", "learner_2"),
    distance=1.9,
    without=(score_clips.KNOWN, score_clips.KNOWN_SINCE),
)
FILMS = 8
_SEED = 1
_THOUSAND = 1000


def measure() -> list[Figure]:
    """Right answers, confusion pairs and time."""
    robot = Robot.load()
    with threadpool_limits(1):
        new = shown_takes(robot, NEW, FILMS)
        known = shown_takes(robot, KNOWN, 0)
    table = Table(robot)
    return [
        *table.figures("never seen before", new),
        *table.figures("known, units chosen on them", known),
        *(_leave_one_out(way, new) for way in (LIFTED, FILMED)),
        _time(table.shown, [take.shown for take in new]),
    ]


class Table:
    """The words and numbers of the shipped table, to be sought in two ways."""

    def __init__(self, robot: Robot) -> None:
        lut = Lut.open(default_lut_directory())
        self._robot = robot
        self._signs: dict[str, Sign] = {g: s for g, s in lut.items() if s.kind != "letter"}
        self.shown: Array = np.array([sign_appearance(robot, sign) for sign in self._signs.values()])
        joints = np.array([sign_joints(sign) for sign in self._signs.values()])
        self._indices = (SignIndex(self._signs, self.shown), SignIndex(self._signs, joints))

    def figures(self, name: str, takes: Sequence[ShownTake]) -> list[Figure]:
        """How often takes of each way are found, and what was confused."""
        figures = []
        for way in (EXACT, LIFTED, FILMED):
            of_way = [take for take in takes if take.way == way]
            if not of_way:
                continue
            first, five, confused = self._rights(0, of_way)
            plain_first, plain_five, _ = self._rights(1, of_way)
            total = len(of_way)
            what = f"{name}, {way} ({total} takes), of {len(self._signs)}"
            figures += [
                Figure(f"{what}: first", f"{share(first, total)}; by joints {share(plain_first, total)}"),
                Figure(f"{what}: among five", f"{share(five, total)}; by joints {share(plain_five, total)}"),
                Figure(f"{what}: confused", ", ".join(sorted(confused)) or "none"),
            ]
        return figures

    def _rights(self, way: int, takes: Sequence[ShownTake]) -> tuple[int, int, set[str]]:
        """Found first, among five, and what was named first instead."""
        first = five = 0
        confused = set()
        for take in takes:
            shown = (take.shown, take.joints)[way]
            named = [match.gloss for match in self._indices[way].nearest(shown)]
            right = [gloss for gloss in named if gloss == take.gloss or self._is_one_form(gloss, take.gloss)]
            first += named[0] in right
            five += bool(right)
            if named[0] not in right:
                confused.add(f"{take.gloss} for {named[0]}")
        return first, five, confused

    def _is_one_form(self, first: str, second: str) -> bool:
        """Whether two glosses name one form: one answer."""
        return not nearest_pairs(self._robot, [self._signs[first], self._signs[second]])


def _leave_one_out(way: str, takes: Sequence[ShownTake]) -> Figure:
    sought = [take for take in takes if take.way == way]
    right = 0
    for take in sought:
        others = [other for other in takes if other.way == LIFTED and other.body != take.body]
        index = SignIndex([other.gloss for other in others], np.array([other.shown for other in others]))
        right += index.nearest(take.shown, 1)[0].gloss == take.gloss
    return Figure(
        f"a take, {way}, among the other bodies' lifted takes of {len({take.gloss for take in takes})} signs",
        share(right, len(sought)),
    )


def _time(shown: Array, sought: Sequence[Array]) -> Figure:
    """A table of 1,000: the table's signs, and as many more by a little noise; time of the processor."""
    noise = np.random.default_rng(_SEED).normal(0.0, 0.3, (_THOUSAND - len(shown), *shown.shape[1:]))
    every = np.concatenate([shown, shown[np.arange(len(noise)) % len(shown)] + noise])
    index = SignIndex(map(str, range(len(every))), every)
    seconds = []
    for one in sought:
        start = time.process_time()
        index.nearest(one)
        seconds.append(time.process_time() - start)
    return percentiles(f"five nearest of a table of {len(every)}, processor time", seconds)


if __name__ == "__main__":
    for figure in measure():
        print(f"{figure.what}: {figure.value}")
