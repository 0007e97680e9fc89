# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which symbols of ISWA 2010 mean what kind of thing, by base: the groups of its reference."""

from __future__ import annotations

from teo_sign_authoring.signwriting.written_sign import Symbol


def _span(first: int, last: int) -> frozenset[int]:
    return frozenset(range(first, last + 1))


HANDS = _span(0x100, 0x204)
CONTACTS = _span(0x205, 0x213)
MOVEMENTS = _span(0x216, 0x2F4)
DYNAMICS = _span(0x2F5, 0x2FE)
# A circle of 36 px, empty or with a part of the face.
HEADS = _span(0x2FF, 0x36A)
HEAD_MOVEMENTS = _span(0x301, 0x306)
HEAD_RIM = 0x300
SHOULDERS = _span(0x36D, 0x36E)
LIMBS = _span(0x376, 0x37D)

TOUCH, GRASP, STRIKE, BRUSH, RUB = (_span(first, first + 2) for first in (0x205, 0x208, 0x20B, 0x20E, 0x211))
# Of each kind of contact: once, several times, between the fingers.
MULTIPLE_CONTACTS = frozenset({0x206, 0x209, 0x20C, 0x20F, 0x212})
CONTACTS_BETWEEN = frozenset({0x207, 0x20A, 0x20D, 0x210, 0x213})

FAST, SLOW, TENSE, RELAXED = 0x2F7, 0x2F8, 0x2F9, 0x2FA
SIMULTANEOUS, ALTERNATING, EVERY_OTHER_TIME = 0x2FB, 0x2FC, 0x2FD

NOSE = _span(0x331, 0x334)
EARS = 0x330
MOUTH = _span(0x33B, 0x367)


def of(symbols: tuple[Symbol, ...], group: frozenset[int]) -> tuple[Symbol, ...]:
    """Those of a group, in the order in which they are written."""
    return tuple(symbol for symbol in symbols if symbol.base in group)
