# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A robot's URDF with what its ``robot.yaml`` replaces and adds; what the mirror image of a frame is."""

from __future__ import annotations

import hashlib
import math
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property
from typing import NamedTuple

import numpy as np
from msgspec.structs import replace

from teo_common.arrays import Array
from teo_description.errors import DescriptionError
from teo_description.robot_file import RobotFile
from teo_description.robot_schema import Follow, Frame, Limit, Origin, Solid, Vector

_ROOT_LINK = "base_link"


class Urdf(NamedTuple):
    """A URDF as it is written, and as it is parsed: once for all who read it, who change nothing in it."""

    text: str
    tree: ET.Element


def completed_urdf(text: str, robot: RobotFile, where: str) -> Urdf:
    """The URDF as everything in the project sees it; the same text where nothing is to be changed.

    Args:
        text: The URDF as its makers wrote it.
        robot: What is said of it.
        where: What errors name: the path of ``robot.yaml``.

    Raises:
        DescriptionError: ``bad_robot``: no URDF, or a link or joint that is not in it.
    """
    try:
        root = ET.fromstring(text)
    except ET.ParseError as error:
        raise DescriptionError("bad_robot", f"{where}: urdf: expected XML: {error}") from error
    links = {link.get("name", ""): link for link in root.findall("link")}
    joints = {joint.get("name", ""): joint for joint in root.findall("joint")}
    tops = set(links) - {end_link(joint, "child") for joint in joints.values()}
    if root.tag != "robot" or len(tops) != 1:
        got = f"{len(tops)} links that no joint holds" if root.tag == "robot" else f"<{root.tag}>"
        raise DescriptionError("bad_robot", f"{where}: urdf: expected a robot with one root link, got {got}")
    _check_names(robot, links, joints, where)
    endless = [joint for joint in joints.values() if joint.get("type") == "continuous"]
    changes = (endless, robot.limits, robot.follows, robot.origins, robot.frames, robot.collision.shapes)
    if not any(changes) and _ROOT_LINK in links:
        return Urdf(text, root)
    if _ROOT_LINK not in links:
        _add_root(root, *tops)
    for joint in endless:
        _set_one_turn(joint)
    for name, limit in robot.limits.items():
        _set_limit(joints[name], limit)
    for name, follow in robot.follows.items():
        _set_follow(joints[name], follow)
    for name, origin in robot.origins.items():
        _set_origin(joints[name], origin)
    sides = _OtherSide(root, robot.mirror)
    for name, frame in {**sides.frames(robot.frames), **robot.frames}.items():
        _add_frame(root, name, frame)
    for name, solids in {**sides.shapes(robot.collision.shapes), **robot.collision.shapes}.items():
        _set_shapes(links[name], solids)
    for link in links.values():
        for collision in link.findall("collision"):
            if collision.find("geometry/mesh") is not None:
                link.remove(collision)
    return Urdf(ET.tostring(root, encoding="unicode"), root)


def with_speeds(text: str, speeds: Mapping[str, float]) -> Urdf:
    """A URDF with other greatest speeds of some joints [rad/s], and of those that follow them."""
    root = ET.fromstring(text)
    for joint in root.findall("joint"):
        mimic, limit = joint.find("mimic"), joint.find("limit")
        leader = joint.attrib["name"] if mimic is None else mimic.attrib["joint"]
        if limit is not None and leader in speeds:
            times = 1.0 if mimic is None else abs(float(mimic.get("multiplier", "1")))
            limit.set("velocity", repr(speeds[leader] * times))
    return Urdf(ET.tostring(root, encoding="unicode"), root)


def _check(names: Iterable[str], known: Mapping[str, object], where: str) -> None:
    missing = sorted(name for name in names if name not in known)
    if missing:
        raise DescriptionError("bad_robot", f"{where}: expected names in the URDF, got {', '.join(missing)}")


def _check_names(
    robot: RobotFile, links: Mapping[str, ET.Element], joints: Mapping[str, ET.Element], where: str
) -> None:
    """Every joint and link that is named is in the URDF or, a frame of the right side, in ``robot.yaml``."""
    _check(robot.limits, joints, f"{where}: limits")
    _check(robot.follows, joints, f"{where}: follows")
    _check((follow.joint for follow in robot.follows.values()), joints, f"{where}: follows")
    _check(robot.origins, joints, f"{where}: origins")
    frames = {**links, **robot.frames, _ROOT_LINK: None}
    _check((frame.link for frame in robot.frames.values()), frames, f"{where}: frames")
    _check(robot.collision.shapes, links, f"{where}: collision.shapes")
    hand, arm = robot.hand, robot.collision.right_arm
    _check((hand.palm, *hand.thumb), frames, f"{where}: hand")
    _check((frame for row in hand.fingers.values() for frame in row), frames, f"{where}: hand.fingers")
    _check(robot.collision.torso, frames, f"{where}: collision.torso")
    _check((*arm.shoulder, *arm.upper_arm, *arm.forearm, *arm.hand), frames, f"{where}: collision.right_arm")
    _check((view.follows for view in robot.cameras.values() if view.follows), frames, f"{where}: cameras")


def end_link(joint: ET.Element, which: str) -> str:
    """Name of a joint's parent or child link; empty where the file does not say."""
    end = joint.find(which)
    return "" if end is None else end.get("link", "")


