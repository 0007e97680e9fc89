# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Postures of a word that take little time to reach and leave, and which of them its table is given.

Arms and hands at all knots are found by linear programs that make the time of the slowest joint least:
within the word, and in the mean from and to what may come before and after.

What `EasyWords` finds within the tolerance may still touch between two knots, and small differences of
every kind together may bring it nearer to another sign. It is therefore played by the planner, and
compared with all signs of the table. A word that is slow all the same is made smaller: its palms turn
less.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from teo_common.arrays import Array
from teo_description.humanoid import Humanoid
from teo_description.robot import Robot
from teo_motion.planner import Planner
from teo_motion.sentence.signing_style import SigningStyle
from teo_motion.trajectory.limits import MotionLimits
from teo_sign_authoring.easing.word_tolerance import WordTolerance
from teo_sign_authoring.linear_program import BEYOND, LinearProgram
from teo_sign_capture.recognition import SignIndex, distance_between, sign_appearance
from teo_signs.errors import PlanError
from teo_signs.sign import Sign, with_alternatives
from teo_signs.tokens import Token

# [rad] Most by which a joint changes in each program.
_STEPS = np.radians([15.0, 15.0, 10.0, 7.0, 5.0, 3.0, 1.5])
# Mean speed of a stroke over its joint's greatest [1], as in `teo_motion.sentence.sign_size`.
_MEAN_SPEED = 0.7
# Of a change that cannot be used whole, the shares that are tried.
_SHARES = (1.0, 0.9, 0.75, 0.6, 0.45, 0.3)


# Neighbours that are looked at, and how often they come [1]: of the known sentences' words half stand beside
# another word, and a quarter each beside spelled ones and at an end. More neighbours change little.
_WORDS, _LETTERS = 24, 6
_WORD_SHARE, _LETTER_SHARE, _REST_SHARE = 0.5, 0.25, 0.25


class Neighbours(NamedTuple):
    """Postures that come before or after a word.

    Attributes:
        postures: Of the commanded joints, NaN where a neighbour leaves them free [rad]. Shape (k, joints).
        weights: How often each comes, 1 in all. Shape (k,).
    """

    postures: Array
    weights: Array


def neighbours(humanoid: Humanoid, table: Mapping[str, Sign], knot: int) -> Neighbours:
    """What comes before (knot -1) or after (knot 0) a word, about: words, spelled words and rest.

    Args:
        humanoid: The robot.
        table: The table, of whose words and letters some are taken at random.
        knot: With which knot they meet the word.
    """
    random = np.random.default_rng(0)
    rest = humanoid.ready
    rows, weights = [rest], [_REST_SHARE]
    for kind, count, share in (("lexical", _WORDS, _WORD_SHARE), ("letter", _LETTERS, _LETTER_SHARE)):
        signs = [table[gloss] for gloss in sorted(table) if table[gloss].kind == kind]
        for index in random.choice(len(signs), min(count, len(signs)), replace=False).tolist():
            sign, row = signs[index], np.full(rest.size, np.nan)
            row[humanoid.columns(sign.joints)] = sign.knots[knot]
            rows.append(row)
            weights.append(share / min(count, len(signs)))
    return Neighbours(np.array(rows), np.array(weights) / sum(weights))


