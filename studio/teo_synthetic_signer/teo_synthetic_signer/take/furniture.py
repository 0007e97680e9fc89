# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Rooms: what stands around the person, as boxes."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_synthetic_signer.body.body_shapes import Color
from teo_synthetic_signer.body.surface import Material, Surface
from teo_synthetic_signer.errors import named

Span = tuple[float, float]
_CORNERS = np.array([[i >> 2 & 1, i >> 1 & 1, i & 1] for i in range(8)])
_SIDES = np.array(
    [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
)  # back, front, right, left, bottom, top: the corners of each; none is shared, so that edges stay sharp
_FACES = np.concatenate([[[4 * i, 4 * i + 1, 4 * i + 2], [4 * i, 4 * i + 2, 4 * i + 3]] for i in range(6)])


class Box(NamedTuple):
    """A box along the axes of the room, x to the camera, y to the person's left, z up: from and to [m]."""

    x: Span
    y: Span
    z: Span
    color: Color
    material: Material = Material.PLAIN


_FLOOR = Box((-4.0, 6.0), (-4.0, 4.0), (-0.1, 0.0), (0.45, 0.42, 0.38), Material.TILES)
_WHITE = (0.72, 0.71, 0.68)
_OAK = (0.50, 0.36, 0.22)


def _table(x: float, y: float, width: float = 1.2, depth: float = 0.7) -> tuple[Box, ...]:
    top = Box((x, x + depth), (y, y + width), (0.72, 0.75), _OAK, Material.WOOD)
    legs = [
        Box((a, a + 0.05), (b, b + 0.05), (0.0, 0.72), (0.25, 0.25, 0.27))
        for a in (x + 0.03, x + depth - 0.08)
        for b in (y + 0.03, y + width - 0.08)
    ]
    return (top, *legs)


def _chair(x: float, y: float, color: Color) -> tuple[Box, ...]:
    seat = Box((x, x + 0.42), (y, y + 0.42), (0.43, 0.47), color)
    back = Box((x, x + 0.04), (y, y + 0.42), (0.47, 0.92), color)
    legs = [
        Box((a, a + 0.03), (b, b + 0.03), (0.0, 0.43), (0.2, 0.2, 0.2))
        for a in (x, x + 0.39)
        for b in (y, y + 0.39)
    ]
    return (seat, back, *legs)


def _shelf(x: float, y: float, width: float, height: float) -> tuple[Box, ...]:
    """Build a shelf with books; their sizes and colours are the same each time."""
    random = np.random.default_rng(7)
    depth = 0.28
    boxes = [
        Box((x, x + depth), (y + side, y + side + 0.02), (0.0, height), _OAK, Material.WOOD)
        for side in (0.0, width - 0.02)
    ]
    boxes.append(Box((x, x + 0.01), (y, y + width), (0.0, height), (0.38, 0.28, 0.18), Material.WOOD))
    for board in np.arange(0.05, height, 0.36):
        boxes.append(Box((x, x + depth), (y, y + width), (board, board + 0.02), _OAK, Material.WOOD))
        place = y + 0.04
        while place < y + width - 0.12:
            thick, tall = random.uniform(0.02, 0.05), random.uniform(0.18, 0.30)
            color = tuple(random.uniform(0.08, 0.6, 3))
            book = Box(
                (x + 0.02, x + random.uniform(0.15, 0.24)),
                (place, place + thick),
                (board + 0.02, board + 0.02 + tall),
                color,
            )
            boxes.append(book)
            place += thick + (0.0 if random.random() < 0.85 else 0.12)
    return tuple(boxes)


def _wall(x: float, color: Color = _WHITE) -> Box:
    return Box((x - 0.1, x), (-4.0, 4.0), (0.0, 4.0), color, Material.PLASTER)


SCENES: dict[str, tuple[Box, ...]] = {
    "studio": (_FLOOR, _wall(-1.5, (0.30, 0.42, 0.52))),
    "office": (
        _FLOOR,
        _wall(-1.3),
        *_shelf(-1.29, 0.35, 1.1, 2.0),
        *_table(-0.9, -1.9),
        *_chair(-0.7, -1.0, (0.15, 0.22, 0.32)),
        Box((-1.3, -1.27), (-0.9, -0.2), (1.25, 1.75), (0.55, 0.32, 0.20)),
    ),
    "near_wall": (
        _FLOOR,
        _wall(-0.35, (0.62, 0.60, 0.52)),
        Box((-0.35, -0.05), (0.55, 1.2), (0.0, 0.8), _OAK, Material.WOOD),
    ),
    "living_room": (
        _FLOOR,
        _wall(-2.4, (0.66, 0.58, 0.48)),
        Box((-2.3, -1.5), (-1.6, 0.7), (0.0, 0.42), (0.20, 0.30, 0.34), Material.CLOTH),
        Box((-2.35, -2.1), (-1.6, 0.7), (0.42, 0.85), (0.20, 0.30, 0.34), Material.CLOTH),
        Box((-2.4, -2.36), (-0.9, 0.1), (1.3, 1.9), (0.30, 0.20, 0.14)),
        *_shelf(-1.9, 0.9, 0.8, 1.7),
        *_chair(-0.5, 0.75, (0.42, 0.20, 0.12)),
    ),
}


def furnish(name: str) -> tuple[FloatArray, Surface]:
    """Build a room.

    Returns:
        Vertices, x towards the camera, the person at the origin [m], and the surface.

    Raises:
        SyntheticError: No room has that name.
    """
    boxes = named("scene", name, SCENES)
    spans = np.array([[box.x, box.y, box.z] for box in boxes])
    vertices = np.concatenate([low_high[np.arange(3), _CORNERS[_SIDES.ravel()]] for low_high in spans])
    triangles = np.concatenate([_FACES + 24 * i for i in range(len(boxes))])
    colors = np.repeat([box.color for box in boxes], 24, axis=0)
    surface = Surface(
        triangles,
        colors,
        vertices,
        colors,
        colors,
        np.repeat([box.material for box in boxes], len(_FACES)).astype(np.int8),
        np.full(len(triangles), -1, dtype=np.int16),
    )
    return vertices, surface
