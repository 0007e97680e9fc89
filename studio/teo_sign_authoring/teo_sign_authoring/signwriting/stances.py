# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Where a sign's hands are, and what touches what: the head, the trunk, the other hand, or nothing."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from teo_common.arrays import Array
from teo_sign_authoring.notation.score_schema import Part
from teo_sign_authoring.signwriting.beats import Spot, Stance
from teo_sign_authoring.signwriting.hand_symbols import SIDES, Orientation, Side, for_hand, in_space, plane_of
from teo_sign_authoring.signwriting.hands import WrittenHand, WrittenHands
from teo_sign_authoring.signwriting.place import (
    Landmarks,
    air_words,
    from_head,
    is_before_head,
    place_on_head,
    place_on_trunk,
    point_in_air,
    tip_is_nearer,
)
from teo_sign_authoring.signwriting.written_sign import (
    BRUSH,
    CONTACTS,
    CONTACTS_BETWEEN,
    MULTIPLE_CONTACTS,
    RUB,
    Symbol,
    symbols_of,
)

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
        return 2 + self.symbol.fill if self.symbol.base in MULTIPLE_CONTACTS else 1

    @property
    def slides(self) -> bool:
        """Whether the hand brushes or rubs."""
        return self.symbol.base in BRUSH | RUB


def read_contacts(
    symbols: tuple[Symbol, ...], hands: WrittenHands, landmarks: Landmarks
) -> tuple[tuple[Contact, ...], tuple[str, ...]]:
    """The contacts of a sign, and what is said of those that are not understood."""
    found: list[Contact] = []
    losses: list[str] = []
    both = bool(hands.right and hands.left)
    for symbol in symbols_of(symbols, CONTACTS):
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
        if symbol.base in CONTACTS_BETWEEN:
            losses.append(f"{symbol.key}, {symbol.name}: TEO's fingers stay together")
        found.append(Contact(symbol=symbol, side=side, drawing=index, touched=touched))
    return tuple(found), tuple(losses)


def _meeting_part(hand: WrittenHand, towards: Array, point: Array) -> Part:
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


def _towards_body(hand: WrittenHand, point: Array) -> Array:
    """Where the body lies from a hand that touches it, in the axes of the hand's score. Shape (3,).

    Args:
        hand: The hand.
        point: What it touches, on the page [px]. Shape (2,).
    """
    aside = (point - hand.symbol.middle) / 18.0 * np.array([1.0, -1.0])
    way = for_hand(in_space(aside, "wall"), hand.side) + np.array([-1.0, 0.0, 0.0])
    return np.asarray(way / np.linalg.norm(way))


@dataclass(frozen=True, kw_only=True)
class _HandMeeting:
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


def _hand_meeting(right: WrittenHand, left: WrittenHand) -> _HandMeeting:
    """How two hands that touch meet: by how they are drawn beside each other and how they are held."""
    best: tuple[float, _HandMeeting] | None = None
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
        part = _meeting_part(right, towards, left.symbol.middle)
        # Fingers meet with their tips, hands with what they hold towards each other.
        fit = scores[place] + max(float(way @ towards) for way in _ways(right.orientation).values())
        if best is None or fit > best[0] + 0.1:
            best = (fit, _HandMeeting(place=place, part=part, towards=towards))
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


# [cm] A hand that is drawn over the face without a mark of contact is before it.
_BEFORE_FACE = "5 front"
# [cm] Hands that mirror each other and meet: from the middle to each.
_FROM_MIDDLE = 1.0
# Cosine from which on two hands are held as mirrors of each other.
_MIRRORED = 0.9


def read_stances(
    hands: WrittenHands, contacts: tuple[Contact, ...], landmarks: Landmarks, gap: float
) -> tuple[tuple[Stance, ...], tuple[Stance, ...]]:
    """The right and the left hand's stances, one for each drawing.

    Args:
        hands: The hands.
        contacts: What touches what.
        landmarks: What of the body is drawn.
        gap: How far a hand stays off what it touches [cm].
    """

    def read(side: Side) -> tuple[Stance, ...]:
        found = (
            _stance(hand, index, hands, contacts, landmarks) for index, hand in enumerate(hands.of(side))
        )
        return tuple(
            stance
            if stance.towards is None
            else replace(stance, spot=stance.spot.moved(-gap * stance.towards))
            for stance in found
        )

    return read("right"), read("left")


def are_mirrored(hands: WrittenHands) -> bool:
    """Whether both hands have one shape and are held as mirrors of each other throughout."""
    if len(hands.right) != len(hands.left) or not hands.right:
        return False
    return all(
        right.shape == left.shape
        and float(right.orientation.palm @ left.orientation.palm) > _MIRRORED
        and float(right.orientation.fingers @ left.orientation.fingers) > _MIRRORED
        for right, left in zip(hands.right, hands.left, strict=True)
    )


