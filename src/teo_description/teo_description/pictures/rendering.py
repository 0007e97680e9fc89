# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Pictures of a robot without a display: triangles drawn on the CPU by OpenCV's software rasteriser."""

from __future__ import annotations

import threading
from collections.abc import Mapping

import cv2
import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from teo_description.errors import DescriptionError
from teo_description.humanoid import DEFAULT_ROBOT, Humanoid
from teo_description.pictures.camera import Camera, camera_named, cameras
from teo_description.pictures.motion_video import MotionVideo, write_video
from teo_description.pictures.picture import Image, captioned, film_strip, save_png
from teo_description.pictures.visual_parts import joined, visual_parts
from teo_description.robot import Robot

# What other packages draw with.
__all__ = [
    "Camera",
    "Image",
    "MotionVideo",
    "Renderer",
    "camera_named",
    "cameras",
    "captioned",
    "film_strip",
    "render_pose",
    "save_png",
    "write_video",
]

# Samples along each side of a pixel: fingers are 9 pixels wide in the front view.
_SUPERSAMPLING = 2

# Greatest depth that is drawn [m]: nothing of the robot is farther from any sensible camera.
_FAR = 20.0

# Towards the light: before TEO, from the upper left, so that the hands stand out.
_LIGHT = np.array([0.75, 0.36, 0.56]) / np.linalg.norm([0.75, 0.36, 0.56])
_DIFFUSE = 0.58

# Light from everywhere, and more of it from above than from below.
_AMBIENT, _SKY = 0.42, 0.10

# Least step in depth that is drawn as an outline [m]: about half a finger's thickness.
_EDGE_STEP = 0.006

_EDGE_DARKNESS = 0.55

# Reach of the soft shadow behind a nearer part, in a picture of 480 lines [pixel].
_OCCLUSION_BLUR = 25

# Depth difference at which that shadow is full [m].
_OCCLUSION_DEPTH = 0.10

_OCCLUSION_DARKNESS = 0.45

_NEIGHBOURS = np.ones((3, 3), np.uint8)

_BACKGROUND_TOP, _BACKGROUND_BOTTOM = (0.90, 0.93, 0.96), (0.99, 0.99, 0.98)


class Renderer:
    """Draws poses of a robot; make one and use it for many frames (not by several threads at once)."""

    def __init__(self, robot: Robot | None = None) -> None:
        """Tessellate the visual shapes of the URDF and load its meshes.

        Args:
            robot: Kinematics to use; TEO's when not given.

        Raises:
            DescriptionError: ``renderer_unavailable`` when OpenCV has no rasteriser.
        """
        if not hasattr(cv2, "triangleRasterize"):
            raise DescriptionError(
                "renderer_unavailable",
                f"expected OpenCV 5 with triangleRasterize, got {cv2.__version__}; "
                "install opencv-python-headless>=5",
            )
        self._robot = robot or Robot.load()
        parts = sorted(visual_parts(self._robot), key=lambda part: part.joint)
        counts = [len(part.mesh.vertices) for part in parts]
        self._vertices, self._normals, self._triangles = joined(*(part.mesh for part in parts))
        self._colours = np.repeat([part.colour for part in parts], counts, axis=0).astype(np.float32)
        self._bodies = _slices([part.joint for part in parts], counts)
        self._settings = cv2.TriangleRasterizeSettings()
        self._settings.setCullingMode(cv2.RASTERIZE_CULLING_CW)
        self._settings.setShadingType(cv2.RASTERIZE_SHADING_SHADED)
        self._canvas: _Canvas | None = None

    @property
    def humanoid(self) -> Humanoid:
        """Whom it draws."""
        return self._robot.humanoid

    def render(self, positions: Mapping[str, float], camera: Camera | str = "front") -> Image:
        """Draw a pose.

        Args:
            positions: Joint positions [rad] by name; joints not named are at home.
            camera: A camera, or the name of one of the robot's: ``front``, ``hand``, ``full``.

        Returns:
            The picture, in the camera's size.

        Raises:
            DescriptionError: ``unknown_joint``, ``not_finite``, ``unknown_camera`` or ``unknown_frame``.
        """
        camera = camera_named(camera, self.humanoid)
        q = self._robot.configuration(positions)
        origin = np.zeros(3) if camera.follows is None else self._robot.placement(q, camera.follows)[:3, 3]
        vertices, colours = self._shaded(q)
        if self._canvas is None or self._canvas.size != camera.size:
            self._canvas = _Canvas(camera.size)
        canvas = self._canvas
        canvas.clear()
        view = camera.from_world(origin)
        cv2.triangleRasterize(
            vertices,
            self._beyond(camera.near, vertices, view),
            colours,
            canvas.colour,
            canvas.depth,
            view,
            camera.field_of_view,
            camera.near,
            _FAR,
            self._settings,
        )
        return canvas.finished()

    def _beyond(
        self, near: float, vertices: NDArray[np.float32], view: NDArray[np.float64]
    ) -> NDArray[np.int32]:
        """Triangles wholly beyond a distance [m]; the rasteriser is very slow over the others."""
        distance = -(vertices @ view[2, :3].astype(np.float32) + np.float32(view[2, 3]))
        beyond = distance > near
        if beyond.all():
            return self._triangles
        kept: NDArray[np.int32] = self._triangles[beyond[self._triangles].all(axis=1)]
        return kept

    def _shaded(self, q: NDArray[np.float64]) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """Vertices in ``base_link`` and their lit colours. Shapes (n, 3)."""
        robot = self._robot
        pin.forwardKinematics(robot.model, robot.data, q)
        vertices = np.empty_like(self._vertices)
        normals = np.empty_like(self._normals)
        for joint, part in self._bodies:
            placement = robot.data.oMi[joint]
            turned = placement.rotation.T
            np.matmul(self._vertices[part], turned, out=vertices[part])
            vertices[part] += placement.translation
            np.matmul(self._normals[part], turned, out=normals[part])
        light = _DIFFUSE * np.maximum(normals @ _LIGHT, 0.0) + (_AMBIENT + _SKY * normals[:, 2])
        return vertices.astype(np.float32), self._colours * light.astype(np.float32)[:, None]


