# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Movement symbols of ISWA 2010: what moves, along which way, how often.

Arrows with a black head are the right hand's (fill 0), with a white head the left one's (1), with an open
head both hands' (2). Way and bulge of each symbol are written down as drawn with rotation 0; size is that
of the symbol, on the scale of the head.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from teo_common.arrays import Array
from teo_sign_authoring.signwriting.hand_symbols import CM_PER_PIXEL, Plane, in_space, turned
from teo_sign_authoring.signwriting.written_sign import Symbol, symbol_size

Hands = Literal["right", "left", "both"]
Joint = Literal["fingers", "wrist", "forearm"]


@dataclass(frozen=True, kw_only=True)
class Segment:
    """A part of a way: straight, or an arc.

    Attributes:
        way: From its beginning to its end: front, left, up [cm]. Shape (3,).
        bulge: How far its middle swings out [cm]. Shape (3,).
    """

    way: Array
    bulge: Array


@dataclass(frozen=True, kw_only=True)
class Path:
    """A way of the hand.

    Attributes:
        segments: One after the other.
        times: How often it is made, from the same beginning.
        to_and_fro: Whether every other time is the way back.
        bent_wrist: Whether the wrist makes it, not the arm.
    """

    segments: tuple[Segment, ...]
    times: int = 1
    to_and_fro: bool = False
    bent_wrist: bool = False

    @property
    def way(self) -> Array:
        """From beginning to end of once [cm]. Shape (3,)."""
        return np.asarray(sum(segment.way for segment in self.segments))


@dataclass(frozen=True, kw_only=True)
class Circling:
    """Circles about a point.

    Attributes:
        first: From the middle to where it begins, times the radius: front, left, up [cm]. Shape (3,).
        then: Where it goes first, at right angles, as long. Shape (3,).
        turns: How often round.
    """

    first: Array
    then: Array
    turns: float


@dataclass(frozen=True, kw_only=True)
class Swinging:
    """A joint that goes to and fro."""

    joint: Joint
    times: int


@dataclass(frozen=True, kw_only=True)
class Turning:
    """The forearm turns once; how far, the hands that are drawn must say."""


@dataclass(frozen=True, kw_only=True)
class Closing:
    """The hand closes (or opens) so often."""

    opens: bool
    times: int


Kind = Path | Circling | Swinging | Turning | Closing


@dataclass(frozen=True, kw_only=True)
class Movement:
    """What a movement symbol says: the movement, and whose it is."""

    symbol: Symbol
    hands: Hands
    kind: Kind


_HEADS: dict[int, Hands] = {0: "right", 1: "left", 2: "both"}

_UP, _LEFT, _NONE = (0.0, 1.0), (-1.0, 0.0), (0.0, 0.0)
_Drawn = tuple[tuple[tuple[float, float], tuple[float, float]], ...]
_STRAIGHT: _Drawn = ((_UP, _NONE),)
# An arc of 90 deg swings out by a fifth of its chord, one of 180 deg by half of it.
_QUARTER, _HALF = 0.207, 0.5
_QUARTER_UP: _Drawn = ((_UP, (_QUARTER, 0.0)),)
_HALF_UP: _Drawn = ((_UP, (_HALF, 0.0)),)


def _line(*points: tuple[float, float]) -> _Drawn:
    """Straight from point to point."""
    return tuple(
        ((after[0] - before[0], after[1] - before[1]), _NONE) for before, after in itertools.pairwise(points)
    )


def _arcs(count: int, way: tuple[float, float], *, alternate: bool = False) -> _Drawn:
    """Arcs in a row; the last swings out to the right of a way up, the others too or in turn."""
    part = (way[0] / count, way[1] / count)
    aside = (_HALF * part[1], -_HALF * part[0])
    signs = [-1.0 if alternate and (count - index) % 2 == 0 else 1.0 for index in range(count)]
    return tuple((part, (sign * aside[0], sign * aside[1])) for sign in signs)


