# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the head does, and what TEO has no face for."""

from __future__ import annotations

from teo_sign_authoring.signwriting import symbol_groups as groups
from teo_sign_authoring.signwriting.written_sign import Symbol

# [deg] A nod and a turn that are seen; TEO bows by 10 at most.
_BOW, _TURN = 8.0, 25.0
_STRAIGHT, _FLOOR_STRAIGHT, _CURVE, _FLOOR_CURVE = 0x301, 0x303, 0x304, 0x305


def head_postures(symbols: tuple[Symbol, ...]) -> tuple[list[tuple[float, float]], tuple[str, ...]]:
    """Turns and bows of the head, one after the other [deg], and what of its movements TEO cannot make.

    A turn is to the right, a bow forward. With fill 0 the movement is made once, with 1 twice.
    """
    postures: list[tuple[float, float]] = []
    losses: list[str] = []
    for symbol in groups.of(symbols, groups.HEAD_MOVEMENTS):
        posture = _posture(symbol)
        if posture is None:
            losses.append(f"{symbol.key}, {symbol.name}: TEO's head turns and bows only")
        else:
            postures += [posture, (0.0, 0.0)] * (1 + min(symbol.fill, 2))
    return postures, tuple(losses)


def _posture(symbol: Symbol) -> tuple[float, float] | None:
    if symbol.rotation in (0, 4) and symbol.base in (_STRAIGHT, _FLOOR_STRAIGHT):
        up = symbol.rotation == 0
        forward = up if symbol.base == _FLOOR_STRAIGHT else not up
        return 0.0, _BOW if forward else -_BOW
    if symbol.rotation in (2, 6) and symbol.base in (_FLOOR_STRAIGHT, _CURVE, _FLOOR_CURVE):
        return (_TURN if symbol.rotation == 6 else -_TURN), 0.0
    return None


def face_words(symbols: tuple[Symbol, ...]) -> str:
    """What the face does, by the names of its symbols."""
    bare = {0x2FF, groups.HEAD_RIM, groups.EARS, *groups.HEAD_MOVEMENTS, *groups.NOSE, 0x33B, 0x36A}
    names = [symbol.name for symbol in groups.of(symbols, groups.HEADS) if symbol.base not in bare]
    return ", ".join(dict.fromkeys(names))
