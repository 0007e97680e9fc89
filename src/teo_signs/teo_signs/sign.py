# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A sign as the robot makes it, and the hashes by which reviews and alternatives name its motion."""

from __future__ import annotations

import hashlib
import json
import unicodedata
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType

import numpy as np
from msgspec.structs import replace as changed
from numpy.typing import NDArray

from teo_description.humanoid import SIDES, load_humanoid
from teo_signs.sign_schema import DEFAULT_ROBOT, Handedness, Kind, Provenance


@dataclass(frozen=True, kw_only=True, eq=False)
class Form:
    """An inflected form of a sign: the same joints, moved otherwise.

    Attributes:
        times: Times of the knots [s], from 0, strictly increasing. Shape (n,), read-only.
        knots: Positions [rad], a column for each of the sign's joints. Shape (n, joints), read-only.
    """

    times: NDArray[np.float64]
    knots: NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Sign:
    """One sign of the look-up table.

    Attributes:
        gloss: Name, upper-case Spanish with accents, a space written "_".
        language: ISO 639-3 code of the sign language.
        kind: "lexical", "letter" or "number".
        handedness: Hands that make the sign: "right", "left" or "both".
        joints: Names of the joints that the sign moves; the others are free.
        times: Times of the knots [s], from 0, strictly increasing. Shape (n,), read-only.
        knots: Positions [rad], a column for each of `joints`. Shape (n, len(joints)), read-only.
        provenance: Where the sign came from.
        quality: Figures of the capture, by name.
        forms: Inflected forms by inflection: "2>1" from the addressee to the signer, "CABEZA" at the head.
            What `times` and `knots` hold is the citation form.
        alternatives: Other postures of the same sign that are read as well, for the planner to choose from:
            each as `knots`, at the same times. Read-only.
        alternatives_of: `citation_hash` of the sign that they were made for; empty without. An
            entry that changed since has the hash, or "unknown", and no alternatives.
        robot: Name of the robot whose joints they are.
    """

    gloss: str
    language: str
    kind: Kind
    handedness: Handedness
    joints: tuple[str, ...]
    times: NDArray[np.float64]
    knots: NDArray[np.float64]
    provenance: Provenance
    quality: Mapping[str, float]
    forms: Mapping[str, Form] = field(default_factory=lambda: MappingProxyType({}))
    alternatives: tuple[NDArray[np.float64], ...] = ()
    alternatives_of: str = ""
    robot: str = DEFAULT_ROBOT

    @property
    def duration(self) -> float:
        """Time from the first knot to the last [s]; 0 for a held pose."""
        return float(self.times[-1])

    def pose(self, knot: int) -> dict[str, float]:
        """Positions of one knot [rad], by joint name; -1 is the last knot."""
        return dict(zip(self.joints, self.knots[knot].tolist(), strict=True))

    def inflected(self, inflection: str) -> Sign:
        """The sign in one of its forms; as it is if it has no such form, or none is asked for ("").

        A form has no `alternatives`: they are postures of the citation form.
        """
        form = self.forms.get(inflection)
        return self if form is None else replace(self, times=form.times, knots=form.knots, alternatives=())


def gloss_key(gloss: str) -> str:
    """The name under which a gloss is kept: composed Unicode, spaces written "_"."""
    return unicodedata.normalize("NFC", gloss).replace(" ", "_")


def sign_warnings(sign: Sign) -> tuple[str, ...]:
    """What is odd about a sign that can be used all the same; a sentence each."""
    warnings = []
    humanoid = load_humanoid(sign.robot)
    made_for, in_use = sign.provenance.description_hash, humanoid.description_hash
    if made_for != in_use:
        warnings.append(
            f"{sign.gloss}: provenance.description_hash: expected {in_use[:12]}… (the robot in use), "
            f"got {made_for[:12]}…; made for another description of the robot, look at it again"
        )
    moved = set(sign.joints)
    sides = {side for side in SIDES if moved.intersection(humanoid.arm(side) + humanoid.hand(side))}
    expected = {*SIDES} if sign.handedness == "both" else {sign.handedness}
    if sides != expected:
        warnings.append(
            f"{sign.gloss}: handedness: expected joints of {', '.join(sorted(expected))} for "
            f"{sign.handedness!r}, got {', '.join(sorted(sides)) or 'none of an arm or hand'}"
        )
    if sign.provenance.review is not None and sign.provenance.standing != "reviewed":
        warnings.append(
            f"{sign.gloss}: provenance.review: expected a review of the motion as it is, got one of another "
            f"motion; the sign is {sign.provenance.standing} until it is reviewed again"
        )
    if sign.alternatives_of and not sign.alternatives:
        warnings.append(
            f"{sign.gloss}: alternatives_of: expected alternatives made for the motion as it is, got some "
            f"made for {sign.alternatives_of[:12]}…; they are not used: make them anew (`lut ease "
            f"{sign.gloss}`, letters `ease_letters`)"
        )
    return tuple(warnings)


# Decimals of a second and of a radian that entries keep, one more than encoders resolve; a hash sees no more.
DECIMALS = 6


def motion_hash(sign: Sign) -> str:
    """SHA-256 of what a sign moves and when, of a sign as read from its file.

    All that the robot does by the entry counts: joints, times, knots, forms and alternatives. Notes, figures
    and the source do not.

    Returns:
        64 lower-case hexadecimal digits.
    """
    forms = {name: [form.times.tolist(), form.knots.tolist()] for name, form in sorted(sign.forms.items())}
    alternatives = [other.tolist() for other in sign.alternatives]
    motion = [list(sign.joints), sign.times.tolist(), sign.knots.tolist(), forms, alternatives]
    return hashlib.sha256(json.dumps(motion).encode()).hexdigest()


def citation_hash(sign: Sign) -> str:
    """SHA-256 of a sign's citation form as its file keeps it: joints, times and knots.

    Returns:
        64 lower-case hexadecimal digits.
    """
    # Zero is added to take the sign from -0.0.
    kept = ((np.round(values, DECIMALS) + 0.0).tolist() for values in (sign.times, sign.knots))
    form = [list(sign.joints), *kept]
    return hashlib.sha256(json.dumps(form).encode()).hexdigest()


def with_alternatives(sign: Sign, alternatives: tuple[NDArray[np.float64], ...]) -> Sign:
    """The sign with other postures than it had, which its file keeps for as long as it is the same sign."""
    return replace(
        sign, alternatives=alternatives, alternatives_of=citation_hash(sign) if alternatives else ""
    )


def with_standing_in_force(sign: Sign) -> Sign:
    """The sign, with the standing that it had before its review if that was of another motion."""
    provenance = sign.provenance
    review = provenance.review
    if provenance.standing != "reviewed" or review is None or review.motion_hash == motion_hash(sign):
        return sign
    return replace(sign, provenance=changed(provenance, standing=review.standing))


def with_alternatives_in_force(sign: Sign) -> Sign:
    """The sign without alternatives if they were made for another motion: that sign changed since."""
    if not sign.alternatives or sign.alternatives_of == citation_hash(sign):
        return sign
    return replace(sign, alternatives=(), alternatives_of=sign.alternatives_of or "unknown")
