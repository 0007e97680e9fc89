# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Where a picture is taken from."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from teo_description.errors import DescriptionError
from teo_description.humanoid import Humanoid
from teo_description.robot_schema import Vector


@dataclass(frozen=True, kw_only=True)
class Camera:
    """A pinhole camera held upright.

    Attributes:
        position: Where it stands [m].
        target: The point in the middle of the picture [m].
        field_of_view: Vertical opening angle [rad].
        size: Width and height of the picture [pixel]; both even, as video needs.
        near: What is nearer to the camera than this is left out [m].
        follows: Frame of the robot whose origin `position` and `target` are relative to (axes always
            ``base_link``'s), or None.
    """

    position: Vector
    target: Vector
    field_of_view: float
    size: tuple[int, int] = (640, 480)
    near: float = 0.05
    follows: str | None = None

    def __post_init__(self) -> None:
        """Check the figures.

        Raises:
            DescriptionError: ``bad_camera``.
        """
        numbers = (*self.position, *self.target, self.field_of_view)
        if not all(math.isfinite(number) for number in numbers):
            raise DescriptionError("bad_camera", f"expected finite camera figures, got {numbers}")
        if not 0.0 < self.field_of_view < math.pi:
            raise DescriptionError(
                "bad_camera", f"expected a field of view between 0 and pi rad, got {self.field_of_view} rad"
            )
        if not 0.01 <= self.near <= 10.0:
            raise DescriptionError("bad_camera", f"expected near within 0.01 to 10 m, got {self.near} m")
        if any(side < 16 or side > 4096 or side % 2 for side in self.size):
            raise DescriptionError(
                "bad_camera", f"expected even sizes from 16 to 4096 pixels, got {self.size}"
            )
        across = np.cross(np.subtract(self.target, self.position), (0.0, 0.0, 1.0))
        if not np.linalg.norm(across) > 1e-6:
            raise DescriptionError(
                "bad_camera", "expected a camera that does not look straight up or down, or at itself"
            )

    def sized(self, width: int, height: int) -> Camera:
        """The same view on a picture of another size [pixel]."""
        return replace(self, size=(width, height))

    def from_world(self, origin: NDArray[np.float64]) -> NDArray[np.float64]:
        """Transform from ``base_link`` to the camera (x right, y up, z towards the viewer).

        Args:
            origin: Where the followed frame is [m]; zeros without one. Shape (3,).

        Returns:
            Shape (4, 4).
        """
        eye = origin + np.array(self.position)
        back = eye - origin - np.array(self.target)
        back /= np.linalg.norm(back)
        right = np.cross((0.0, 0.0, 1.0), back)
        right /= np.linalg.norm(right)
        matrix = np.eye(4)
        matrix[:3, :3] = right, np.cross(back, right), back
        matrix[:3, 3] = -matrix[:3, :3] @ eye
        return matrix

    def pixels(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Where a camera that follows no frame sees points: pixels from the upper left corner. Shape (n, 2).

        Args:
            points: In ``base_link``, before the camera [m]. Shape (n, 3).
        """
        view = self.from_world(np.zeros(3))
        seen = points @ view[:3, :3].T + view[:3, 3]
        width, height = self.size
        scale = height / 2.0 / math.tan(self.field_of_view / 2.0)
        across = scale * seen[:, :2] / -seen[:, 2:]
        return np.column_stack([width / 2.0 + across[:, 0], height / 2.0 - across[:, 1]])


def cameras(humanoid: Humanoid) -> Mapping[str, Camera]:
    """The views of a robot that have a name."""
    return {
        name: Camera(
            position=view.position,
            target=view.target,
            field_of_view=math.radians(view.field_of_view_deg),
            near=view.near,
            follows=view.follows,
        )
        for name, view in humanoid.file.cameras.items()
    }


def camera_named(camera: Camera | str, humanoid: Humanoid) -> Camera:
    """Look a view of a robot up; a camera comes back as it is.

    Raises:
        DescriptionError: ``unknown_camera``.
    """
    if isinstance(camera, Camera):
        return camera
    known = cameras(humanoid)
    if camera not in known:
        raise DescriptionError(
            "unknown_camera", f"expected a camera among {', '.join(known)}; got {camera!r}"
        )
    return known[camera]
