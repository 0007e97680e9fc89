# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A robot's URDF with what its ``robot.yaml`` replaces and adds, from limits to collision shapes."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Mapping
from typing import NamedTuple

from teo_description.errors import DescriptionError
from teo_description.other_side import OtherSide
from teo_description.robot_file import RobotFile
from teo_description.schema.urdf import Follow, Frame, Limit, Origin, Solid

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
    links = {link.get("name", ""): link for link in root.iter("link")}
    joints = {joint.get("name", ""): joint for joint in root.findall("joint")}
    tops = set(links) - {_end(joint, "child") for joint in joints.values()}
    if root.tag != "robot" or len(tops) != 1:
        got = f"{len(tops)} links that no joint holds" if root.tag == "robot" else f"<{root.tag}>"
        raise DescriptionError("bad_robot", f"{where}: urdf: expected a robot with one root link, got {got}")
    _check_names(robot, links, joints, where)
    changes = (robot.limits, robot.follows, robot.origins, robot.frames, robot.collision.shapes)
    if not any(changes) and _ROOT_LINK in links:
        return Urdf(text, root)
    if _ROOT_LINK not in links:
        _add_root(root, *tops)
    for name, limit in robot.limits.items():
        _set_limit(joints[name], limit)
    for name, follow in robot.follows.items():
        _set_follow(joints[name], follow)
    for name, origin in robot.origins.items():
        _set_origin(joints[name], origin)
    sides = OtherSide(root, robot.mirror)
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
    for joint in root.iter("joint"):
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


def _end(joint: ET.Element, which: str) -> str:
    """Name of a joint's parent or child link; empty where the file does not say."""
    end = joint.find(which)
    return "" if end is None else end.get("link", "")


def _add_root(root: ET.Element, top: str) -> None:
    """An empty root of the name that the project uses, where the URDF's own root is."""
    ET.SubElement(root, "link", name=_ROOT_LINK)
    joint = ET.SubElement(root, "joint", name=f"{_ROOT_LINK}_fixed", type="fixed")
    ET.SubElement(joint, "parent", link=_ROOT_LINK)
    ET.SubElement(joint, "child", link=top)


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
