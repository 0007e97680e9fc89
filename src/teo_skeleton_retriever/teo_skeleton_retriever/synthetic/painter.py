"""Colours of what rays hit: patterns of materials and soft light."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.synthetic.ray_caster import Hits
from teo_skeleton_retriever.synthetic.rotations import unit
from teo_skeleton_retriever.synthetic.surface import Material, Surface

_LAMP = unit(np.array([0.62, 0.38, 0.68]))  # from before, from the left and above
_LAMP_STRENGTH, _SKY, _GROUND, _FILL = 0.62, 0.40, 0.16, 0.18
_IRIS = np.array([0.20, 0.13, 0.08])
_IRIS_ANGLE, _PUPIL_ANGLE = 0.52, 0.21
"""Half the angles that the iris and the pupil span, seen from the middle of the eye [rad]."""


class Painter:
    """Paints one image.

    Light comes from a lamp, from the ceiling, a little from the floor and from the camera. Nothing throws a
    shadow: detectors do not need it, and it would double the rays.
    """

    def __init__(self, surface: Surface, normals: FloatArray, upright: FloatArray) -> None:
        """Prepare to paint.

        Args:
            surface: what is there.
            normals: of its vertices, in the axes of the camera. Shape (n, 3).
            upright: rotation from the room's axes to the camera's. Shape (3, 3).
        """
        self._surface = surface
        self._normals = normals.astype(np.float32)
        self._room = upright.T.astype(np.float32)

    def paint(
        self, hits: Hits, directions: NDArray[np.float32]
    ) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """Paint what rays see.

        Returns:
            Colours, 0 to 1, as a display shows them, shape (n, 3); and the cosine between each ray and the
            surface it hits, shape (n,).
        """
        color = np.full((len(directions), 3), 0.35, dtype=np.float32)
        seen = np.flatnonzero(hits.triangle >= 0)
        triangle = hits.triangle[seen]
        shares = hits.shares[seen][:, :, None]
        corners = self._surface.triangles[triangle]
        albedo = (self._surface.colors[corners] * shares).sum(axis=1)
        place = (self._surface.patterns[corners] * shares).sum(axis=1)
        normal = (self._normals[corners] * shares).sum(axis=1)
        normal /= np.linalg.norm(normal, axis=1, keepdims=True) + 1e-9
        view = -directions[seen] / np.linalg.norm(directions[seen], axis=1, keepdims=True)
        facing = (normal * view).sum(axis=1)
        normal[facing < 0.0] *= -1.0
        albedo = self._patterned(albedo, place, self._surface.materials[triangle])
        light = self._light(normal @ self._room.T, np.abs(facing))
        color[seen] = albedo * light[:, None]
        cosine = np.zeros(len(directions), dtype=np.float32)
        cosine[seen] = np.abs(facing)
        return np.clip(color, 0.0, 1.0) ** np.float32(1.0 / 2.2), cosine

    @staticmethod
    def _light(normal: NDArray[np.float32], facing: NDArray[np.float32]) -> NDArray[np.float32]:
        lamp = np.clip((normal @ _LAMP + 0.25) / 1.25, 0.0, 1.0)  # a wide lamp reaches round edges
        sky = _GROUND + (_SKY - _GROUND) * (0.5 + 0.5 * normal[:, 2])
        light: NDArray[np.float32] = _LAMP_STRENGTH * lamp + sky + _FILL * facing
        return light

    @staticmethod
    def _patterned(albedo: FloatArray, place: FloatArray, material: NDArray[np.int8]) -> FloatArray:
        x, y, z = place.T
        factor = np.ones(len(place))
        for kind in np.unique(material):
            here = material == kind
            a, b, c = x[here], y[here], z[here]
            if kind == Material.CLOTH:
                factor[here] = (
                    1.0 + 0.05 * np.sin(900.0 * b) * np.sin(900.0 * c) + 0.04 * np.sin(37.0 * b + 23.0 * c)
                )
            elif kind == Material.HAIR:
                factor[here] = 1.0 + 0.35 * np.sin(700.0 * b + 60.0 * a) * np.sin(31.0 * c + 90.0 * b)
            elif kind == Material.WOOD:
                factor[here] = 1.0 + 0.12 * np.sin(160.0 * c + 9.0 * np.sin(7.0 * b) + 11.0 * a)
            elif kind == Material.TILES:
                joint = (np.abs((a / 0.3) % 1.0 - 0.5) > 0.485) | (np.abs((b / 0.3) % 1.0 - 0.5) > 0.485)
                factor[here] = np.where(joint, 0.6, 1.0 + 0.05 * np.sin(17.0 * a) * np.sin(13.0 * b))
            elif kind == Material.PLASTER:
                factor[here] = (
                    1.0 + 0.03 * np.sin(5.0 * b + 3.0 * np.sin(4.0 * c)) + 0.015 * np.sin(43.0 * b + 61.0 * c)
                )
            elif kind == Material.EYE:
                angle = np.arctan2(np.hypot(b, c), a)
                albedo[here] = np.where((angle < _IRIS_ANGLE)[:, None], _IRIS, albedo[here])
                albedo[here] = np.where((angle < _PUPIL_ANGLE)[:, None], 0.02, albedo[here])
        patterned: FloatArray = albedo * factor[:, None]
        return patterned
