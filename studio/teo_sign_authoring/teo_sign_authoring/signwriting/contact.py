# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Contact symbols: what touches what, with which part of the hand."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from teo_common.arrays import Array
from teo_sign_authoring.notation.score_schema import Part
from teo_sign_authoring.signwriting import symbol_groups as groups
from teo_sign_authoring.signwriting.hands import WrittenHand, WrittenHands
from teo_sign_authoring.signwriting.page import SIDES, Orientation, Side, for_hand, in_space, plane_of
from teo_sign_authoring.signwriting.place import Landmarks, from_head, tip_is_nearer
from teo_sign_authoring.signwriting.written_sign import Symbol

Touched = Literal["head", "trunk", "hand"]

# [px] A mark stands at most so far from what touches: its own width.
_NEAR = 14.0
# [px] Hands whose middles are nearer are drawn over each other.
_OVER = 10.0
# How much likelier a hand meets something with the fingertips if they are drawn nearer to it.
_TIPS = 0.6


@dataclass(frozen=True, kw_only=True)
class Contact:
    """A contact of the sign.

    Attributes:
        symbol: Its symbol.
        side: The hand that touches; of two hands that meet, the right one.
        drawing: Which drawing of that hand.
        touched: What is touched.
    """

    symbol: Symbol
    side: Side
    drawing: int
    touched: Touched

    @property
    def times(self) -> int:
        """How often."""
        return 2 + self.symbol.fill if self.symbol.base in groups.MULTIPLE_CONTACTS else 1

    @property
    def slides(self) -> bool:
        """Whether the hand brushes or rubs."""
        return self.symbol.base in groups.BRUSH | groups.RUB


def read_contacts(
    symbols: tuple[Symbol, ...], hands: WrittenHands, landmarks: Landmarks
) -> tuple[tuple[Contact, ...], tuple[str, ...]]:
    """The contacts of a sign, and what is said of those that are not understood."""
    found: list[Contact] = []
    losses: list[str] = []
    both = bool(hands.right and hands.left)
    for symbol in groups.of(symbols, groups.CONTACTS):
        near = sorted(
            (hand.symbol.distance(symbol.middle), side, index, hand)
            for side in SIDES
            for index, hand in enumerate(hands.of(side))
        )
        distance, side, index, _ = near[0]
        others = [each for each in near if each[1] != side]
        at_head = from_head(symbol, landmarks)
        at_other = others[0][0] if others else float("inf")
        touched: Touched | None = None
        if at_head <= _NEAR and at_head <= at_other:
            touched = "head"
        elif both and at_other <= _NEAR and distance <= _NEAR:
            touched = "hand"
        elif landmarks.bar is None and from_head(near[0][3].symbol, landmarks) <= 0.0:
            touched = "head"  # the hand is drawn against it, the mark on the hand's far side
        elif landmarks.bar is not None or (landmarks.head is not None and at_head > _NEAR and not both):
            touched = "trunk"
        elif both:
            touched = "hand"
        if touched is None:
            losses.append(f"{symbol.key}, {symbol.name}: a contact with nothing that is drawn")
            continue
        if touched == "hand" and side == "left":
            side, index = "right", min(index, len(hands.right) - 1)
        if symbol.base in groups.CONTACTS_BETWEEN:
            losses.append(f"{symbol.key}, {symbol.name}: TEO's fingers stay together")
        found.append(Contact(symbol=symbol, side=side, drawing=index, touched=touched))
    return tuple(found), tuple(losses)


def meeting_part(hand: WrittenHand, towards: Array, point: Array) -> Part:
    """The part of a hand that meets what lies that way.

    Args:
        hand: The hand.
        towards: Where what it meets lies, in the axes of the hand's score. Shape (3,).
        point: Where that is on the page [px]. Shape (2,).
    """
    ways = _ways(hand.orientation)
    score = {part: float(way @ towards) for part, way in ways.items()}
    if tip_is_nearer(hand, point):
        score["fingertips"] += _TIPS
    best = max(score, key=lambda part: score[part])
    if best == "fingertips" and hand.shape in ("index", "hook", "pinch"):
        return "index"
    if best == "index_side" and hand.shape in ("thumb", "thumb_little"):
        return "thumb"
    return best


def _ways(orientation: Orientation) -> dict[Part, Array]:
    return {
        "palm": orientation.palm,
        "fingertips": orientation.fingers,
        "index_side": orientation.thumb_side,
        "little_side": -orientation.thumb_side,
        "back": -orientation.palm,
    }


def towards_body(hand: WrittenHand, point: Array) -> Array:
    """Where the body lies from a hand that touches it, in the axes of the hand's score. Shape (3,).

    Args:
        hand: The hand.
        point: What it touches, on the page [px]. Shape (2,).
    """
    aside = (point - hand.symbol.middle) / 18.0 * np.array([1.0, -1.0])
    way = for_hand(in_space(aside, "wall"), hand.side) + np.array([-1.0, 0.0, 0.0])
    return np.asarray(way / np.linalg.norm(way))


@dataclass(frozen=True, kw_only=True)
class HandMeeting:
    """How the right hand is on the left one.

    Attributes:
        place: Place on the left hand.
        part: Part of the right hand.
        towards: Where the left hand lies from the right one, in the axes of the right hand's score. Shape
            (3,).
    """

    place: str
    part: Part
    towards: Array


def hand_meeting(right: WrittenHand, left: WrittenHand) -> HandMeeting:
    """How two hands that touch meet: by how they are drawn beside each other and how they are held."""
    best: tuple[float, HandMeeting] | None = None
    for from_left in _ways_between(right, left):
        on_left = for_hand(from_left, "left")
        places = {
            "other_palm": left.orientation.palm,
            "other_back": -left.orientation.palm,
            "other_fingertips": left.orientation.fingers,
            "other_index_side": left.orientation.thumb_side,
            "other_wrist": -left.orientation.fingers,
        }
        scores = {place: float(way @ on_left) for place, way in places.items()}
        place = max(scores, key=lambda name: scores[name])
        towards = -from_left
        part = meeting_part(right, towards, left.symbol.middle)
        # Fingers meet with their tips, hands with what they hold towards each other.
        fit = scores[place] + max(float(way @ towards) for way in _ways(right.orientation).values())
        if best is None or fit > best[0] + 0.1:
            best = (fit, HandMeeting(place=place, part=part, towards=towards))
    assert best is not None
    return best[1]


def _ways_between(right: WrittenHand, left: WrittenHand) -> list[Array]:
    """Ways from the left hand to the right one that the page allows: front, left, up, unit vectors."""
    between = (right.symbol.middle - left.symbol.middle) * np.array([1.0, -1.0])
    distance = float(np.linalg.norm(between))
    floor = "floor" in (plane_of(right.symbol), plane_of(left.symbol))
    if distance < _OVER:
        # Drawn over each other: the right one is nearer to who looks, from above or from behind.
        return (
            [np.array([0.0, 0.0, 1.0])] if floor else [np.array([-1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0])]
        )
    ways = [in_space(between / distance, "wall")]
    if floor:
        ways.append(in_space(between / distance, "floor"))
    return ways
