# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which easier posture a word of a table is given: one that is played, and taken for no other sign.

What `EasyWords` finds within the tolerance may still touch between two knots, and small differences of every
kind together may bring it nearer to another sign. It is therefore played by the planner, and compared with
all signs of the table. A word that is slow all the same is made smaller: its palms turn less.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping

import numpy as np

from teo_common.arrays import Array
from teo_description.robot import Robot
from teo_motion.planner import Planner
from teo_motion.sentence.signing_style import SigningStyle
from teo_motion.trajectory.limits import MotionLimits
from teo_sign_authoring.easing.easy_words import EasyWords, neighbours
from teo_sign_authoring.easing.word_tolerance import WordTolerance
from teo_sign_capture.recognition.appearance import sign_appearance
from teo_sign_capture.recognition.sign_index import SignIndex, distance_between
from teo_signs.errors import PlanError
from teo_signs.motion_hash import with_alternatives
from teo_signs.sign import Sign
from teo_signs.tokens import Token

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
        """Prepare.

        Args:
            robot: Not shared with another thread.
            table: The signs among which the words stand.
        """
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
        """Knots that take less time, are played and taken for no other sign.

        Args:
            sign: The word.
            turns: As of `WordTolerance`.
        """
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
