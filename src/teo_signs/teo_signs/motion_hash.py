# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which motion a review was of: the hash of a sign's motion, and the standing that it leaves in force."""

from __future__ import annotations

import hashlib
import json
from dataclasses import replace

from teo_signs.sign import Sign


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


def with_standing_in_force(sign: Sign) -> Sign:
    """The sign, with the standing that it had before its review if that was of another motion."""
    provenance = sign.provenance
    review = provenance.review
    if provenance.standing != "reviewed" or review is None or review.motion_hash == motion_hash(sign):
        return sign
    return replace(sign, provenance=provenance.model_copy(update={"standing": review.standing}))
