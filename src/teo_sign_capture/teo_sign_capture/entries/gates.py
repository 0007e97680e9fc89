# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a captured sign must keep to: gates over its figures, each with two bounds and with what to do.

Up to the first bound a sign is taken. Between both, whoever has looked at it decides: it is refused with the
moment at which it is worst, or, accepted, written as one level less well founded with the reasons in its
notes. Beyond the second it is another sign, or none, and nobody can accept it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import NamedTuple

from teo_signs.errors import LutError
from teo_signs.sign_schema import STANDINGS, Standing


class _Gate(NamedTuple):
    """The most that a figure of an entry's quality may be: unasked, and with a person's consent."""

    code: str
    figure: str
    most: float
    most_accepted: float
    unit: str
    expected: str
    remedy: str


# Bounds are where right and wrong part in 58 captures, of films and of rendered people, that two judges saw
# beside the person. The most of each figure, unasked: a fifth of the frames filled in is a beat of a
# repeated sign that nobody saw; of palms beyond 50 deg half were read as another way, of others one in ten;
# hands up to 125 mm off, as seen, were read at their place, on the body up to 114 mm, but at the face 50 mm
# are from chin to nose; four whose major place was wrong in 0.27 to 0.61 of the stroke were read at the right
# one, for who watches does not see how far in front of the face a hand is; at a sixth of the pace a stroke of
# half a second lasts three, and reads as several.
# And with consent: of a hand that is lost in half of the frames more is guessed than seen; at 90 deg the palm
# faces the next cardinal direction, which is another sign's; 200 mm are as high as a region (face, chest,
# belly); of contacts and major places what is beyond those that were seen; at a tenth of the pace a mere
# touch of 0.3 s lasts 3 s, as long as the longest signs.
_GATES = (
    _Gate(
        "much_lost",
        "lost_percent",
        20.0,
        50.0,
        " %",
        "frames in which a hand that signs is lost",
        "record it again with both hands in the picture, neither behind the other for long, in good light "
        "and nearer to the camera",
    ),
    _Gate(
        "palm_off",
        "palm_error_p95_deg",
        50.0,
        90.0,
        " deg",
        "a palm's error",
        "show it with a straighter wrist, or cut the way up and down off with --start and --end",
    ),
    _Gate(
        "contact_off",
        "contact_error_p95_mm",
        50.0,
        125.0,
        " mm",
        "a contact's error, as seen from in front,",
        "show the touch before the body, not beside or behind it",
    ),
    _Gate(
        "place_off",
        "seen_place_error_p95_mm",
        125.0,
        200.0,
        " mm",
        "a hand's error of place, as seen from in front,",
        "show it farther before the body and nearer to the middle, where the robot's arms reach",
    ),
    _Gate(
        "wrong_place",
        "major_place_wrong",
        0.3,
        0.7,
        " of the stroke",
        "a major place that differs from the person's in",
        "show it farther before the body and nearer to the middle, where the robot's arms reach",
    ),
    _Gate(
        "too_slow",
        "stretch_times",
        6.0,
        10.0,
        " times",
        "a stretch",
        "show it slower and without a tremble, or record it nearer to the camera or at a higher rate of "
        "images",
    ),
)
# [s] A shorter stroke is a piece of one: four frames of a hand's beat at 15 Hz. Two tell no movement.
_LEAST_DURATION, _LEAST_ACCEPTED_DURATION = 0.25, 0.125


@dataclass(frozen=True, kw_only=True)
class Verdict:
    """How a captured sign stands at one gate.

    Attributes:
        code: Stable reason of a refusal: "much_lost", "palm_off", "contact_off", "place_off", "wrong_place",
            "too_slow", "too_short" or "no_rest".
        passed: Whether it keeps to the gate.
        acceptable: Whether a person may take it all the same.
        message: What was expected and what came.
        remedy: What to do where it does not.
        at: When in the recording it is worst [s]; None where no moment is.
        got: The figure that is judged, in the unit of the entry's `quality`; of "too_short" the stroke [s];
            None of "no_rest".
        bound: The most that it may be, of "too_short" the least; None of "no_rest".
    """

    code: str
    passed: bool
    acceptable: bool
    message: str
    remedy: str
    at: float | None = None
    got: float | None = None
    bound: float | None = None


