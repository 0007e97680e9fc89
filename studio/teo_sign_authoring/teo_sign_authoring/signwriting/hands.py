# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which hand symbol is which hand, and which is first where a hand is drawn twice."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from teo_common.arrays import Array
from teo_sign_authoring.signwriting.hand_symbols import (
    EDGE_SHOWN,
    Orientation,
    Side,
    handshape_of,
    orientation_of,
    written_side,
)
from teo_sign_authoring.signwriting.movement import Closing, Movement, Path
from teo_sign_authoring.signwriting.written_sign import Symbol, UnreadableError, looks_like_other_side

# [px] Hands that are drawn alike on one level, at least a hand's width apart, are two.
_LEVEL, _APART = 8.0, 12.0
# [px] Drawings nearer than this touch: the shortest arrow is longer.
_TOUCHING = 6.0
_SIDES: tuple[tuple[Side, Side], ...] = (("right", "left"), ("left", "right"))
# Cosine between an arrow and the way from one drawing of a hand to the other that tells which is first.
_ALONG = 0.5


@dataclass(frozen=True, kw_only=True)
class WrittenHand:
    """A hand at one moment: its symbol, the project's handshape, and how it is held."""

    symbol: Symbol
    side: Side
    shape: str
    orientation: Orientation


@dataclass(frozen=True, kw_only=True)
class WrittenHands:
    """The hands of a sign: for each side none, one, or the hand before and after its movement."""

    right: tuple[WrittenHand, ...]
    left: tuple[WrittenHand, ...]

    def of(self, side: Side) -> tuple[WrittenHand, ...]:
        """The drawings of one hand, in order of time."""
        return self.right if side == "right" else self.left


def read_hands(symbols: tuple[Symbol, ...], movements: tuple[Movement, ...]) -> WrittenHands:
    """The hands of a sign.

    A sign that is made with the left hand alone is read as the right hand's, mirrored, by `compiler`.

    Raises:
        UnreadableError: "handshape", "no_hand", "too_many_hands", "order".
    """
    for symbol in symbols:
        if handshape_of(symbol.base) is None:
            raise UnreadableError("handshape", f"{symbol.key}, {symbol.name}: TEO has no such hand")
    if not symbols:
        raise UnreadableError("no_hand", "expected a hand, got a sign without any")
    by_side: dict[Side, list[Symbol]] = {"right": [], "left": []}
    for symbol in symbols:
        by_side[written_side(symbol)].append(symbol)
    for side, other in _SIDES:
        if not by_side[other] and len(by_side[side]) == 2:
            by_side[side], by_side[other] = _two_of_one_side(by_side[side], side, movements)
    if len(by_side["right"]) == len(by_side["left"]):
        _exchange_sides(by_side)
    elif len(symbols) == 1:
        by_side = _side_of_arrows(symbols[0], movements) or _comfortable_side(symbols[0])
    return WrittenHands(
        right=_in_order(by_side["right"], "right", movements),
        left=_in_order(by_side["left"], "left", movements),
    )


def _are_aslant_mirrors(first: Symbol, second: Symbol) -> bool:
    """Whether one drawing is turned as far to the left as the other to the right."""
    return (first.rotation + second.rotation) % 8 == 0 and first.rotation % 4 != 0


def _can_be_either(symbol: Symbol) -> bool:
    """Whether a drawing may be either hand: one seen on its edge, or one that looks the same mirrored."""
    return symbol.fill in EDGE_SHOWN or looks_like_other_side(symbol)


def _exchange_sides(by_side: dict[Side, list[Symbol]]) -> None:
    """Give drawings to the other hand where they stand on its side of the page.

    A right hand whose palm faces out is drawn as a left hand whose palm faces in.
    """
    for index, (right, left) in enumerate(zip(by_side["right"], by_side["left"], strict=True)):
        crossed = float(left.middle[0] - right.middle[0]) >= _APART
        if crossed and _can_be_either(right) and _can_be_either(left):
            by_side["right"][index], by_side["left"][index] = left, right


def _side_of_arrows(symbol: Symbol, movements: tuple[Movement, ...]) -> dict[Side, list[Symbol]] | None:
    """The hand that the heads of all arrows say moves; None if they say none, or both."""
    told = {movement.hands for movement in movements if not _is_of_fingers(movement)}
    for side, other in _SIDES:
        if told == {side}:
            return {side: [symbol], other: []}
    return None


def _comfortable_side(symbol: Symbol) -> dict[Side, list[Symbol]]:
    """The hand that a lone drawing is more easily made with."""
    written = written_side(symbol)
    if written == "left" and _can_be_either(symbol) and _strain(symbol, "right") < _strain(symbol, "left"):
        written = "right"
    elif (
        written == "right"
        and _can_be_either(symbol)
        and _strain(symbol, "left") < _strain(symbol, "right") - 1.0
    ):
        written = "left"
    return {"right": [symbol] if written == "right" else [], "left": [symbol] if written == "left" else []}


