# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Colours of what rays hit: patterns of materials and the light in a room."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from teo_skeleton_retriever.arrays import FloatArray
from teo_synthetic_signer.body.rotations import unit
from teo_synthetic_signer.body.surface import Hits, Material, Surface
from teo_synthetic_signer.errors import unknown_name


@dataclass(frozen=True, kw_only=True)
class Light:
    """A lamp, the ceiling, a little from the floor and from the camera.

    Strengths are parts of what white paper may reflect before it is burnt out.

    Attributes:
        towards: To the lamp: forwards to the camera, to the person's left, up. Of any length.
        lamp: Strength of the lamp.
        sky: Of the ceiling.
        ground: Of the floor.
        fill: Of the camera's side.
        tint: Red, green, blue of all of it.
    """

    towards: tuple[float, float, float] = (0.62, 0.38, 0.68)
    lamp: float = 0.50
    sky: float = 0.34
    ground: float = 0.14
    fill: float = 0.14
    tint: tuple[float, float, float] = (1.0, 1.0, 1.0)


LIGHTS: dict[str, Light] = {
    "room": Light(),
    "window": Light(towards=(0.15, -0.95, 0.30), lamp=0.75, sky=0.20, ground=0.08, fill=0.06),
    "ceiling": Light(towards=(0.05, 0.0, 1.0), lamp=0.60, sky=0.30, ground=0.08, fill=0.04),
    "evening": Light(
        towards=(0.40, 0.70, 0.25), lamp=0.28, sky=0.10, ground=0.07, fill=0.05, tint=(1.0, 0.84, 0.62)
    ),
}


def light_named(name: str) -> Light:
    """Give a light by name.

    Raises:
        SyntheticError: None has that name.
    """
    if name not in LIGHTS:
        raise unknown_name("light", name, LIGHTS)
    return LIGHTS[name]


Floats = NDArray[np.float32]

# How far the lamp reaches round edges: it is wide.
_WIDE = np.float32(0.25)
_IRIS = np.array([0.20, 0.13, 0.08], dtype=np.float32)
# Half the angles that the iris and the pupil span, seen from the middle of the eye [rad].
_IRIS_ANGLE, _PUPIL_ANGLE = 0.52, 0.21
_GAMMA = np.float32(1.0 / 2.2)  # of displays


class Painter:
    """Paints one surface.

    Nothing throws a shadow: detectors do not need it, and it would double the rays.
    """

    def __init__(self, surface: Surface, normals: FloatArray, upright: FloatArray, light: Light) -> None:
        """Prepare to paint.

        Args:
            surface: What is there.
            normals: Of its vertices, in the axes of the camera. Shape (n, 3).
            upright: Rotation from the room's axes to the camera's. Shape (3, 3).
            light: In the room.
        """
        self._light = light
        self._lamp = unit(np.array(light.towards)).astype(np.float32)
        self._tint = np.array(light.tint, dtype=np.float32)
        self._surface = surface
        self._vertices = np.hstack([surface.colors, surface.patterns, normals]).astype(np.float32)
        self._room = upright.T.astype(np.float32)

    def paint(self, hits: Hits, directions: Floats) -> tuple[Floats, Floats]:
        """Paint what rays hit; each must hit something.

        Returns:
            Colours, 0 to 1, as a display shows them, shape (n, 3); and the cosine between each ray and the
            surface it hits, shape (n,).
        """
        corners = self._surface.triangles[hits.triangle]
        mixed: Floats = np.zeros((len(corners), 9), dtype=np.float32)
        for i in range(3):
            mixed += self._vertices[corners[:, i]] * hits.shares[:, i, None]
        albedo, place, normal = mixed[:, :3], mixed[:, 3:6], mixed[:, 6:]
        normal /= np.sqrt(np.einsum("ij,ij->i", normal, normal))[:, None] + np.float32(1e-9)
        length = np.sqrt(np.einsum("ij,ij->i", directions, directions))
        facing = -np.einsum("ij,ij->i", normal, directions) / length
        normal[facing < 0.0] *= -1.0
        facing = np.abs(facing)
        materials = self._surface.materials[hits.triangle]
        cloth = materials == Material.CLOTH
        below, above = cloth & (place[:, 2] < 0.0), cloth & (place[:, 2] > 1.0)
        albedo[below] = self._surface.below[corners[below, 0]]
        albedo[above] = self._surface.above[corners[above, 0]]
        materials = np.where(above, np.int8(Material.PLAIN), materials)
        albedo = _patterned(albedo, place, materials)
        color = albedo * self._brightness(normal, facing)[:, None] * self._tint
        return np.clip(color, 0.0, 1.0) ** _GAMMA, facing

    def _brightness(self, normal: Floats, facing: Floats) -> Floats:
        lamp = np.clip((normal @ (self._lamp @ self._room) + _WIDE) / (1 + _WIDE), 0.0, 1.0)
        up = normal @ self._room[2]
        light: Floats = (
            np.float32(self._light.lamp) * lamp
            + np.float32(self._light.ground)
            + np.float32((self._light.sky - self._light.ground) / 2.0) * (1 + up)
            + np.float32(self._light.fill) * facing
        )
        return light


def _patterned(albedo: Floats, place: Floats, materials: NDArray[np.int8]) -> Floats:
    for kind in np.unique(materials):
        if kind == Material.PLAIN:
            continue
        here = np.flatnonzero(materials == kind)
        x, y, z = place[here].T
        if kind == Material.EYE:
            angle = np.arctan2(np.hypot(y, z), x)[:, None]
            looking = np.where(angle < _IRIS_ANGLE, _IRIS, albedo[here])
            albedo[here] = np.where(angle < _PUPIL_ANGLE, np.float32(0.02), looking)
        else:
            albedo[here] *= _shade(Material(kind), x, y, z)[:, None]
    return albedo


def _shade(kind: Material, x: Floats, y: Floats, z: Floats) -> Floats:
    """Give how much lighter or darker a material is at places of its pattern."""
    match kind:
        case Material.CLOTH:
            shade = 1 + 0.05 * np.sin(900 * y) * np.sin(400 * z) + 0.04 * np.sin(37 * y + 10 * z)
        case Material.HAIR:
            shade = 1 + 0.35 * np.sin(700 * y + 60 * x) * np.sin(31 * z + 90 * y)
        case Material.WOOD:
            shade = 1 + 0.12 * np.sin(160 * z + 9 * np.sin(7 * y) + 11 * x)
        case Material.TILES:
            joint = (np.abs((x / 0.3) % 1 - 0.5) > 0.485) | (np.abs((y / 0.3) % 1 - 0.5) > 0.485)
            shade = np.where(joint, np.float32(0.6), 1 + 0.05 * np.sin(17 * x) * np.sin(13 * y))
        case _:
            shade = 1 + 0.03 * np.sin(5 * y + 3 * np.sin(4 * z)) + 0.015 * np.sin(43 * y + 61 * z)
    result: Floats = shade.astype(np.float32)
    return result