class EasyWords:
    """Makes alternatives of words."""

    def __init__(
        self, humanoid: Humanoid, limits: MotionLimits, before: Neighbours, after: Neighbours
    ) -> None:
        """Prepare for what comes before and after any word; of the limits velocity counts."""
        self._humanoid, self._speeds = humanoid, limits.velocity
        self._before, self._after = before, after

    def eased(self, word: WordTolerance, accepted: Callable[[Array], bool]) -> Array | None:
        """Knots of a word that take less time; None if none within tolerance do. Shape (n, joints).

        Args:
            word: The tolerance.
            accepted: Says of knots whether they may be given to the word; less of a change is tried if not.
        """
        for hands in (True, False):
            postures = word.arms.postures
            for step in _STEPS:
                postures = self._program(word, postures, float(step), hands=hands)
            change = postures - word.arms.postures
            for share in _SHARES:
                found = word.arms.postures + share * change
                kept = word.excess(found) <= 1.0 and word.contacts.places_kept(found)
                if kept and word.contacts.kept(found) and accepted(knots := word.arms.knots(found)):
                    return knots
        return None

    def _program(self, word: WordTolerance, postures: Array, step: float, *, hands: bool) -> Array:
        """Solve for the postures within a step of those given, hands included or not."""
        size = postures.shape[1]
        columns = self._humanoid.columns(word.arms.sign.joints[column] for column in word.arms.columns)
        speeds = self._speeds[columns]
        table = LinearProgram(postures.size)

        def of(posture: int) -> NDArray[np.intp]:
            return np.arange(size * posture, size * (posture + 1))

        for rows in word.rows(postures):
            variables = np.concatenate([of(posture) for posture in rows.postures])
            beyond = np.full((len(rows.bound), 1), -rows.scale)
            table.add([(variables, rows.matrix), ([table.variable(BEYOND)], beyond)], rows.bound)
        rate = np.diag(1.0 / (_MEAN_SPEED * speeds))
        for (first, second), (least, count) in self._strokes(word).items():
            time = table.variable(float(count), least=least)
            away = postures[second] - postures[first]
            table.add_distance([(of(second), rate), (of(first), -rate)], rate @ away, time)
        rate = np.diag(1.0 / speeds)
        for end, neighbours in ((0, self._before), (-1, self._after)):
            posture = int(word.arms.at[end])
            theirs = neighbours.postures[:, columns]
            shared = np.isfinite(theirs)  # the joints that a neighbour fixes
            theirs = word.arms.as_right(np.where(shared, theirs, 0.0))
            for number, weight in enumerate(neighbours.weights.tolist()):
                joints = np.flatnonzero(shared[number])
                if not joints.size:
                    continue
                time = table.variable(weight)
                away = postures[posture] - theirs[number]
                table.add_distance([(of(posture), rate[joints])], rate[joints] @ away, time)
        steps = np.where(word.arms.of_hands & (not hands), 0.0, step)
        lower = np.maximum(word.lower - postures, -steps).ravel()
        upper = np.minimum(word.upper - postures, steps).ravel()
        change = table.solved(np.minimum(lower, 0.0), np.maximum(upper, 0.0))
        return postures + change.reshape(postures.shape)

    def _strokes(self, word: WordTolerance) -> dict[tuple[int, int], tuple[float, int]]:
        """Pairs of postures between which the arms move, with the least time of it [s], and how often."""
        sign = word.arms.sign
        others = np.setdiff1d(np.arange(len(sign.joints)), word.arms.columns)
        speeds = self._speeds[self._humanoid.columns(sign.joints[column] for column in others)]
        found: dict[tuple[int, int], tuple[float, int]] = {}
        for knot, asked in enumerate(np.diff(sign.times).tolist()):
            pair = int(word.arms.at[knot]), int(word.arms.at[knot + 1])
            away = np.abs(sign.knots[knot + 1, others] - sign.knots[knot, others])
            needed = float((away / (_MEAN_SPEED * speeds)).max(initial=0.0))
            if pair[0] != pair[1]:
                least, count = found.get(pair, (0.0, 0))
                found[pair] = max(asked, needed, least), count + 1
        return found


# A word is made smaller if it takes so many times as long as asked for [1]: halfway to three times, which is
# what a word should not take.
_SLOW = 2.0
# Size of the palms' turns that a smaller word is sought around [1]: with the quarter by which each may differ
# from there they keep 60 %, the least size of signs (`SigningStyle.least_size`).
_SMALLER = 0.8
_SIZE = SigningStyle(least_size=1.0)
# Distances that differ by less are those of one motion under two names.
_SAME = 1e-6


class EasyTable:
    """Eases the words of one table."""

    def __init__(self, robot: Robot, table: Mapping[str, Sign]) -> None:
        """Prepare for the signs among which the words stand; the robot is not shared with another thread."""
        self._robot = robot
        humanoid = robot.humanoid
        before, after = (neighbours(humanoid, table, knot) for knot in (-1, 0))
        self._easy = EasyWords(humanoid, MotionLimits.of_robot(humanoid), before, after)
        self._signs = SignIndex.of_signs(robot, table.values())

    def eased(self, sign: Sign) -> Sign:
        """A word of the table with an easier posture as its alternative, or with none."""
        knots = self._acceptable(sign, turns=1.0)
        if knots is None or self._stretch(sign, knots) > _SLOW:
            smaller = self._acceptable(sign, turns=_SMALLER)
            if smaller is not None and (
                knots is None or self._stretch(sign, smaller) < self._stretch(sign, knots)
            ):
                knots = smaller
        return with_alternatives(sign, () if knots is None else (knots,))

    def taken_for_another(self, sign: Sign, knots: Array) -> str:
        """The sign of the table that looks more like a posture of a sign than its own; empty if none does."""
        shown = sign_appearance(self._robot, dataclasses.replace(sign, knots=knots))
        own = distance_between(shown, sign_appearance(self._robot, sign))
        (nearest,) = self._signs.nearest(shown, 1)
        return nearest.gloss if nearest.distance < own - _SAME else ""

    def _acceptable(self, sign: Sign, *, turns: float) -> Array | None:
        """Knots that take less time, are played and taken for no other sign; turns as of `WordTolerance`."""
        tolerance = WordTolerance(self._robot, sign, turns=turns)
        if not tolerance.arms.sides:
            return None

        def accepted(knots: Array) -> bool:
            return not self.taken_for_another(sign, knots) and self._stretch(sign, knots) < np.inf

        return self._easy.eased(tolerance, accepted)

    def _stretch(self, sign: Sign, knots: Array) -> float:
        """How many times as long as asked for these knots take alone, as large as they are [1].

        Infinite if they touch on the way.
        """
        played = dataclasses.replace(sign, knots=knots, alternatives=())
        planner = Planner({sign.gloss: played}, style=_SIZE, robot=self._robot, least_standing="sketched")
        try:
            return planner.plan([Token(gloss=sign.gloss)]).stretch
        except PlanError as error:
            if error.code != "self_collision":
                raise
            return np.inf
