# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Formal SignWriting: the symbols of a sign, what kind of thing each means, and where it is drawn.

A page is seen as the signer sees the own hands: right is right. FSW gives the upper left corner of a symbol
in pixels, the middle of the sign at (500, 500). Groups of bases are those of the reference of ISWA 2010.
"""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass
from functools import cache, lru_cache

import numpy as np
from signwriting.formats.fsw_to_sign import fsw_to_sign
from signwriting.visualizer.visualize import get_symbol_size, visualize_sign

from teo_common.arrays import Array
from teo_signs.errors import LutError


class UnreadableError(LutError):
    """A sign that cannot be read; its code is the stable name of the reason, such as "movement"."""


# One sign: a sequence for sorting, if any, then the box and its symbols.
_SIGN = re.compile(
    r"(?:A(?:S[123][0-9a-f]{2}[0-5][0-9a-f])+)?[BLMR]\d{3}x\d{3}(?:S[123][0-9a-f]{2}[0-5][0-9a-f]\d{3}x\d{3})+"
)
# The largest signs of public dictionaries have about 30 symbols.
_MOST_SYMBOLS = 60
# Unicode encodes the bases in the order of ISWA 2010, from 0x100 on.
_FIRST_BASE, _FIRST_CHARACTER = 0x100, 0x1D800


@dataclass(frozen=True, kw_only=True)
class Symbol:
    """A symbol of a sign.

    Attributes:
        base: What is drawn, 0x100 to 0x38b.
        fill: Its variant, 0 to 5.
        rotation: 0 to 15: steps of 45 deg, counterclockwise; from 8 on mirrored and clockwise.
        corner: Upper left corner, right and down [px]. Shape (2,).
        size: Width and height [px]. Shape (2,).
    """

    base: int
    fill: int
    rotation: int
    corner: Array
    size: Array

    @property
    def key(self) -> str:
        """The symbol as FSW writes it, without its place: "S15a02"."""
        return f"S{self.base:03x}{self.fill:x}{self.rotation:x}"

    @property
    def name(self) -> str:
        """The name of the base: "hand-fist index"."""
        return _symbol_name(self.base)

    @property
    def middle(self) -> Array:
        """Middle of what is drawn, right and down [px]. Shape (2,)."""
        return np.asarray(self.corner + self.size / 2.0)

    def distance(self, point: Array) -> float:
        """From the symbol's box to a point [px]; 0 inside."""
        return float(np.linalg.norm(point - self.nearest(point)))

    def nearest(self, point: Array) -> Array:
        """The point of the symbol's box that is nearest to a point [px]. Shape (2,)."""
        return np.clip(point, self.corner, self.corner + self.size)


def _symbol_name(base: int) -> str:
    """Name of a base as Unicode has it, in lower case."""
    name = unicodedata.name(chr(_FIRST_CHARACTER + base - _FIRST_BASE), "unknown")
    return name.removeprefix("SIGNWRITING ").lower()


def read_fsw(text: str) -> tuple[Symbol, ...]:
    """The symbols of one sign.

    Raises:
        LutError: "bad_fsw" if it is not one sign in Formal SignWriting; "unknown_symbol" if a symbol is none
            of ISWA 2010.
    """
    if not _SIGN.fullmatch(text):
        got = repr(text[:60]) if text else "nothing"
        raise LutError(
            "bad_fsw", f"expected one sign in Formal SignWriting, M518x533S1870a489x515; got {got}"
        )
    drawn = fsw_to_sign(text)["symbols"]
    if len(drawn) > _MOST_SYMBOLS:
        raise LutError("bad_fsw", f"expected at most {_MOST_SYMBOLS} symbols in a sign, got {len(drawn)}")
    return tuple(_symbol(each["symbol"], each["position"]) for each in drawn)


def symbol_size(key: str) -> tuple[int, int]:
    """Width and height of a symbol as the reference font draws it [px].

    Raises:
        LutError: "unknown_symbol".
    """
    width, height = _drawn_size(key)
    if not (width and height):
        raise LutError("unknown_symbol", f"expected a symbol of ISWA 2010, got {key}")
    return width, height


def looks_like_other_side(symbol: Symbol) -> bool:
    """Whether the drawing of a hand is the same for the other hand, held as its mirror would be."""
    turned = (8 - symbol.rotation % 8) % 8 + (8 if symbol.rotation < 8 else 0)
    return _drawing(symbol.key) == _drawing(f"{symbol.key[:-1]}{turned:x}")


@lru_cache(maxsize=1024)
def _drawing(key: str) -> tuple[tuple[int, int], bytes]:
    width, height = symbol_size(key)
    image = visualize_sign(f"M{500 + width}x{500 + height}{key}500x500", antialiasing=False)
    return image.size, image.tobytes()


def _symbol(key: str, corner: tuple[int, int]) -> Symbol:
    return Symbol(
        base=int(key[1:4], 16),
        fill=int(key[4], 16),
        rotation=int(key[5], 16),
        corner=np.array(corner, dtype=float),
        size=np.array(symbol_size(key), dtype=float),
    )


@cache
def _drawn_size(key: str) -> tuple[int, int]:
    width, height = get_symbol_size(key)
    return int(width), int(height)


def _span(first: int, last: int) -> frozenset[int]:
    return frozenset(range(first, last + 1))


HANDS = _span(0x100, 0x204)
CONTACTS = _span(0x205, 0x213)
MOVEMENTS = _span(0x216, 0x2F4)
# A circle of 36 px, empty or with a part of the face.
HEADS = _span(0x2FF, 0x36A)
HEAD_MOVEMENTS = _span(0x301, 0x306)
HEAD_RIM = 0x300
SHOULDERS = _span(0x36D, 0x36E)
LIMBS = _span(0x376, 0x37D)

BRUSH, RUB = _span(0x20E, 0x210), _span(0x211, 0x213)
# Of each kind of contact: once, several times, between the fingers.
MULTIPLE_CONTACTS = frozenset({0x206, 0x209, 0x20C, 0x20F, 0x212})
CONTACTS_BETWEEN = frozenset({0x207, 0x20A, 0x20D, 0x210, 0x213})

FAST, SLOW = 0x2F7, 0x2F8
ALTERNATING, EVERY_OTHER_TIME = 0x2FC, 0x2FD

NOSE = _span(0x331, 0x334)
EARS = 0x330
MOUTH = _span(0x33B, 0x367)


def symbols_of(symbols: tuple[Symbol, ...], group: frozenset[int]) -> tuple[Symbol, ...]:
    """Those of a group, in the order in which they are written."""
    return tuple(symbol for symbol in symbols if symbol.base in group)
