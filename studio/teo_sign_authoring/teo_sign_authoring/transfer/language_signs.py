# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The signs of a language for a robot, each from what it is known by, and a whole table of them.

A letter from its recording, a word or number from its score; a sign that another robot alone has, from
what that shows, with less evidence. A table is made by several processes. What is there already stays, so
that a run that was stopped goes on where it was. A sign that the robot cannot make is told with its
reason and leaves no entry, so that it is spelled, or refused, when somebody asks for it.
"""

from __future__ import annotations

import datetime
import functools
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import as_completed
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TypeVar

import numpy as np
from msgspec.structs import replace as changed

from teo_common.arrays import Array
from teo_description.hand_geometry import hand_table
from teo_description.robot import Robot
from teo_motion.planner import Planner
from teo_motion.sentence.plan import Plan
from teo_sign_authoring.alphabet.letters import RecordedAlphabet, capture_letter, letter_bends, read_alphabet
from teo_sign_authoring.notation.score_file import read_scores
from teo_sign_authoring.notation.score_retarget import posture_figures, posture_motion, score_sign
from teo_sign_authoring.notation.score_schema import Score
from teo_sign_authoring.transfer.entry_postures import entry_postures
from teo_sign_capture.entries.batch import workers
from teo_sign_capture.signing_space import WRITTEN_FOR, finger_rows
from teo_sign_languages import Language, load_language
from teo_signs.errors import LutError, PlanError
from teo_signs.look_up_table import Lut
from teo_signs.sign import Sign, gloss_key
from teo_signs.sign_file import save_sign
from teo_signs.sign_schema import STANDINGS, Standing
from teo_signs.tokens import Kind, Token

_FINGERS = ("index", "middle", "ring", "little")
# [rad] A finger that is bent less in all is seen beside a fist: one that a hand lacks is missed then. The
# alphabet's folded fingers are bent by 138 deg or more, its half bent ones by 121 deg or less.
_FOLDED = np.radians(125.0)


class LanguageSigns:
    """Makes them; the robot is not shared with another thread."""

    def __init__(self, language: Language, robot: Robot) -> None:
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
                that is seen in it, "self_collision", or that of a letter as `load_letter_clips` has it.
        """
        if gloss in self.language.alphabet.letters and gloss not in self._scores:
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
        provenance = changed(
            entry.provenance,
            standing=_less(entry.provenance.standing),
            method=(
                f"what the entry for {entry.robot} shows, place by place of the body, brought onto "
                f"{humanoid.name} as a score is (lut retarget)"
            ),
            created=datetime.date.today().isoformat(),
            description_hash=humanoid.description_hash,
            review=None,
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


Result = TypeVar("Result")

# Fewer signs are done before another process has loaded what it needs.
_WORTH_PROCESSES = 8


@dataclass(frozen=True, kw_only=True)
class Transferred:
    """What became of a sign.

    Attributes:
        gloss: The sign.
        code: "made", "unchanged", or the reason for which it was not made.
        message: The reason in a sentence; empty of signs that were made or are there.
    """

    gloss: str
    code: str
    message: str = ""

    @property
    def refused(self) -> bool:
        """Whether there is no entry of the sign."""
        return self.code not in ("made", "unchanged")


def transfer_table(
    language: str,
    robot: str,
    glosses: Sequence[str],
    out: Path,
    *,
    replace: bool,
    jobs: int,
    done: Callable[[Transferred], None],
) -> list[Transferred]:
    """Make the signs of a table.

    Returns:
        What became of each, in the order of `glosses`.
    """
    there = [] if replace else [gloss for gloss in glosses if (out / f"{gloss_key(gloss)}.json").exists()]
    found = {gloss: Transferred(gloss=gloss, code="unchanged") for gloss in there}
    for unchanged in found.values():
        done(unchanged)
    wanted = [gloss for gloss in glosses if gloss not in found]
    work = functools.partial(_transfer, language, robot, out, replace)
    for made in map_signs(work, wanted, jobs):
        found[made.gloss] = made
        done(made)
    return [found[gloss] for gloss in glosses]


def map_signs(work: Callable[[str], Result], glosses: Sequence[str], jobs: int) -> Iterator[Result]:
    """Do work for each sign, in this process or in several, and yield what comes of it as it is done."""
    if jobs == 1 or len(glosses) < _WORTH_PROCESSES:
        yield from map(work, glosses)
        return
    with workers(min(jobs, len(glosses)), None) as executor:
        for future in as_completed([executor.submit(work, gloss) for gloss in glosses]):
            yield future.result()


def _transfer(language: str, robot: str, out: Path, replace: bool, gloss: str) -> Transferred:
    signs = language_signs(language, robot)
    try:
        sign = signs.sign(gloss)
        played_alone(signs.robot, sign)
        save_sign(out, sign, replace=replace)
    except (LutError, PlanError) as error:
        return Transferred(gloss=gloss, code=error.code, message=str(error))
    return Transferred(gloss=gloss, code="made")


def played_alone(robot: Robot, sign: Sign) -> Plan:
    """What the planner makes of a sign from rest to rest.

    Raises:
        PlanError: It cannot be played, or one of its forms cannot.
    """
    planner = Planner({sign.gloss: sign}, robot=robot, least_standing="sketched")
    citation = Token(gloss=sign.gloss, kind=Kind[sign.kind.upper()])
    for inflection in sign.forms:
        planner.plan([replace(citation, inflection=inflection)])
    return planner.plan([citation])


@functools.cache
def language_signs(language: str, robot: str) -> LanguageSigns:
    """The signs of a language for a robot, prepared once in each process."""
    return LanguageSigns(load_language(language), Robot.load(robot))