class RefusedError(LutError):
    """A sign that a gate refuses.

    Attributes:
        verdicts: How it stands at every gate.
    """

    def __init__(self, code: str, message: str, verdicts: tuple[Verdict, ...]) -> None:
        """Keep the verdicts beside code and sentence."""
        super().__init__(code, message)
        self.verdicts = verdicts

    def __reduce__(self) -> tuple[type[RefusedError], tuple[str, str, tuple[Verdict, ...]]]:
        """Its arguments, so that the error can pass from one process to another."""
        return RefusedError, (self.code, str(self), self.verdicts)


def judge(
    quality: Mapping[str, float],
    *,
    duration: float,
    has_rest: bool,
    worst: Mapping[str, float] = MappingProxyType({}),
) -> tuple[Verdict, ...]:
    """How a captured sign stands at every gate.

    Args:
        quality: Figures of its entry; a gate whose figure is not there is left out.
        duration: Of the stroke, as the person made it [s].
        has_rest: Whether the hands were seen at rest before or after it, or somebody chose where it begins or
            ends.
        worst: When in the recording each figure is worst, as far as it is known [s].
    """
    figures = [
        Verdict(
            code=gate.code,
            passed=quality[gate.figure] <= gate.most,
            acceptable=quality[gate.figure] <= gate.most_accepted,
            message=f"expected {gate.expected} of at most {gate.most:g}{gate.unit}, got "
            f"{quality[gate.figure]:g}{gate.unit}"
            + (f", worst at {worst[gate.figure]:.2f} s" if gate.figure in worst else ""),
            remedy=gate.remedy,
            at=worst.get(gate.figure),
            got=quality[gate.figure],
            bound=gate.most,
        )
        for gate in _GATES
        if gate.figure in quality
    ]
    length = Verdict(
        code="too_short",
        passed=duration >= _LEAST_DURATION,
        acceptable=duration >= _LEAST_ACCEPTED_DURATION,
        message=f"expected a stroke of {_LEAST_DURATION:g} s or more, got {duration:.2f} s",
        remedy="let the hands rest before and after it, or say where it is with --start and --end",
        got=duration,
        bound=_LEAST_DURATION,
    )
    got = "them" if has_rest else "a recording that begins and ends within it"
    rest = Verdict(
        code="no_rest",
        passed=has_rest,
        acceptable=True,
        message=f"expected hands at rest before or after the sign, got {got}",
        remedy="record it from rest to rest, or say with --start and --end where the sign is",
    )
    return (*figures, length, rest)


def most_of(figure: str) -> float | None:
    """The most that a figure of an entry's quality may be unasked; None of one that no gate looks at."""
    return next((gate.most for gate in _GATES if gate.figure == figure), None)


def objections(verdicts: Iterable[Verdict]) -> tuple[Verdict, ...]:
    """The gates that a sign is beyond."""
    return tuple(verdict for verdict in verdicts if not verdict.passed)


def accepted_standing(
    gloss: str, standing: Standing, verdicts: tuple[Verdict, ...], *, accept: bool
) -> Standing:
    """How well founded a sign is after what speaks against it: as before, or one level lower if accepted.

    Raises:
        RefusedError: The first objection's code and all their messages, if the sign is not accepted or cannot
            be; what nobody can accept comes first.
    """
    against = sorted(objections(verdicts), key=lambda objection: objection.acceptable)
    if not against:
        return standing
    acceptable = against[0].acceptable
    if accept and acceptable:
        return STANDINGS[min(STANDINGS.index(standing) + 1, len(STANDINGS) - 1)]
    reasons = "; ".join(f"{objection.message}: {objection.remedy}" for objection in against)
    choice = (
        "--accept takes it as it is, one level of evidence lower"
        if acceptable
        else f"{against[0].code} is so far off that --accept does not take it either"
    )
    raise RefusedError(against[0].code, f"{gloss}: {reasons}. {choice}", verdicts)
