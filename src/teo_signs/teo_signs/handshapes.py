# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which letters of the manual alphabet a hand looks like: the names by which people seek a handshape."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from teo_description.humanoid import Side, load_humanoid
from teo_signs.sign import Sign

# A finger bent by this much less or more [rad] is still seen in the same handshape: a third of the way from
# straight to folded.
_SAME_HANDSHAPE = 0.5
# Of a hand's six axes, the thumb's abduction first: handshapes are told by the fingers, and by the thumb half
# as much. Where the thumb lies beside a flat hand or a fist makes no other handshape of it.
_WEIGHTS = (0.0, 0.5, 1.0, 1.0, 1.0, 1.0)


class Handshapes:
    """Names handshapes by the letters that have them."""

    def __init__(self, signs: Iterable[Sign]) -> None:
        """Take the letters among signs, each as its hand begins."""
        self._letters = {
            sign.gloss: hand[0]
            for sign in signs
            if sign.kind == "letter" and (hand := _hand(sign)) is not None
        }

    def of(self, sign: Sign) -> list[str]:
        """The letters that the leading hand looks like, at each knot the nearest; sorted."""
        hand = _hand(sign)
        if hand is None or not self._letters:
            return []
        names = list(self._letters)
        letters = np.array(list(self._letters.values()))
        weights = [weight for weight, axis in zip(_WEIGHTS, _axes(sign), strict=True) if axis]
        apart = (weights * np.abs(hand[:, None, :] - letters[None, :, :])).max(axis=2)
        nearest = apart.argmin(axis=1)
        near = {names[letter] for knot, letter in enumerate(nearest) if apart[knot, letter] < _SAME_HANDSHAPE}
        return sorted(near)


def _hand(sign: Sign) -> NDArray[np.float64] | None:
    """Angles of the leading hand's axes [rad], shape (knots, axes); None if not all of them move."""
    joints = [axis for axis in _axes(sign) if axis]
    if not set(joints) <= set(sign.joints):
        return None
    return sign.knots[:, [sign.joints.index(joint) for joint in joints]]


def _axes(sign: Sign) -> tuple[str | None, ...]:
    """The six axes of the leading hand, None for those that it lacks."""
    side: Side = "left" if sign.handedness == "left" else "right"
    return load_humanoid(sign.robot).hand_axes(side)
