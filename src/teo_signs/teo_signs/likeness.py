# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How different two signs look: handshape, orientation of the palm, movement, place.

Each is measured on both hands at moments spread over the sign, in units of its just noticeable difference at
conversation distance: the thickness of a finger, 15 deg, or two neighbouring places on the face. Signs are
told apart by any one of them on either hand, so that the largest is the difference of the pair. People seek a
handshape by the letter that it looks like: `Handshapes` names it so.
"""

from __future__ import annotations

from collections.abc import Container, Iterable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from teo_common.arrays import Array
from teo_description.humanoid import SIDES, Side, load_humanoid
from teo_description.robot import Robot
from teo_signs.sign import Sign

# Just noticeable difference of a length [m]: the thickness of one of TEO's fingers.
SEEN_LENGTH = 0.015

# Just noticeable difference of an angle [rad]: it moves a finger's tip by about a finger's thickness.
SEEN_ANGLE = float(np.radians(15.0))

# Just noticeable difference of a place [m]: the distance of TEO's mouth and chin.
SEEN_PLACE = 0.028

# Two entries of one form differ by less [rad]: captured at different times, the solver ends so near.
_ONE_FORM = 1e-3

_MOMENTS = 25


@dataclass(frozen=True, kw_only=True)
class Difference:
    """How two signs differ.

    Attributes:
        first: Gloss of one sign.
        second: Gloss of the other.
        handshape: Largest distance of a finger tip's places in the palm, mean over the sign [m].
        orientation: Angle between the palms, mean over the sign [rad].
        movement: Largest distance of a finger tip's ways, each from its own middle [m].
        place: Distance between the palms' middle places [m]; 0 of letters, which are spelled at any place.
    """

    first: str
    second: str
    handshape: float
    orientation: float
    movement: float
    place: float

    @property
    def seen(self) -> float:
        """The largest of the four, in differences that are just seen: below 1 the signs look alike."""
        lengths = max(self.handshape, self.movement) / SEEN_LENGTH
        return max(lengths, self.orientation / SEEN_ANGLE, self.place / SEEN_PLACE)


def nearest_pairs(robot: Robot, signs: Iterable[Sign], of: Container[str] | None = None) -> list[Difference]:
    """Every pair of signs, the most alike first; two names of one sign are no pair.

    Args:
        robot: That makes them.
        signs: That are compared.
        of: Glosses: each pair has one of them. Without, any pair counts.
    """
    signs = list(signs)
    chosen = signs if of is None else [sign for sign in signs if sign.gloss in of]
    if of is not None:
        signs = chosen + [sign for sign in signs if sign.gloss not in of]
    hands = [_appearances(robot, signs, side) for side in SIDES] if signs else []
    found: list[Difference] = []
    for index, first in enumerate(chosen):
        rows = np.max([_differences(hand, index) for hand in hands], axis=0).tolist()
        for second, (handshape, orientation, movement, place) in zip(signs[index + 1 :], rows, strict=True):
            if not _one_form(first, second):
                spelled = "letter" in (first.kind, second.kind)
                found.append(
                    Difference(
                        first=first.gloss,
                        second=second.gloss,
                        handshape=handshape,
                        orientation=orientation,
                        movement=movement,
                        place=0.0 if spelled else place,
                    )
                )
    return sorted(found, key=lambda difference: difference.seen)


def _one_form(first: Sign, second: Sign) -> bool:
    return first.knots.shape == second.knots.shape and np.allclose(first.knots, second.knots, atol=_ONE_FORM)


class _Appearances(NamedTuple):
    """One hand in each sign; axes of space come before moments, which are summed up faster then."""

    local_tips: Array
    """Finger tips in palm axes [m]. Shape (signs, 3, moments, digits)."""
    palms: Array
    """Orientations of the palm. Shape (signs, 9, moments)."""
    ways: Array
    """Finger tips from their middle over the sign [m]. Shape (signs, 3, moments, digits)."""
    places: Array
    """Middle of the palm's places [m]. Shape (signs, 3)."""


def _appearances(robot: Robot, signs: Sequence[Sign], side: Side) -> _Appearances:
    return _Appearances(*map(np.stack, zip(*(_appearance(robot, sign, side) for sign in signs), strict=True)))


def _appearance(robot: Robot, sign: Sign, side: Side) -> tuple[Array, Array, Array, Array]:
    """The rows of one sign in `_Appearances`."""
    moments = np.linspace(0.0, sign.duration, _MOMENTS)
    positions = np.column_stack([np.interp(moments, sign.times, column) for column in sign.knots.T])
    hand = robot.humanoid.file.hand
    right = (hand.palm, hand.thumb[-1], *(frames[-1] for frames in hand.fingers.values()))
    frames = right if side == "right" else tuple(map(robot.humanoid.mirrored_name, right))
    places = np.array(
        [
            robot.placements(robot.configuration(dict(zip(sign.joints, row.tolist(), strict=True))), frames)
            for row in positions
        ]
    )
    palms, tips = places[:, 0], places[:, 1:, :3, 3]
    local = np.einsum("tij,tki->jtk", palms[:, :3, :3], tips - palms[:, None, :3, 3])
    ways = np.moveaxis(tips - tips.mean(axis=0), 2, 0)
    return local, palms[:, :3, :3].reshape(_MOMENTS, 9).T, ways, palms[:, :3, 3].mean(axis=0)


def _differences(hands: _Appearances, index: int) -> Array:
    """Handshape, orientation, movement and place between a sign and all behind it. Shape (signs, 4)."""
    local, palms, ways, places = (each[index + 1 :] - each[index] for each in hands)
    # Of rotations with a distance d by Frobenius, the angle between them is arccos(1 - d^2 / 4).
    cosines = 1.0 - (palms**2).sum(axis=1) / 4.0
    return np.column_stack(
        [
            np.sqrt((local**2).sum(axis=1).max(axis=2)).mean(axis=1),
            np.arccos(np.clip(cosines, -1.0, 1.0)).mean(axis=1),
            np.sqrt((ways**2).sum(axis=1).max(axis=(1, 2))),
            np.sqrt((places**2).sum(axis=1)),
        ]
    )


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