def _strain(symbol: Symbol, side: Side) -> float:
    """How far a hand is from how arms hold it easily: fingers not out or back, thumb not below."""
    held = orientation_of(symbol, side)
    back, out = max(0.0, -float(held.fingers[0])), max(0.0, -float(held.fingers[1]))
    return back + out + max(0.0, -float(held.thumb_side[2]))


def _two_of_one_side(
    pair: list[Symbol], side: Side, movements: tuple[Movement, ...]
) -> tuple[list[Symbol], list[Symbol]]:
    """Two drawings that are both written as one side: that hand before and after, or both hands."""
    leftmost, rightmost = sorted(pair, key=lambda symbol: float(symbol.middle[0]))
    own, other = (rightmost, leftmost) if side == "right" else (leftmost, rightmost)
    if _are_two(pair, movements):
        return [own], [other]
    if looks_like_other_side(other) and _leave_no_room_for_an_arrow(pair, movements):
        return [own], [other]
    try:
        _comes_later(pair[0], pair[1], side, movements)
    except UnreadableError:
        first, second = pair
        if (first.base, first.fill) == (second.base, second.fill) and _are_aslant_mirrors(first, second):
            return [own], [other]
        # A flat hand that shows palm or back is drawn alike as either hand: then it is the other one.
        for symbol in (other, own):
            if looks_like_other_side(symbol):
                return [each for each in pair if each is not symbol], [symbol]
        raise
    return pair, []


def _are_two(pair: list[Symbol], movements: tuple[Movement, ...]) -> bool:
    """Whether two drawings of one side are both hands: arrows for both, or alike beside each other."""
    if {movement.hands for movement in movements if not _is_of_fingers(movement)} & {"both"}:
        return True
    told = {movement.hands for movement in movements if not _is_of_fingers(movement)}
    if {"right", "left"} <= told:
        return True
    first, second = pair
    apart = np.abs(first.middle - second.middle)
    alike = first.base == second.base
    return bool(
        alike and apart[1] <= _LEVEL and apart[0] >= _APART and not _arrow_along(first, second, movements)
    )


def _leave_no_room_for_an_arrow(pair: list[Symbol], movements: tuple[Movement, ...]) -> bool:
    """Whether drawings touch and no finger opens or closes: a hand before and after has its way between."""
    first, second = pair
    gap = np.abs(first.middle - second.middle) - (first.size + second.size) / 2.0
    return bool(gap.max() <= _TOUCHING) and not any(map(_is_of_fingers, movements))


def _is_of_fingers(movement: Movement) -> bool:
    return isinstance(movement.kind, Closing)


def _in_order(symbols: list[Symbol], side: Side, movements: tuple[Movement, ...]) -> tuple[WrittenHand, ...]:
    if len(symbols) > 2:
        raise UnreadableError(
            "too_many_hands", f"{len(symbols)} drawings of the {side} hand: expected at most two"
        )
    if len(symbols) == 2 and _comes_later(symbols[0], symbols[1], side, movements):
        symbols = [symbols[1], symbols[0]]
    return tuple(_hand(symbol, side) for symbol in symbols)


def _hand(symbol: Symbol, side: Side) -> WrittenHand:
    shape = handshape_of(symbol.base)
    assert shape is not None
    return WrittenHand(symbol=symbol, side=side, shape=shape.name, orientation=orientation_of(symbol, side))


def _comes_later(first: Symbol, second: Symbol, side: Side, movements: tuple[Movement, ...]) -> bool:
    """Whether of two drawings of a hand the first is the later one.

    Raises:
        UnreadableError: "order" if neither an arrow nor opening or closing fingers tell.
    """
    own = tuple(movement for movement in movements if movement.hands in (side, "both"))
    along = _arrow_along(first, second, own)
    if along:
        return along < 0
    for movement in own:
        if isinstance(movement.kind, Closing):
            open_first = _openness(first.base) > _openness(second.base)
            return open_first if movement.kind.opens else not open_first
    raise UnreadableError("order", f"{first.key} and {second.key}: nothing says which is first")


def _openness(base: int) -> int:
    """How many fingers are stretched, roughly, of a hand."""
    shape = handshape_of(base)
    stretched = {
        "open": 5,
        "flat": 5,
        "relaxed": 5,
        "four": 4,
        "bent": 3,
        "three": 3,
        "l": 2,
        "two": 2,
        "cupped": 3,
    }
    return 0 if shape is None else stretched.get(shape.name, 1)


def _arrow_along(first: Symbol, second: Symbol, movements: tuple[Movement, ...]) -> float:
    """Whether arrows lead from one drawing to the other: 1, back: -1, or do neither: 0."""
    between = second.middle - first.middle
    for movement in movements:
        if isinstance(movement.kind, Path):
            way = _page_way(movement.kind)
            size = float(np.linalg.norm(between) * np.linalg.norm(way))
            cosine = float(between @ way) / size if size > 1e-9 else 0.0
            if abs(cosine) >= _ALONG:
                return float(np.sign(cosine))
    return 0.0


def _page_way(path: Path) -> Array:
    """A way as the page shows it, right and down; to the front is up. Shape (2,)."""
    front, left, up = path.way.tolist()
    return np.array([-left, -up if abs(up) > 1e-6 else -front])