_CORNER = _line((0.7, 0.0), (0.0, 0.0), (0.0, 1.0))
_CHECK = _line((0.6, 0.7), (0.0, 0.0), (0.0, 1.0))
_BOX = _line((1.0, 1.0), (1.0, 0.0), (0.0, 0.0), (0.0, 1.0))
_ZIGZAG = _line((0.4, 0.0), (0.4, 1.0), (0.0, 0.0), (0.0, 1.0))
_PEAKS = _line((0.0, 0.0), (0.3, 0.25), (0.0, 0.5), (0.3, 0.75), (0.0, 1.0))


@dataclass(frozen=True, kw_only=True)
class _Arrow:
    """How bases of one kind are drawn with rotation 0, one high."""

    drawn: _Drawn
    plane: Plane
    times: int = 1
    to_and_fro: bool = False
    bent_wrist: bool = False
    wide: bool = False  # the way is along the width of the symbol


def _arrows() -> dict[int, _Arrow]:
    table: dict[int, _Arrow] = {}

    def put(bases: range, arrow: _Arrow) -> None:
        table.update(dict.fromkeys(bases, arrow))

    straight_ones: tuple[tuple[Plane, int], ...] = (("wall", 0x22A), ("floor", 0x265))
    for plane, first in straight_ones:
        straight = _Arrow(drawn=_STRAIGHT, plane=plane)
        wrist = replace(straight, bent_wrist=True)
        put(range(first, first + 4), straight)
        put(range(first + 4, first + 5), wrist)
        for offset, times, to_and_fro in ((5, 2, False), (7, 2, True), (10, 3, False), (12, 3, True)):
            put(
                range(first + offset, first + offset + 1),
                replace(straight, times=times, to_and_fro=to_and_fro),
            )
            bent = replace(wrist, times=times, to_and_fro=to_and_fro)
            put(range(first + offset + 1, first + offset + 2), bent)
    put(range(0x23B, 0x23E), _Arrow(drawn=_CORNER, plane="wall"))
    put(range(0x274, 0x277), _Arrow(drawn=_CORNER, plane="floor"))
    put(range(0x23F, 0x242), _Arrow(drawn=_CHECK, plane="wall"))
    put(range(0x277, 0x278), _Arrow(drawn=_CHECK, plane="floor"))
    put(range(0x242, 0x245), _Arrow(drawn=_BOX, plane="wall"))
    put(range(0x278, 0x27B), _Arrow(drawn=_BOX, plane="floor"))
    put(range(0x245, 0x248), _Arrow(drawn=_ZIGZAG, plane="wall"))
    put(range(0x27B, 0x27E), _Arrow(drawn=_ZIGZAG, plane="floor"))
    put(range(0x248, 0x24B), _Arrow(drawn=_PEAKS, plane="wall"))
    put(range(0x27E, 0x281), _Arrow(drawn=_PEAKS, plane="floor"))
    put(range(0x288, 0x28C), _Arrow(drawn=_QUARTER_UP, plane="wall"))
    put(range(0x28C, 0x290), _Arrow(drawn=_HALF_UP, plane="wall"))
    put(range(0x292, 0x295), _Arrow(drawn=_arcs(3, _UP), plane="wall"))
    put(range(0x299, 0x29C), _Arrow(drawn=_arcs(2, _UP, alternate=True), plane="wall"))
    put(range(0x29C, 0x29F), _Arrow(drawn=_arcs(3, _UP, alternate=True), plane="wall"))
    put(range(0x2D5, 0x2D9), _Arrow(drawn=((_LEFT, (0.0, 0.35)),), plane="floor", wide=True))
    put(range(0x2DA, 0x2DB), _Arrow(drawn=_arcs(2, _LEFT), plane="floor", wide=True))
    put(range(0x2DC, 0x2DF), _Arrow(drawn=_arcs(3, _LEFT, alternate=True), plane="floor", wide=True))
    return table


