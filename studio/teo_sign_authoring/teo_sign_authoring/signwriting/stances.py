# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Where the drawings of a sign's hands are: on the head, on the trunk, on the other hand or in the air."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from teo_common.arrays import Array
from teo_sign_authoring.notation.score_schema import Part
from teo_sign_authoring.signwriting.beats import Spot, Stance
from teo_sign_authoring.signwriting.contact import Contact, hand_meeting, meeting_part, towards_body
from teo_sign_authoring.signwriting.hands import WrittenHand, WrittenHands
from teo_sign_authoring.signwriting.page import Side
from teo_sign_authoring.signwriting.place import (
    Landmarks,
    air_words,
    is_before_head,
    place_on_head,
    place_on_trunk,
    point_in_air,
)

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
    return meeting_part(hand, towards_body(hand, landmarks.head), landmarks.head)


def _on_body(hand: WrittenHand, contacts: list[Contact], landmarks: Landmarks) -> Stance:
    contact = contacts[0]
    if contact.touched == "head":
        assert landmarks.head is not None
        words, point = place_on_head(hand, landmarks, contact.symbol), landmarks.head
    else:
        words, point = place_on_trunk(hand, landmarks), contact.symbol.middle
    towards = towards_body(hand, point)
    return Stance(
        hand=hand,
        spot=Spot.read(words),
        part=meeting_part(hand, towards, point),
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
        part = meeting_part(hand, towards, partner.symbol.middle)
        return Stance(hand=hand, spot=spot, part=part, towards=towards, times=times, slides=slides)
    if hand.side == "left":
        return Stance(hand=hand, spot=Spot.read(air_words(centre)), part="palm")
    met = hand_meeting(hand, partner)
    return Stance(
        hand=hand,
        spot=Spot(name=met.place, offset=np.zeros(3)),
        part=met.part,
        towards=met.towards,
        times=times,
        slides=slides,
    )
