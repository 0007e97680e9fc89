# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Where a hand is: from its place on the page to a place of articulation.

The head is a circle of 36 px, the shoulders a bar of 42 px. A hand that touches the head is at the part of
the face that is nearest on the page; one that touches the body below is on the chest. Hands that touch
nothing are in the air, as far from head, bar or the middle of the page as they are drawn.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from teo_common.arrays import Array
from teo_sign_authoring.signwriting.hand_symbols import CM_PER_PIXEL, Side, displacement_words, drawn_tip
from teo_sign_authoring.signwriting.hands import WrittenHand
from teo_sign_authoring.signwriting.written_sign import (
    EARS,
    HEAD_RIM,
    HEADS,
    MOUTH,
    NOSE,
    SHOULDERS,
    Symbol,
    symbols_of,
)
from teo_sign_capture.signing_space import written_place

_HEAD_RADIUS = 18.0  # [px]
_PAGE_MIDDLE = np.array([500.0, 500.0])
# [px] From the shoulders' bar down: what is written on the chest, and below it on the belly.
_CHEST_BELOW, _BELLY_BELOW = 16.0, 52.0
# [px] Aside on the trunk: beyond the first beside the middle, beyond the second at the shoulder.
_ASIDE, _AT_SHOULDER = 7.0, 15.0
# [px] A box that is so near to the head's circle overlaps it or is drawn against it.
_BEFORE_HEAD = 6.0


@dataclass(frozen=True, kw_only=True)
class Landmarks:
    """What of the body is drawn.

    Attributes:
        head: Middle of the head, right and down [px]; None if there is none. Shape (2,).
        bar: Middle of the shoulders' bar [px]; None if there is none. Shape (2,).
        nose: Whether the nose is marked.
        ears: Whether ears are.
        mouth: Whether the mouth is.
        rim: Rotation of a mark on the head's rim; None if there is none.
    """

    head: Array | None
    bar: Array | None
    nose: bool
    ears: bool
    mouth: bool
    rim: int | None


def read_landmarks(symbols: tuple[Symbol, ...]) -> Landmarks:
    """What of the body a sign shows."""
    heads = [symbol for symbol in symbols_of(symbols, HEADS) if symbol.size.min() >= 2.0 * _HEAD_RADIUS - 4.0]
    bars = symbols_of(symbols, SHOULDERS)
    rims = [symbol.rotation for symbol in symbols if symbol.base == HEAD_RIM]
    bases = {symbol.base for symbol in symbols}
    return Landmarks(
        head=_head_middle(heads[0]) if heads else None,
        bar=bars[0].corner + np.array([bars[0].size[0] / 2.0, 2.0]) if bars else None,
        nose=bool(bases & NOSE),
        ears=EARS in bases,
        mouth=bool(bases & MOUTH),
        rim=rims[0] if rims else None,
    )


def _head_middle(symbol: Symbol) -> Array:
    """Middle of the circle; arrows of head movements stand above it."""
    return np.asarray(symbol.corner + np.array([symbol.size[0] / 2.0, symbol.size[1] - _HEAD_RADIUS]))


def from_head(symbol: Symbol, landmarks: Landmarks) -> float:
    """From a symbol's box to the rim of the head [px]; negative inside, infinite without a head."""
    if landmarks.head is None:
        return float("inf")
    return symbol.distance(landmarks.head) - _HEAD_RADIUS


def is_before_head(hand: WrittenHand, landmarks: Landmarks) -> bool:
    """Whether a hand is drawn over the head, or against it."""
    return from_head(hand.symbol, landmarks) < -_BEFORE_HEAD


# Where TEO's places are beside the middle, for the mirror [cm].
def _across(name: str) -> float:
    return 200.0 * -float(written_place(name).point[1])


def _sided(name: str, out: float, off: str) -> str:
    """A place on the hand's own side, or across the middle where the hand is drawn there."""
    words = [name]
    across = _across(name)
    if out < 0.0 and across >= 1.0:
        words.append(f"{round(across)} in")
    return " ".join(filter(None, (*words, off)))