_ARROWS = _arrows()

# Curves that stand on the page's plane: 0 and 1 go up, 2 and 3 down (parallel to the wall); over the floor
# they go the way that the thin, far end and the thick, near end show.
_UPRIGHT_WAYS = (1.0, 1.0, -1.0, -1.0)
_OVER_FLOOR_WAYS = ((0, 1), (0, 1), (-1, 1), (-1, -1), (0, -1), (0, -1), (1, -1), (1, 1))
# first base, last base, arcs, where they swing out: front, left, up
_STANDING: tuple[tuple[int, int, int, tuple[float, float, float]], ...] = (
    (0x2A6, 0x2A6, 1, (1.0, 0.0, 0.0)),
    (0x2A7, 0x2A7, 2, (1.0, 0.0, 0.0)),
    (0x2AD, 0x2AD, 1, (-1.0, 0.0, 0.0)),
    (0x2AE, 0x2AE, 2, (-1.0, 0.0, 0.0)),
    (0x2B7, 0x2B8, 1, (0.0, 0.0, 1.0)),
    (0x2B9, 0x2BA, 2, (0.0, 0.0, 1.0)),
    (0x2BB, 0x2BC, 3, (0.0, 0.0, 1.0)),
    (0x2C6, 0x2C7, 1, (0.0, 0.0, -1.0)),
    (0x2C8, 0x2C9, 2, (0.0, 0.0, -1.0)),
    (0x2CA, 0x2CB, 3, (0.0, 0.0, -1.0)),
)

# base: turns; parallel to the wall, and standing on the page.
_WALL_CIRCLES = {0x2E3: 1, 0x2E4: 1, 0x2E5: 2, 0x2E6: 2, 0x2ED: 1, 0x2EE: 2}
_STANDING_CIRCLES = {0x2E7: 1, 0x2E8: 1, 0x2E9: 1, 0x2EA: 2, 0x2EB: 2, 0x2EC: 2}

_TURNS_ONCE = (0x2A2, 0x2AA, 0x2B1, 0x2C3, 0x2D2, 0x2DF)
_TURNS_TWICE = (0x2A3, 0x2AB, 0x2B2, 0x2C4, 0x2D3, 0x2E0)
_TURNS_TO_AND_FRO = (0x2A4, 0x2A5, 0x2AC, 0x2B3, 0x2C5, 0x2D4, 0x2E1, 0x2E2)

# Drawn in more forms than the three heads of arrows.
_SHAKING = (0x2A5, 0x2E2)

# Dots of finger movement: base: opens, how often (with fill 0; fill 1 once more).
_CLOSINGS = {
    0x216: (False, 1),
    0x217: (False, 1),
    0x218: (False, 2),
    0x219: (False, 2),
    0x21B: (True, 1),
    0x21C: (True, 1),
    0x21D: (True, 2),
    0x21E: (True, 2),
}
_BEATS = {0x221: 0, 0x222: 0, 0x225: 1, 0x226: 1}  # knuckles bend: together, or in turn


def movement_of(symbol: Symbol) -> Movement | None:
    """What a movement symbol says; None if it is one that is not read."""
    fingers = is_finger_movement(symbol)
    shaking = symbol.base in _SHAKING
    kind = _kind(symbol) if fingers or shaking or symbol.fill in _HEADS else None
    hands: Hands = "both" if fingers else _HEADS.get(symbol.fill, "both")
    return None if kind is None else Movement(symbol=symbol, hands=hands, kind=kind)