def _slices(joints: list[int], counts: list[int]) -> list[tuple[int, slice]]:
    """Rows of the vertex array that each joint carries; `joints` is sorted."""
    found: dict[int, slice] = {}
    start = 0
    for joint, count in zip(joints, counts, strict=True):
        first = found[joint].start if joint in found else start
        start += count
        found[joint] = slice(first, start)
    return list(found.items())


class _Canvas:
    """The arrays that pictures of one size are drawn in; fresh memory each time would cost a third more."""

    def __init__(self, size: tuple[int, int]) -> None:
        self.size = size
        width, height = (side * _SUPERSAMPLING for side in size)
        top, bottom = (np.array(end, np.float32) for end in (_BACKGROUND_TOP, _BACKGROUND_BOTTOM))
        down = np.linspace(0.0, 1.0, height, dtype=np.float32)[:, None, None]
        self._background = np.ascontiguousarray(
            np.broadcast_to((1.0 - down) * top + down * bottom, (height, width, 3))
        )
        self.colour = np.empty((height, width, 3), np.float32)
        self.depth = np.empty((height, width), np.float32)
        self._nearby = np.empty_like(self.depth)
        self._small = np.empty((size[1], size[0], 3), np.float32)

    def clear(self) -> None:
        """Nothing but background."""
        np.copyto(self.colour, self._background)
        self.depth.fill(_FAR)

    def finished(self) -> Image:
        """Outline the parts, shade what lies behind others, and bring the picture to its size."""
        cv2.dilate(self.depth, _NEIGHBOURS, dst=self._nearby)
        cv2.subtract(self._nearby, self.depth, dst=self._nearby)
        # By index and not by mask: six times as fast for the few per cent of samples on an outline.
        self.colour.reshape(-1, 3)[np.flatnonzero(self._nearby > _EDGE_STEP)] *= _EDGE_DARKNESS
        cv2.resize(self.colour, self.size, dst=self._small, interpolation=cv2.INTER_AREA)
        self._small *= _occlusion(self.depth[::_SUPERSAMPLING, ::_SUPERSAMPLING])[..., None]
        image: Image = cv2.convertScaleAbs(self._small, alpha=255.0)
        return image


def _occlusion(depth: NDArray[np.float32]) -> NDArray[np.float32]:
    """Brightness factor: darker where the surroundings are nearer to the camera (Luft et al., 2006)."""
    figure = depth < _FAR
    if not figure.any():
        return np.ones_like(depth)
    # The background counts as being at the back of the figure, else every outline would glow.
    clipped = np.minimum(depth, depth[figure].max())
    blur = _OCCLUSION_BLUR * depth.shape[0] // 480 | 1
    behind = np.clip((clipped - cv2.blur(clipped, (blur, blur))) / _OCCLUSION_DEPTH, 0.0, 1.0)
    return np.where(figure, 1.0 - _OCCLUSION_DARKNESS * behind, 1.0).astype(np.float32)


_own = threading.local()


def render_pose(
    positions: Mapping[str, float], camera: Camera | str = "front", *, robot: str = DEFAULT_ROBOT
) -> Image:
    """Draw a pose with a renderer that each thread makes once for a robot; see `Renderer.render`."""
    renderers: dict[str, Renderer] = _own.__dict__.setdefault("renderers", {})
    if robot not in renderers:
        renderers[robot] = Renderer(Robot.load(robot))
    return renderers[robot].render(positions, camera)
