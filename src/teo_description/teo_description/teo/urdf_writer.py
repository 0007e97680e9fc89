# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""TEO's URDF written from the tables of this package."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterable, Mapping

from teo_description.teo import figures as tables
from teo_description.teo.figures import FixedFrame, Inertial, JointRow, Vector
from teo_description.teo.hand_drives import BODY_SPEED, DEFAULT_HAND_DRIVE, hand_speeds
from teo_description.teo.solids import Solid, collision_solids, uniform_inertial, visual_solids

ROBOT_NAME = "teo"
ROOT_LINK = "base_link"

# A placeholder [N m]: URDF demands a figure and none is published for the real joints.
EFFORT_PLACEHOLDER = 30.0

# [N m s/rad] and [N m], as in teo-gz-sim-models for every joint.
DAMPING, FRICTION = 0.001, 0.7

# Placeholders of dextra-yarp-devices' simulation model [kg]; no mass of the Dextra is published.
PALM_MASS, PHALANX_MASS = 0.3, 0.1

_HEAD_COMMENT = """
  TEO, the humanoid of Universidad Carlos III de Madrid, with two Dextra hands. Written by `build_urdf` from
  the tables in teo_description/teo/data, where every figure names its source: do not edit.
  Units: m, rad, kg. x forward, y left, z up. Joint effort limits and the hands' masses are placeholders.
  Velocity limits: 50 deg/s; of hand axes what their drive does under load ("How fast the hands are" in the
  README). Phalanges beyond the first follow it (mimic).
  """


def urdf(hand_drive: str = DEFAULT_HAND_DRIVE) -> str:
    """Build the URDF text, ending in a newline.

    Args:
        hand_drive: One of `HAND_DRIVES`.

    Raises:
        DescriptionError: ``unknown_hand_drive``.
    """
    speeds = hand_speeds(hand_drive)
    root = ET.Element("robot", name=ROBOT_NAME)
    root.append(ET.Comment(_HEAD_COMMENT))
    for name, colour in tables.materials().items():
        material = ET.SubElement(root, "material", name=name)
        ET.SubElement(material, "color", rgba=_numbers((*colour, 1.0)))

    shapes = tables.shapes()
    inertials = tables.inertials()
    # An empty root link: dynamics libraries such as KDL ignore the inertia of a root.
    ET.SubElement(root, "link", name=ROOT_LINK)
    _add_fixed(
        root,
        FixedFrame(name="root_link", parent=ROOT_LINK, origin=(0, 0, 0), rpy=(0, 0, 0)),
        joint="base_fixed",
    )
    _add_link(root, "root_link", inertials["root_link"], shapes)
    for joint in tables.body_joints():
        _add_joint(root, joint, BODY_SPEED)
        _add_link(root, f"{joint.name}_link", inertials[f"{joint.name}_link"], shapes)
    for side in ("Left", "Right"):
        _add_hand(root, side, shapes, speeds)
    for frame in tables.fixed_frames():
        ET.SubElement(root, "link", name=frame.name)
        _add_fixed(root, frame)

    ET.indent(root)
    return '<?xml version="1.0"?>\n' + ET.tostring(root, encoding="unicode") + "\n"


def _add_hand(
    root: ET.Element, side: str, shapes: Iterable[tables.Shape], speeds: Mapping[str, float]
) -> None:
    palm = f"{side}Hand_link"
    # The Dextra's base frame is the wrist's last link frame (dextra-yarp-devices).
    mount = FixedFrame(name=palm, parent=f"Frontal{side}Wrist_link", origin=(0, 0, 0), rpy=(0, 0, 0))
    _add_fixed(root, mount)
    _add_link(root, palm, uniform_inertial(PALM_MASS, collision_solids(shapes, palm)), shapes)
    for joint in tables.hand_joints(side):
        link = f"{joint.name}_link"
        _add_joint(root, joint, speeds[joint.follows or joint.name] * abs(joint.multiplier))
        _add_link(root, link, uniform_inertial(PHALANX_MASS, collision_solids(shapes, link)), shapes)


def _add_link(root: ET.Element, name: str, inertial: Inertial, shapes: Iterable[tables.Shape]) -> None:
    link = ET.SubElement(root, "link", name=name)
    element = ET.SubElement(link, "inertial")
    ET.SubElement(element, "origin", xyz=_numbers(inertial.centre), rpy="0 0 0")
    ET.SubElement(element, "mass", value=_number(inertial.mass))
    keys = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
    values = {key: _number(value) for key, value in zip(keys, inertial.inertia, strict=True)}
    ET.SubElement(element, "inertia", values)
    for solid in visual_solids(shapes, name):
        _add_solid(ET.SubElement(link, "visual"), solid)
    for solid in collision_solids(shapes, name):
        _add_solid(ET.SubElement(link, "collision"), solid)


def _add_solid(element: ET.Element, solid: Solid) -> None:
    ET.SubElement(element, "origin", xyz=_numbers(solid.centre), rpy=_numbers(solid.rpy))
    geometry = ET.SubElement(element, "geometry")
    if solid.kind == "box":
        ET.SubElement(geometry, "box", size=_numbers(solid.size))
    elif solid.kind == "cylinder":
        ET.SubElement(geometry, "cylinder", radius=_number(solid.size[0]), length=_number(solid.size[1]))
    else:
        ET.SubElement(geometry, "sphere", radius=_number(solid.size[0]))
    if solid.material:
        ET.SubElement(element, "material", name=solid.material)


def _add_joint(root: ET.Element, joint: JointRow, speed: float) -> None:
    element = ET.SubElement(root, "joint", name=joint.name, type="revolute")
    ET.SubElement(element, "parent", link=joint.parent)
    ET.SubElement(element, "child", link=f"{joint.name}_link")
    ET.SubElement(element, "origin", xyz=_numbers(joint.origin), rpy="0 0 0")
    ET.SubElement(element, "axis", xyz=_numbers(joint.axis))
    ET.SubElement(
        element,
        "limit",
        # Every digit: the limits read back are exactly math.radians() of the published degrees.
        lower=repr(joint.lower),
        upper=repr(joint.upper),
        velocity=repr(speed),
        effort=_number(EFFORT_PLACEHOLDER),
    )
    ET.SubElement(element, "dynamics", damping=_number(DAMPING), friction=_number(FRICTION))
    if joint.follows:
        multiplier, offset = _number(joint.multiplier), _number(joint.offset)
        ET.SubElement(element, "mimic", joint=joint.follows, multiplier=multiplier, offset=offset)


def _add_fixed(root: ET.Element, frame: FixedFrame, joint: str | None = None) -> None:
    element = ET.SubElement(root, "joint", name=joint or f"{frame.name}_fixed", type="fixed")
    ET.SubElement(element, "parent", link=frame.parent)
    ET.SubElement(element, "child", link=frame.name)
    ET.SubElement(element, "origin", xyz=_numbers(frame.origin), rpy=_numbers(frame.rpy))


def _number(value: float) -> str:
    # 14 digits: right angles stay right, and no digits from binary rounding in a file that people read.
    return f"{value + 0.0:.14g}"


def _numbers(values: Vector | Iterable[float]) -> str:
    return " ".join(_number(value) for value in values)
