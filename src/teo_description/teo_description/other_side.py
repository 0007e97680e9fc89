# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Frames and shapes of a robot's other side: the mirror images of those that ``robot.yaml`` gives."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence
from functools import cached_property

import numpy as np
from msgspec.structs import replace

from teo_common.arrays import Array
from teo_description.schema.urdf import Frame, Solid, Vector

# The mirror image about the plane between left and right.
_MIRROR = np.diag([1.0, -1.0, 1.0, 1.0])

# Decimals of a length [m] and an angle [deg]: so coarse that a robot's hash is the same on every machine.
_DECIMALS = 9


def mirrored_name(name: str, mirror: Sequence[tuple[str, str]]) -> str:
    """The same joint, link or frame of the other side; a name without a side comes back unchanged.

    Args:
        name: Of a joint, link or frame.
        mirror: What stands in a left one's name, and what in the right one's.
    """
    for left, right in mirror:
        for one, other in ((left, right), (right, left)):
            if one in name:
                return name.replace(one, other)
    return name


class OtherSide:
    """The mirror image of what is fixed to a URDF's links, with all joints at zero."""

    def __init__(self, root: ET.Element, mirror: Sequence[tuple[str, str]]) -> None:
        """Take a URDF and what tells its sides apart; see `mirrored_name`."""
        self._root = root
        self._mirror = mirror

    def frames(self, frames: Mapping[str, Frame]) -> dict[str, Frame]:
        """The frames that are missing on the other side, by name."""
        found: dict[str, Frame] = {}
        for name, frame in frames.items():
            other = mirrored_name(name, self._mirror)
            if other not in frames:
                xyz, rpy = self._image(frame.link, frame.xyz, frame.rpy_deg, {**frames, **found})
                found[other] = Frame(link=mirrored_name(frame.link, self._mirror), xyz=xyz, rpy_deg=rpy)
        return found

    def shapes(self, shapes: Mapping[str, Sequence[Solid]]) -> dict[str, tuple[Solid, ...]]:
        """The shapes that are missing on the other side, by link."""
        found = {}
        for link, solids in shapes.items():
            other = mirrored_name(link, self._mirror)
            if other not in shapes:
                images = [self._image(link, solid.xyz, solid.rpy_deg, {}) for solid in solids]
                found[other] = tuple(
                    replace(solid, xyz=xyz, rpy_deg=rpy)
                    for solid, (xyz, rpy) in zip(solids, images, strict=True)
                )
        return found

    def _image(
        self, link: str, xyz: Vector, rpy_deg: Vector, frames: Mapping[str, Frame]
    ) -> tuple[Vector, Vector]:
        """Place in the other side's link of the mirror image of a place in a link [m], [deg].

        Shapes are their own mirror images in their own axes, and axes stay right-handed, so y is turned back.
        """
        from scipy.spatial.transform import Rotation  # here: half a second that TEO's URDF does without

        here = self._pose(link, frames) @ _transform(xyz, np.radians(rpy_deg))
        there = self._pose(mirrored_name(link, self._mirror), frames)
        image = np.linalg.inv(there) @ _MIRROR @ here @ _MIRROR
        rpy = Rotation.from_matrix(image[:3, :3]).as_euler("xyz", degrees=True, suppress_warnings=True)
        (x, y, z), (roll, pitch, yaw) = (
            np.round(values, _DECIMALS).tolist() for values in (image[:3, 3], rpy)
        )
        return (x, y, z), (roll, pitch, yaw)

    def _pose(self, link: str, frames: Mapping[str, Frame]) -> Array:
        """Of a link or one of some frames, in the root's axes. Shape (4, 4)."""
        if link in frames:
            frame = frames[link]
            return self._pose(frame.link, frames) @ _transform(frame.xyz, np.radians(frame.rpy_deg))
        joint = self._joints.get(link)
        if joint is None:
            return np.eye(4)
        origin = joint.find("origin")
        at = {} if origin is None else origin.attrib
        xyz, rpy = (np.array(at.get(key, "0 0 0").split(), dtype=np.float64) for key in ("xyz", "rpy"))
        return self._pose(joint.find("parent").attrib["link"], frames) @ _transform(xyz, rpy)  # type: ignore[union-attr]

    @cached_property
    def _joints(self) -> dict[str, ET.Element]:
        return {joint.find("child").attrib["link"]: joint for joint in self._root.iter("joint")}  # type: ignore[union-attr]


def _transform(xyz: Sequence[float] | Array, rpy: Array) -> Array:
    from scipy.spatial.transform import Rotation

    matrix = np.eye(4)
    matrix[:3, :3] = Rotation.from_euler("xyz", rpy).as_matrix()
    matrix[:3, 3] = xyz
    return matrix
