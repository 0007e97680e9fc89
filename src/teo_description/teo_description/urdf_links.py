# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The links of a URDF that has no ``robot.yaml`` yet, with what that file asks for."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np

from teo_common.arrays import Array
from teo_description.completed_urdf import joint_directions, link_poses
from teo_description.errors import DescriptionError
from teo_description.humanoid import find_mesh
from teo_description.pictures.visual_parts import visual_mesh


def describe_links(urdf: Path) -> Iterator[str]:
    """A line for each link: where it is, what moves it how, and the box that holds its meshes.

    Raises:
        DescriptionError: ``urdf_missing``, ``bad_robot``; ``bad_mesh``, ``meshes_unavailable``.
    """
    try:
        root = ET.fromstring(urdf.read_text(encoding="utf-8"))
    except OSError as error:
        raise DescriptionError("urdf_missing", f"expected a URDF, got: {error}") from error
    except ET.ParseError as error:
        raise DescriptionError("bad_robot", f"{urdf}: expected XML: {error}") from error
    poses, directions = link_poses(root), joint_directions(root)
    joints = {child.attrib["link"]: joint for joint in root.findall("joint") for child in joint.iter("child")}
    for link in root.findall("link"):
        name = link.attrib["name"]
        pose = poses.get(name, np.eye(4))
        said = f"{name}: at ({_row(pose[:3, 3], 3)}), x ({_row(pose[:3, 0])}), z ({_row(pose[:3, 2])})"
        if name in joints:
            said += f"; {_moved(joints[name], directions)}"
        yield said + _box(link, urdf)


def box_about(points: Array) -> str:
    """The box that holds points, as it is written under ``collision.shapes``. Shape (n, 3) [m]."""
    low, high = points.min(axis=0), points.max(axis=0)
    return f"{{xyz: [{_row(0.5 * (low + high), 3)}], box: [{_row(high - low, 3)}]}}"


def _row(values: Array, digits: int = 2) -> str:
    return ", ".join(f"{value:.{digits}f}" for value in values + 0.0)


def _moved(joint: ET.Element, directions: Mapping[str, Array]) -> str:
    name, limit = joint.attrib["name"], joint.find("limit")
    if joint.attrib["type"] == "fixed":
        return f"fixed by {name}"
    said = f"moved by {name} about ({_row(directions[name])})"
    if limit is not None:
        low, high, speed = (
            math.degrees(float(limit.get(key, "0"))) for key in ("lower", "upper", "velocity")
        )
        said += f", {low:.0f} to {high:.0f} deg, {speed:.0f} deg/s"
    mimic = joint.find("mimic")
    return said if mimic is None else f"{said}, follows {mimic.attrib['joint']}"


def _box(link: ET.Element, urdf: Path) -> str:
    points = []
    for visual in link.findall("visual"):
        mesh = visual.find("geometry/mesh")
        if mesh is None:
            continue
        path = find_mesh(urdf.parent, mesh.attrib["filename"])
        if path is None:
            return f"; no file {mesh.attrib['filename']}"
        points.append(visual_mesh(visual, path).vertices)
    return f"; {box_about(np.vstack(points))}" if points else ""
