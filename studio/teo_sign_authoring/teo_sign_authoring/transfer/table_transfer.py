# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A whole table of signs for a robot, made by several processes; what is there already stays.

A run that was stopped goes on where it was. A sign that the robot cannot make is told with its reason and
leaves no entry, so that it is spelled, or refused, when somebody asks for it.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import as_completed
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

from teo_description.robot import Robot
from teo_motion.planner import Planner
from teo_motion.sentence.plan import Plan
from teo_sign_authoring.transfer.language_signs import LanguageSigns
from teo_sign_capture.entries.batch import workers
from teo_sign_languages import load_language
from teo_signs.errors import LutError, PlanError
from teo_signs.sign import Sign, gloss_key
from teo_signs.sign_file import save_sign
from teo_signs.tokens import Kind, Token

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

    Args:
        language: Code of the sign language.
        robot: Name of the robot.
        glosses: Which signs.
        out: Directory of the table; made if it is not there.
        replace: Whether entries that are there are made anew.
        jobs: How many processes.
        done: Called with each sign as it is done.

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
        PlanError: It cannot be played.
    """
    planner = Planner({sign.gloss: sign}, robot=robot, least_standing="sketched")
    return planner.plan([Token(gloss=sign.gloss, kind=Kind[sign.kind.upper()])])


@functools.cache
def language_signs(language: str, robot: str) -> LanguageSigns:
    """The signs of a language for a robot, prepared once in each process."""
    return LanguageSigns(load_language(language), Robot.load(robot))