def _stance(
    hand: WrittenHand, index: int, hands: WrittenHands, contacts: tuple[Contact, ...], landmarks: Landmarks
) -> Stance:
    meeting = [contact for contact in contacts if contact.touched == "hand"]
    if meeting and hands.right and hands.left:
        stance = _on_other_hand(hand, index, hands, meeting, landmarks)
        if stance is not None:
            return stance
    own = [
        each
        for each in contacts
        if (each.side, each.drawing) == (hand.side, index) and each.touched != "hand"
    ]
    if own:
        return _on_body(hand, own, landmarks)
    mirror = [
        each
        for each in contacts
        if each.touched != "hand" and each.side != hand.side and each.drawing == index
    ]
    if mirror and are_mirrored(hands) and _drawn_as_mirrors(hands, index):
        return _on_body(hand, mirror, landmarks)
    if landmarks.head is not None and is_before_head(hand, landmarks):
        words = place_on_head(hand, landmarks, None, _BEFORE_FACE)
        return Stance(hand=hand, spot=Spot.read(words), part=_part_at_head(hand, landmarks))
    drawings = hands.of(hand.side)
    touching = {(each.side, each.drawing) for each in contacts}
    together = len(drawings) == 2 and not any(side == hand.side for side, _ in touching)
    # Before and after are drawn beside each other: the sign is made about the middle of the two.
    point = sum(each.symbol.middle for each in drawings) / 2.0 if together else hand.symbol.middle
    spot = _air(np.asarray(point), hand, hands, landmarks)
    return Stance(hand=hand, spot=spot, part="palm", free=together or _is_free(landmarks))


def _is_free(landmarks: Landmarks) -> bool:
    return landmarks.head is None and landmarks.bar is None


def _air(point: Array, hand: WrittenHand, hands: WrittenHands, landmarks: Landmarks) -> Spot:
    alone = not (hands.right and hands.left)
    return Spot.read(air_words(point_in_air(point, hand.side, landmarks, alone)))


def _drawn_as_mirrors(hands: WrittenHands, index: int) -> bool:
    """Whether two drawings are on one level: one mark of contact stands for both."""
    right, left = hands.right[index].symbol.middle, hands.left[index].symbol.middle
    return abs(float(right[1] - left[1])) < 8.0


def _part_at_head(hand: WrittenHand, landmarks: Landmarks) -> Part:
    assert landmarks.head is not None
    return _meeting_part(hand, _towards_body(hand, landmarks.head), landmarks.head)


def _on_body(hand: WrittenHand, contacts: list[Contact], landmarks: Landmarks) -> Stance:
    contact = contacts[0]
    if contact.touched == "head":
        assert landmarks.head is not None
        words, point = place_on_head(hand, landmarks, contact.symbol), landmarks.head
    else:
        words, point = place_on_trunk(hand, landmarks), contact.symbol.middle
    towards = _towards_body(hand, point)
    return Stance(
        hand=hand,
        spot=Spot.read(words),
        part=_meeting_part(hand, towards, point),
        # Off the body is to the front, however the page has it.
        towards=np.array([-1.0, 0.0, 0.0]) if contact.touched == "trunk" else towards,
        times=max(len(contacts), *(each.times for each in contacts)),
        slides=any(each.slides for each in contacts),
    )


def _on_other_hand(
    hand: WrittenHand, index: int, hands: WrittenHands, contacts: list[Contact], landmarks: Landmarks
) -> Stance | None:
    """A hand of two that meet; None if this drawing of it does not."""
    other = hands.of("left" if hand.side == "right" else "right")
    partner = other[min(index, len(other) - 1)]
    middle = (hand.symbol.middle + partner.symbol.middle) / 2.0
    touching = [
        each for each in contacts if each.drawing == min(index, len(hands.right) - 1) or len(hands.right) == 1
    ]
    alone_mirrored = are_mirrored(hands) and _drawn_as_mirrors(hands, index)
    if not touching:
        return None
    centre = point_in_air(middle, hand.side, landmarks, alone=False)
    times = max(len(touching), *(each.times for each in touching))
    slides = any(each.slides for each in touching)
    if alone_mirrored:
        spot = Spot.read(air_words(np.array([centre[0], -0.01 * _FROM_MIDDLE, centre[2]])))
        towards = np.array([0.0, 1.0, 0.0])
        part = _meeting_part(hand, towards, partner.symbol.middle)
        return Stance(hand=hand, spot=spot, part=part, towards=towards, times=times, slides=slides)
    if hand.side == "left":
        return Stance(hand=hand, spot=Spot.read(air_words(centre)), part="palm")
    met = _hand_meeting(hand, partner)
    return Stance(
        hand=hand,
        spot=Spot(name=met.place, offset=np.zeros(3)),
        part=met.part,
        towards=met.towards,
        times=times,
        slides=slides,
    )
