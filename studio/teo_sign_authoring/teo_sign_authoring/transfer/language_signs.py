# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The signs of a language for a robot, each from what it is known by.

A letter from its recording, a word or number from its score; a sign that another robot alone has, from what
that shows, with less evidence.
"""

from __future__ import annotations

import datetime
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import cached_property

import numpy as np

from teo_common.arrays import Array
from teo_description.hand_geometry import hand_table
from teo_description.robot import Robot
from teo_sign_authoring.alphabet.letters import RecordedAlphabet, capture_letter, letter_bends, read_alphabet
from teo_sign_authoring.notation.posture_motion import posture_figures, posture_motion
from teo_sign_authoring.notation.score_file import read_scores
from teo_sign_authoring.notation.score_retarget import score_sign
from teo_sign_authoring.notation.score_schema import Score
from teo_sign_authoring.transfer.entry_postures import entry_postures
from teo_sign_capture.signing_space import WRITTEN_FOR, finger_rows
from teo_sign_languages import Language
from teo_signs.errors import LutError
from teo_signs.look_up_table import Lut
from teo_signs.sign import Sign
from teo_signs.sign_schema import STANDINGS, Standing

_FINGERS = ("index", "middle", "ring", "little")
# [rad] A finger that is bent less in all is seen beside a fist: one that a hand lacks is missed then. The
# alphabet's folded fingers are bent by 138 deg or more, its half bent ones by 121 deg or less.
_FOLDED = np.radians(125.0)


class LanguageSigns:
    """Makes them.

    Attributes:
        language: The language.
        robot: The robot; not shared with another thread.
    """

    def __init__(self, language: Language, robot: Robot) -> None:
        """Prepare.

        Args:
            language: The language.
            robot: The robot.
        """
        self.language, self.robot = language, robot
        self._rows = finger_rows(hand_table(robot).hand)

    @cached_property
    def glosses(self) -> tuple[str, ...]:
        """Names of all signs: the alphabet's letters, then the others by name."""
        others = sorted({*self._scores, *self._table} - set(self.language.alphabet.letters))
        return (*self.language.alphabet.letters, *others)

    def sign(self, gloss: str) -> Sign:
        """Make one.

        Raises:
            LutError: "unknown_sign" if nothing is known of it, "missing_finger" if the hand lacks a finger
                that is seen in it, or "self_collision".
        """
        if gloss in self._alphabet.clips:
            self._check_fingers(gloss, letter_bends(self._alphabet, gloss))
            return capture_letter(self.robot, self._alphabet, gloss)
        if gloss in self._scores:
            return score_sign(self.robot, self._scores[gloss], language=self.language.code)
        if gloss in self._table:
            return self._from_entry(self._table[gloss])
        raise LutError("unknown_sign", f"expected a sign of {self.language.code}, got {gloss!r}")

    @cached_property
    def _alphabet(self) -> RecordedAlphabet:
        return read_alphabet(self.robot, self.language)

    @cached_property
    def _scores(self) -> Mapping[str, Score]:
        return {score.gloss: score for score in read_scores(self.language.scores)}

    @cached_property
    def _table(self) -> Mapping[str, Sign]:
        return Lut.open(self.language.table(WRITTEN_FOR), language=self.language.code, robot=WRITTEN_FOR)

    @cached_property
    def _source(self) -> Robot:
        return Robot.load(WRITTEN_FOR)

    def letters_beyond(self, glosses: Iterable[str]) -> Iterator[tuple[str, str]]:
        """Letters among some signs that the hand lacks a finger for, each with the reason as it is found.

        Raises:
            LutError: As `read_alphabet`.
        """
        if len(self._rows) == len(_FINGERS):
            return
        for gloss in glosses:
            if gloss in self._alphabet.clips:
                try:
                    self._check_fingers(gloss, letter_bends(self._alphabet, gloss))
                except LutError as error:
                    yield gloss, str(error)

    def _check_fingers(self, gloss: str, bends: Array) -> None:
        missed = [
            _FINGERS[finger]
            for finger in range(len(_FINGERS))
            if finger not in self._rows and bends[:, finger].min() < _FOLDED
        ]
        if missed:
            raise LutError(
                "missing_finger",
                f"{gloss}: expected a hand with the {' and '.join(missed)} finger, which this letter shows; "
                f"{self.robot.humanoid.name} has {', '.join(_FINGERS[row] for row in self._rows)}",
            )

    def _from_entry(self, entry: Sign) -> Sign:
        hands, moments = entry_postures(self._source, entry, self.robot)
        motion = posture_motion(self.robot, entry.gloss, hands, moments)
        humanoid = self.robot.humanoid
        provenance = entry.provenance.model_copy(
            update={
                "standing": _less(entry.provenance.standing),
                "method": (
                    f"what the entry for {entry.robot} shows, place by place of the body, brought onto "
                    f"{humanoid.name} as a score is (lut retarget)"
                ),
                "created": datetime.date.today().isoformat(),
                "description_hash": humanoid.description_hash,
                "review": None,
            }
        )
        return replace(
            entry,
            robot=humanoid.name,
            joints=motion.joints,
            times=motion.times,
            knots=motion.knots,
            forms={},
            alternatives=(),
            alternatives_of="",
            provenance=provenance,
            quality=posture_figures(self.robot, (motion,)),
        )


def _less(standing: Standing) -> Standing:
    """One level less well founded."""
    return STANDINGS[min(STANDINGS.index(standing) + 1, len(STANDINGS) - 1)]
