# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How well a robot shows the signs of a language: what is off, how slow it is, what it cannot make."""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from teo_sign_authoring.transfer.language_signs import language_signs, map_signs, played_alone
from teo_signs.errors import LutError, PlanError
from teo_signs.look_up_table import Lut
from teo_signs.sign import Sign
from teo_signs.sign_schema import Kind

# Most by which a sign within tolerance is off: 50 mm is from chin to nose; 45 deg is half-way to the next way
# in which palms and fingers differ (as of `entries.gates`).
PLACE_MM, ANGLE_DEG = 50.0, 45.0


@dataclass(frozen=True, kw_only=True)
class SignFit:
    """How well a robot shows one sign.

    Attributes:
        gloss: The sign.
        kind: "lexical", "letter" or "number"; of a refused sign, "letter" or "lexical".
        place_mm: By how much a hand is off its place at most [mm]; NaN of a refused sign, as all figures.
        palm_deg: The same of the way the palm faces [deg].
        finger_deg: The same of the way the fingers point [deg]; of a letter part of `palm_deg`, and 0.
        tip_mm: Of a letter, how far the ends of fingers are from where a person's are [mm]; else 0.
        stretch: How many times as long as asked for it takes alone [1].
        refused: Code of the reason for which the robot does not make it; else empty.
        reason: That reason in a sentence.
    """

    gloss: str
    kind: Kind
    place_mm: float = float("nan")
    palm_deg: float = float("nan")
    finger_deg: float = float("nan")
    tip_mm: float = float("nan")
    stretch: float = float("nan")
    refused: str = ""
    reason: str = ""

    @property
    def within(self) -> bool:
        """Whether it is shown, and off by no more than `PLACE_MM` and `ANGLE_DEG`."""
        return not self.refused and (
            self.place_mm <= PLACE_MM and self.palm_deg <= ANGLE_DEG and self.finger_deg <= ANGLE_DEG
        )


def fit_table(
    language: str,
    robot: str,
    glosses: Sequence[str],
    table: Path | None,
    *,
    jobs: int,
    done: Callable[[SignFit], None],
) -> list[SignFit]:
    """Look at signs of a language on a robot.

    Args:
        language: Code of the sign language.
        robot: Name of the robot.
        glosses: Which signs.
        table: As for `entries`. What has no entry is made to be looked at.
        jobs: How many processes.
        done: Called with each sign as it is done.

    Returns:
        In the order of `glosses`.
    """
    found = {}
    for fit in map_signs(functools.partial(_fit, language, robot, table), glosses, jobs):
        found[fit.gloss] = fit
        done(fit)
    return [found[gloss] for gloss in glosses]


def within_share(fits: Iterable[SignFit]) -> float:
    """Share of signs within tolerance, refused ones counted as outside [1]."""
    return float(np.mean([fit.within for fit in fits]))


def median_stretch(fits: Iterable[SignFit]) -> float:
    """Of the signs that are made [1]."""
    return float(np.median([fit.stretch for fit in fits if not fit.refused]))


def _fit(language: str, robot: str, table: Path | None, gloss: str) -> SignFit:
    signs = language_signs(language, robot)
    kind: Kind = "letter" if gloss in signs.language.alphabet.letters else "lexical"
    try:
        kept = entries(language, robot, table)
        sign = kept[gloss] if gloss in kept else signs.sign(gloss)
        plan = played_alone(signs.robot, sign)
    except (LutError, PlanError) as error:
        return SignFit(gloss=gloss, kind=kind, refused=error.code, reason=str(error))
    figures = sign.quality
    return SignFit(
        gloss=gloss,
        kind=sign.kind,
        place_mm=figures.get("place_error_mm", 0.0),
        palm_deg=figures.get("palm_angle_error_deg", 0.0),
        finger_deg=figures.get("finger_angle_error_deg", 0.0),
        tip_mm=figures.get("fingertip_error_mm", 0.0),
        stretch=plan.stretch,
    )


@functools.cache
def entries(language: str, robot: str, table: Path | None) -> Mapping[str, Sign]:
    """A robot's table, listed once in each process; empty if none is named and there is none.

    Args:
        language: Code of the sign language.
        robot: Name of the robot.
        table: Its directory; None for the user's own table and, beneath it, the language's.

    Raises:
        LutError: As `Lut.open`.
    """
    try:
        return Lut.open(table, language=language, robot=robot)
    except LutError as error:
        if error.code == "no_table":
            return {}
        raise