def _add_root(root: ET.Element, top: str) -> None:
    """An empty root of the name that the project uses, where the URDF's own root is."""
    ET.SubElement(root, "link", name=_ROOT_LINK)
    joint = ET.SubElement(root, "joint", name=f"{_ROOT_LINK}_fixed", type="fixed")
    ET.SubElement(joint, "parent", link=_ROOT_LINK)
    ET.SubElement(joint, "child", link=top)


def _set_one_turn(joint: ET.Element) -> None:
    """A joint that turns without end as one that turns once: an angle is one number for all who read it."""
    joint.set("type", "revolute")
    limit = joint.find("limit")
    if limit is None:
        limit = ET.SubElement(joint, "limit", effort="0", velocity="0")
    limit.set("lower", repr(-math.pi))
    limit.set("upper", repr(math.pi))


def _set_limit(joint: ET.Element, limit: Limit) -> None:
    element = joint.find("limit")
    if element is None:
        element = ET.SubElement(joint, "limit")
    values = {
        "lower": limit.lower_deg,
        "upper": limit.upper_deg,
        "velocity": limit.velocity_deg,
    }
    for key, degrees in values.items():
        if degrees is not None:
            element.set(key, repr(math.radians(degrees)))
    if limit.effort is not None:
        element.set("effort", repr(limit.effort))


def _set_follow(joint: ET.Element, follow: Follow) -> None:
    for old in joint.findall("mimic"):
        joint.remove(old)
    offset = repr(math.radians(follow.offset_deg))
    ET.SubElement(joint, "mimic", joint=follow.joint, multiplier=repr(follow.multiplier), offset=offset)


def _set_origin(joint: ET.Element, origin: Origin) -> None:
    for old in joint.findall("origin"):
        joint.remove(old)
    _add_origin(joint, origin.xyz, origin.rpy_deg)


def _add_frame(root: ET.Element, name: str, frame: Frame) -> None:
    ET.SubElement(root, "link", name=name)
    joint = ET.SubElement(root, "joint", name=f"{name}_fixed", type="fixed")
    ET.SubElement(joint, "parent", link=frame.link)
    ET.SubElement(joint, "child", link=name)
    _add_origin(joint, frame.xyz, frame.rpy_deg)


def _set_shapes(link: ET.Element, solids: Iterable[Solid]) -> None:
    for old in link.findall("collision"):
        link.remove(old)
    for solid in solids:
        collision = ET.SubElement(link, "collision")
        _add_origin(collision, solid.xyz, solid.rpy_deg)
        geometry = ET.SubElement(collision, "geometry")
        if solid.box is not None:
            ET.SubElement(geometry, "box", size=_numbers(solid.box))
        elif solid.cylinder is not None:
            radius, length = solid.cylinder
            ET.SubElement(geometry, "cylinder", radius=repr(radius), length=repr(length))
        else:
            ET.SubElement(geometry, "sphere", radius=repr(solid.sphere))


def _add_origin(element: ET.Element, xyz: Iterable[float], rpy_deg: Iterable[float]) -> None:
    ET.SubElement(element, "origin", xyz=_numbers(xyz), rpy=_numbers(map(math.radians, rpy_deg)))


def _numbers(values: Iterable[float]) -> str:
    return " ".join(map(repr, values))


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


class _OtherSide:
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
        return self._poses.get(link, np.eye(4))

    @cached_property
    def _poses(self) -> Mapping[str, Array]:
        return link_poses(self._root)


def link_poses(root: ET.Element) -> Mapping[str, Array]:
    """Pose of every link that a joint holds, with all joints at zero, in the root's axes. Shapes (4, 4)."""
    joints = {end_link(joint, "child"): joint for joint in root.findall("joint")}
    found: dict[str, Array] = {}

    def pose(link: str) -> Array:
        if link not in joints:
            return np.eye(4)
        if link not in found:
            origin = joints[link].find("origin")
            at = {} if origin is None else origin.attrib
            xyz, rpy = (np.array(at.get(key, "0 0 0").split(), dtype=np.float64) for key in ("xyz", "rpy"))
            found[link] = pose(end_link(joints[link], "parent")) @ _transform(xyz, rpy)
        return found[link]

    return {link: pose(link) for link in joints}


def _transform(xyz: Sequence[float] | Array, rpy: Array) -> Array:
    from scipy.spatial.transform import Rotation

    matrix = np.eye(4)
    matrix[:3, :3] = Rotation.from_euler("xyz", rpy).as_matrix()
    matrix[:3, 3] = xyz
    return matrix


def urdf_hash(urdf: str) -> str:
    """SHA-256, in hexadecimal, of what joint angles are made for.

    It is that of the canonical URDF (C14N 2.0, UTF-8) without comments, white space and limits of velocity
    and effort: a sign looks the same on a robot that is faster or stronger.
    """
    text = ET.canonicalize(urdf, strip_text=True, exclude_attrs=["velocity", "effort"])
    return hashlib.sha256(text.encode("utf-8")).hexdigest()


def joint_directions(urdf: ET.Element) -> Mapping[str, Array]:
    """The unit vectors along which joints' axes point with all joints at zero, in the root's frame."""
    poses, found = link_poses(urdf), {}
    for joint in urdf.findall("joint"):
        axis = joint.find("axis")
        if joint.attrib["type"] != "fixed":
            values = [1.0, 0.0, 0.0] if axis is None else [float(x) for x in axis.attrib["xyz"].split()]
            found[joint.attrib["name"]] = poses[end_link(joint, "child")][:3, :3] @ values
    return found