def place_on_head(hand: WrittenHand, landmarks: Landmarks, contact: Symbol | None, off: str = "") -> str:
    """The part of the head that a hand is at.

    Args:
        hand: The hand.
        landmarks: With a head.
        contact: The symbol of the contact, if there is one.
        off: Displacement from there, in words.
    """
    assert landmarks.head is not None
    # A hand is drawn beside its place, or over it so that the face stays to be seen.
    point = (hand.symbol.nearest(landmarks.head) + hand.symbol.middle) / 2.0
    if contact is not None and from_head(contact, landmarks) <= _HEAD_RADIUS:
        # The mark stands beside the place: where hand and mark meet.
        point = (contact.middle + hand.symbol.nearest(contact.middle)) / 2.0
    offset = (point - landmarks.head) / _HEAD_RADIUS
    if landmarks.rim is not None and contact is not None:
        angle = landmarks.rim % 8 * np.pi / 4.0
        offset = np.array([-np.sin(angle), -np.cos(angle)])
    offset = offset / max(1.0, float(np.linalg.norm(offset)))
    out = float(offset[0]) * (1.0 if hand.side == "right" else -1.0)
    down, aside = float(offset[1]), abs(float(offset[0]))
    if landmarks.nose and contact is not None and aside < 0.7:
        return " ".join(filter(None, ("nose", off)))
    if landmarks.ears and contact is not None and aside > 0.5:
        return _sided("ear", out, off)
    if down < -0.93:
        return " ".join(filter(None, ("head_top", off)))
    if down < -0.4:
        return _sided("temple" if aside > 0.55 else "forehead", out, off)
    if down < -0.1:
        return _sided("temple" if aside > 0.75 else "eye", out, off)
    if down < 0.3:
        # Ears have a symbol of their own: without it, what is drawn at the side is the cheek.
        return _sided("cheek" if aside > 0.35 else "nose", out, off)
    if down < 0.78:
        return _sided("cheek" if aside > 0.6 else "mouth_corner" if aside > 0.3 else "mouth", out, off)
    return " ".join(filter(None, ("chin", off)))


def place_on_trunk(hand: WrittenHand, landmarks: Landmarks, off: str = "") -> str:
    """The part of the trunk that a hand is at."""
    sign = 1.0 if hand.side == "right" else -1.0
    middle = landmarks.bar if landmarks.bar is not None else landmarks.head
    out = 0.0 if middle is None else sign * float(hand.symbol.middle[0] - middle[0])
    if landmarks.bar is None:
        name = "upper_chest"
    else:
        point = hand.symbol.nearest(landmarks.bar)
        down = float((point[1] + hand.symbol.middle[1]) / 2.0 - landmarks.bar[1])
        if down < _CHEST_BELOW and out > _AT_SHOULDER:
            name = "shoulder"
        elif down < _CHEST_BELOW and out < -_AT_SHOULDER:
            name = "other_shoulder"
        elif down < -_CHEST_BELOW:
            name = "throat"
        elif down > _BELLY_BELOW:
            name = "belly"
        elif out < -_ASIDE:
            name = "other_chest"
        else:
            name = "upper_chest" if down < _CHEST_BELOW else "chest"
    if name in ("upper_chest", "chest", "belly") and out > _ASIDE:
        off = f"{off} 8 out".strip()
    return f"{name} {off}".strip()


# In the air [m]: how far before the body a hand signs at the face, beside it, lower down.
_BEFORE_FACE, _BESIDE_FACE, _BEFORE_CHEST = 0.24, 0.20, 0.34
_HEAD_HEIGHT, _SHOULDER_HEIGHT, _CHEST_HEIGHT = 0.705, 0.53, 0.43
# [m] TEO's hands work no lower than its belly.
_LOWEST = 0.28
# [m] One hand alone signs before its own side of the chest.
_OWN_SIDE = 0.10


def point_in_air(point: Array, side: Side, landmarks: Landmarks, alone: bool) -> Array:
    """Where a hand is that touches nothing, in the axes of its score: front, in, up [m]. Shape (3,).

    Args:
        point: Its middle on the page, right and down [px]. Shape (2,).
        side: Which hand.
        landmarks: What of the body is drawn.
        alone: Whether the sign has no other hand.
    """
    sign = 1.0 if side == "right" else -1.0
    scale = 0.01 * CM_PER_PIXEL
    if landmarks.head is not None:
        offset = point - landmarks.head
        height = _HEAD_HEIGHT - scale * float(offset[1])
        out = sign * scale * float(offset[0])
        if offset[1] < 1.3 * _HEAD_RADIUS:
            front = _BEFORE_FACE if abs(offset[0]) < _HEAD_RADIUS else _BESIDE_FACE
        else:
            front = _BEFORE_CHEST
    elif landmarks.bar is not None:
        offset = point - landmarks.bar
        height, out, front = (
            _SHOULDER_HEIGHT - scale * float(offset[1]),
            sign * scale * float(offset[0]),
            _BEFORE_CHEST,
        )
    else:
        offset = point - _PAGE_MIDDLE
        front, height = _BEFORE_CHEST, _CHEST_HEIGHT - scale * float(offset[1])
        out = _OWN_SIDE if alone else sign * scale * float(offset[0])
    return np.array([front, -out, max(height, _LOWEST)])


_AIR = ("space", "low_space", "middle_space", "shoulder_space", "high_space", "face_space", "beside_head")


def air_words(point: Array) -> str:
    """The place in the air that is nearest to a point, and how far it is from there.

    Args:
        point: In the axes of a hand's score [m]. Shape (3,).
    """
    name = min(_AIR, key=lambda each: float(np.linalg.norm(written_place(each).point - point)))
    return f"{name} {displacement_words(100.0 * (point - written_place(name).point))}".strip()


def tip_is_nearer(hand: WrittenHand, point: Array) -> bool:
    """Whether the fingertips of a drawn hand are nearer to a point than its middle."""
    tip = drawn_tip(hand.symbol)
    return bool(np.linalg.norm(tip - point) < np.linalg.norm(hand.symbol.middle - point) - 1.0)
