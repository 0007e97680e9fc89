# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a learner showed beside the sign that was meant: which parts of it differ, and how much."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from dtaidistance import dtw_ndim  # type: ignore[import-untyped]  # ships no types

from teo_common.arrays import Array
from teo_sign_capture.recognition.appearance import HAND, PARTS
from teo_sign_capture.recognition.sign_index import AHEAD, distance_between


@dataclass(frozen=True, kw_only=True)
class Comparison:
    """How what was shown differs from a sign, by the parts of which signs are made (Stokoe 1960).

    Differences are root mean squares over the sign, its time warped, of the hand that differs more, in the
    units of `appearance`: 1 is what a person's sign differs by from its entry in half of the known takes, 4
    what another sign does.

    Attributes:
        gloss: The sign.
        distance: Of both, as `Match.distance`.
        hands: Whether the same number of hands take part. Of a hand that does so in one of them alone nothing
            else is said.
        handshape: By the bends of the fingers.
        orientation: By the ways palm and fingers point.
        place: By where the hand is on the whole.
        movement: By the hand's way from there.
    """

    gloss: str
    distance: float
    hands: bool
    handshape: float
    orientation: float
    place: float
    movement: float


def compare(gloss: str, shown: Array, sign: Array) -> Comparison:
    """Compare what was shown with a sign.

    Args:
        gloss: The sign's name.
        shown: As `recording_appearance` gives it. Shape (MOMENTS, 2 * HAND).
        sign: As `sign_appearance` gives it; of the same shape.
    """
    shown, sign = (np.ascontiguousarray(given, dtype=np.float64) for given in (shown, sign))
    path = np.array(dtw_ndim.warping_path(shown, sign, window=AHEAD + 1))
    apart = shown[path[:, 0]] - sign[path[:, 1]]
    taking_part = [
        (bool(shown[0, first + PARTS.presence]), bool(sign[0, first + PARTS.presence])) for first in (0, HAND)
    ]
    hands = [
        _by_part(apart[:, first : first + HAND])
        for first, parts in zip((0, HAND), taking_part, strict=True)
        if all(parts)
    ]
    worst = np.max(hands, axis=0) if hands else np.zeros(4)
    handshape, orientation, place, movement = np.round(worst, 3).tolist()
    return Comparison(
        gloss=gloss,
        distance=round(distance_between(shown, sign), 3),
        hands=all(one == other for one, other in taking_part),
        handshape=handshape,
        orientation=orientation,
        place=place,
        movement=movement,
    )


def _by_part(apart: Array) -> Array:
    """Handshape, orientation, place and movement of one hand's differences. Shape (4,)."""
    where = apart[:, PARTS.place]
    place = where.mean(axis=0)
    parts = (apart[:, PARTS.bends], apart[:, PARTS.turns], place[None, :], where - place)
    return np.array([np.sqrt((part**2).sum(axis=1).mean()) for part in parts])
