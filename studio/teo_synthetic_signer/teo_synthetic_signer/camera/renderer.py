# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Images of people in a room, in its light, before a camera that stands still."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.camera.camera_model import CameraModel
from teo_synthetic_signer.body.rotations import unit
from teo_synthetic_signer.body.surface import Hits, Material, RayCaster, Surface, vertex_normals


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


Floats = NDArray[np.float32]

# How far the lamp reaches round edges: it is wide.
_WIDE = np.float32(0.25)
_IRIS = np.array([0.20, 0.13, 0.08], dtype=np.float32)
# Half the angles that the iris and the pupil span, seen from the middle of the eye [rad].
_IRIS_ANGLE, _PUPIL_ANGLE = 0.52, 0.21
_GAMMA = np.float32(1.0 / 2.2)  # of displays


class _Painter:
    """Paints one surface.

    Nothing throws a shadow: detectors do not need it, and it would double the rays.
    """

    def __init__(self, surface: Surface, normals: FloatArray, upright: FloatArray, light: Light) -> None:
        """Prepare to paint a surface with the normals of its vertices, in the camera's axes; shape (n, 3)."""
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


# Grey of what is beyond the room.
_NOTHING = np.float32(0.35)
# Difference to a neighbour, of the range, from which a pixel is cast four times: it smooths edges.
_CONTRAST = 0.05
_CORNERS = ((-0.25, -0.25), (-0.25, 0.25), (0.25, -0.25), (0.25, 0.25))


@dataclass(frozen=True, eq=False)
class Rendered:
    """One image before any sensor.

    Attributes:
        color: 0 to 1, as a display shows it. Shape (height, width, 3).
        distance: Along the optical axis [m], infinite where nothing is. Shape (height, width).
        facing: Cosine between the surface's normal and the view. Shape (height, width).
        people: Cast rays at each person alone.
    """

    color: Floats
    distance: Floats
    facing: Floats
    people: tuple[RayCaster, ...]


class Renderer:
    """Renders people, who move, in one room, which is rendered once."""

    def __init__(
        self,
        camera: CameraModel,
        upright: FloatArray,
        bodies: Sequence[Surface],
        room: Surface,
        walls: FloatArray,
        light: Light,
    ) -> None:
        """Render the room.

        Args:
            camera: Takes the images.
            upright: Rotation from the room's axes to the camera's. Shape (3, 3).
            bodies: Surface of each person.
            room: Surface of the room.
            walls: The room's vertices in the camera's axes [m]. Shape (n, 3).
            light: In the room.
        """
        self._camera = camera
        self._upright = upright
        self._bodies = bodies
        self._light = light
        self._shape = (camera.height, camera.width)
        rows, columns = np.indices(self._shape)
        self._pixels = np.column_stack([columns.ravel(), rows.ravel()]).astype(np.float64)
        self._rays = self._directions(self._pixels)
        self.room = RayCaster(walls[room.triangles])
        self._room_painter = _Painter(room, vertex_normals(walls, room.triangles), upright, light)
        everything = np.arange(len(self._rays))
        self._color = np.full((len(self._rays), 3), _NOTHING)
        self._distance = np.full(len(self._rays), np.inf, dtype=np.float32)
        self._facing = np.zeros(len(self._rays), dtype=np.float32)
        self._draw(self.room, self._room_painter, everything, self._color, self._distance, self._facing)
        self._smooth(self._color, np.flatnonzero(self._rough(self._color)), [])

    def render(self, people: Sequence[FloatArray]) -> Rendered:
        """Render one image.

        Args:
            people: Vertices of each body's surface in the camera's axes [m]. Shape (n, 3) each.
        """
        color, distance, facing = self._color.copy(), self._distance.copy(), self._facing.copy()
        mask = np.zeros(self._shape, dtype=np.uint8)
        layers: list[tuple[RayCaster, _Painter]] = []
        for person, body in zip(people, self._bodies, strict=True):
            caster = RayCaster(person[body.triangles])
            normals = vertex_normals(person, body.triangles)
            painter = _Painter(body, normals, self._upright, self._light)
            mask.ravel()[self._draw(caster, painter, self._around(person), color, distance, facing)] = 1
            layers.append((caster, painter))
        mask = cv2.dilate(mask, np.ones((3, 3), dtype=np.uint8)).astype(np.uint8)
        self._smooth(color, np.flatnonzero(self._rough(color) & (mask.ravel() > 0)), layers)
        return Rendered(
            color.reshape(*self._shape, 3),
            distance.reshape(self._shape),
            facing.reshape(self._shape),
            tuple(caster for caster, _ in layers),
        )

    def _directions(self, pixels: FloatArray) -> Floats:
        return self._camera.rays(pixels).astype(np.float32)

    def _around(self, person: FloatArray) -> NDArray[np.int64]:
        """Give the pixels of the rectangle that the person is in."""
        if (person[:, 2] < 0.05).any():  # some of the body is beside or behind the camera: anywhere
            return np.arange(len(self._rays))
        pixels = self._camera.project(person)
        height, width = self._shape
        left, top = np.clip(np.floor(pixels.min(axis=0)) - 1, 0, [width, height]).astype(int)
        right, bottom = np.clip(np.ceil(pixels.max(axis=0)) + 2, 0, [width, height]).astype(int)
        rectangle = np.zeros(self._shape, dtype=bool)
        rectangle[top:bottom, left:right] = True
        return np.flatnonzero(rectangle)

    def _draw(
        self,
        caster: RayCaster,
        painter: _Painter,
        pixels: NDArray[np.int64],
        color: Floats,
        distance: Floats,
        facing: Floats,
    ) -> NDArray[np.int64]:
        """Draw what is nearer than what is drawn already; give the pixels that changed."""
        hits = caster.cast(self._rays[pixels])
        nearer = np.flatnonzero(hits.distance < distance[pixels])
        drawn: NDArray[np.int64] = pixels[nearer]
        color[drawn], facing[drawn] = painter.paint(hits.of(nearer), self._rays[drawn])
        distance[drawn] = hits.distance[nearer]
        return drawn

    def _rough(self, color: Floats) -> NDArray[np.bool_]:
        """Find pixels that differ from a neighbour. Shape (height * width,)."""
        image = color.reshape(*self._shape, 3)
        rough = np.zeros(self._shape, dtype=bool)
        across = (np.abs(np.diff(image, axis=1)) > _CONTRAST).any(axis=2)
        down = (np.abs(np.diff(image, axis=0)) > _CONTRAST).any(axis=2)
        rough[:, 1:] |= across
        rough[:, :-1] |= across
        rough[1:] |= down
        rough[:-1] |= down
        return rough.ravel()

    def _smooth(
        self, color: Floats, pixels: NDArray[np.int64], people: Sequence[tuple[RayCaster, _Painter]]
    ) -> None:
        """Paint pixels anew, each the mean of four rays."""
        if len(pixels) == 0:
            return
        shifted = np.concatenate([self._pixels[pixels] + corner for corner in _CORNERS])
        rays = self._directions(shifted)
        painted = np.full((len(rays), 3), _NOTHING)
        distance = np.full(len(rays), np.inf, dtype=np.float32)
        for layer, brush in ((self.room, self._room_painter), *people):
            hits: Hits = layer.cast(rays)
            nearer = np.flatnonzero(hits.distance < distance)
            painted[nearer] = brush.paint(hits.of(nearer), rays[nearer])[0]
            distance[nearer] = hits.distance[nearer]
        color[pixels] = painted.reshape(len(_CORNERS), -1, 3).mean(axis=0)
