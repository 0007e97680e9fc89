# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which motion something was made for: hashes of a sign's motion, which reviews and alternatives carry."""

from __future__ import annotations

import hashlib
import json
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from teo_signs.sign import Sign

# Entries keep so many decimals of a second and a radian: a hash sees no more of them.
_DECIMALS = 6


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
    form = [list(sign.joints), *(_rounded(values).tolist() for values in (sign.times, sign.knots))]
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
    return replace(sign, provenance=provenance.model_copy(update={"standing": review.standing}))


def with_alternatives_in_force(sign: Sign) -> Sign:
    """The sign without alternatives if they were made for another motion: that sign changed since."""
    if not sign.alternatives or sign.alternatives_of == citation_hash(sign):
        return sign
    return replace(sign, alternatives=(), alternatives_of=sign.alternatives_of or "unknown")


def _rounded(values: NDArray[np.float64]) -> NDArray[np.float64]:
    rounded: NDArray[np.float64] = np.round(values, _DECIMALS) + 0.0  # no negative zeros
    return rounded
