# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Images of people in a room that stands still before a camera that stands still."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.camera.camera_model import CameraModel
from teo_synthetic_signer.body.surface import Hits, RayCaster, Surface, vertex_normals
from teo_synthetic_signer.camera.painter import Floats, Light, Painter

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
        self._room_painter = Painter(room, vertex_normals(walls, room.triangles), upright, light)
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
        layers: list[tuple[RayCaster, Painter]] = []
        for person, body in zip(people, self._bodies, strict=True):
            caster = RayCaster(person[body.triangles])
            normals = vertex_normals(person, body.triangles)
            painter = Painter(body, normals, self._upright, self._light)
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
        painter: Painter,
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
        self, color: Floats, pixels: NDArray[np.int64], people: Sequence[tuple[RayCaster, Painter]]
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