def _kind(symbol: Symbol) -> Kind | None:
    base = symbol.base
    if base in _ARROWS:
        return _path(symbol, _ARROWS[base])
    if 0x255 <= base <= 0x264:
        return _diagonal(symbol)
    for first, last, arcs, aside in _STANDING:
        if first <= base <= last:
            return _standing(symbol, arcs, np.array(aside))
    if base in _WALL_CIRCLES or base in _STANDING_CIRCLES:
        return _circle(symbol)
    if base in _TURNS_ONCE:
        return Turning()
    if base in _TURNS_TWICE or base in _TURNS_TO_AND_FRO:
        return Swinging(joint="forearm", times=2)
    if base in _CLOSINGS:
        opens, times = _CLOSINGS[base]
        return Closing(opens=opens, times=times + (symbol.fill if times > 1 else 0))
    if base in (0x21A, 0x21F, 0x220):
        return Swinging(joint="fingers", times=2)
    if base in _BEATS:
        return Swinging(joint="fingers", times=max(1, symbol.fill) + _BEATS[base])
    return None


def is_finger_movement(symbol: Symbol) -> bool:
    """Whether it is a movement of fingers, drawn beside the hand that makes it, not an arrow with a head."""
    return 0x216 <= symbol.base <= 0x229


def _length(symbol: Symbol, *, wide: bool = False) -> float:
    """Length of an arrow, drawn upright (or level) with rotation 0 [cm]."""
    width, height = symbol_size(f"S{symbol.base:03x}00")
    return CM_PER_PIXEL * (width if wide else height)


def _path(symbol: Symbol, arrow: _Arrow) -> Path:
    length = _length(symbol, wide=arrow.wide)

    def placed(vector: tuple[float, float]) -> Array:
        return length * in_space(turned(np.array(vector), symbol.rotation), arrow.plane)

    return Path(
        segments=tuple(Segment(way=placed(way), bulge=placed(bulge)) for way, bulge in arrow.drawn),
        times=arrow.times,
        to_and_fro=arrow.to_and_fro,
        bent_wrist=arrow.bent_wrist,
    )


def _diagonal(symbol: Symbol) -> Path:
    """Arrows aslant to the wall: away from the signer with a bar, towards the signer with a dot."""
    away = symbol.base <= 0x258 or 0x25D <= symbol.base <= 0x260
    between = symbol.base >= 0x25D  # nearer to the wall's plane
    depth = (1.0 if away else -1.0) * (0.5 if between else 1.0)
    way = in_space(turned(np.array(_UP), symbol.rotation), "wall") + np.array([depth, 0.0, 0.0])
    unit = way / np.linalg.norm(way)
    return Path(segments=(Segment(way=_length(symbol) * unit, bulge=np.zeros(3)),))


def _standing(symbol: Symbol, arcs: int, aside: Array) -> Path | None:
    if aside[2]:
        if symbol.rotation > 7:
            return None
        right, front = _OVER_FLOOR_WAYS[symbol.rotation]
        way = np.array([float(front), -float(right), 0.0])
    else:
        if symbol.rotation > 3:
            return None
        way = np.array([0.0, 0.0, _UPRIGHT_WAYS[symbol.rotation]])
    part = _length(symbol) * way / np.linalg.norm(way) / arcs
    bulge = 0.4 * float(np.linalg.norm(part)) * aside
    return Path(segments=(Segment(way=part, bulge=bulge),) * arcs)


def _circle(symbol: Symbol) -> Circling:
    at = turned(np.array(_UP), symbol.rotation)
    if symbol.base in _WALL_CIRCLES:
        radius = CM_PER_PIXEL * symbol_size(f"S{symbol.base:03x}00")[0] / 2.0
        # Counterclockwise, mirrored from 8 on.
        then = turned(np.array(_LEFT), symbol.rotation)
        return Circling(
            first=radius * in_space(at, "wall"),
            then=radius * in_space(then, "wall"),
            turns=_WALL_CIRCLES[symbol.base],
        )
    radius = _length(symbol) / 2.0
    # Seen on its edge: the arrow is on the side that is nearer to the signer.
    return Circling(
        first=np.array([-radius, 0.0, 0.0]),
        then=radius * in_space(at, "wall"),
        turns=_STANDING_CIRCLES[symbol.base],
    )
