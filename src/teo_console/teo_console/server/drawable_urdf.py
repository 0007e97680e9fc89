# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A robot's description as the page can draw it: files of meshes are on no page."""

from __future__ import annotations

import xml.etree.ElementTree as ET


def drawable_urdf(text: str) -> str:
    """A URDF in which the plain shapes that count in a collision stand for meshes.

    Args:
        text: As the driver published it. What is no XML comes back as it is: the page says that it has no
            robot.
    """
    try:
        robot = ET.fromstring(text)
    except ET.ParseError:
        return text
    changed = False
    for link in robot.iter("link"):
        meshes = [visual for visual in link.findall("visual") if visual.find("geometry/mesh") is not None]
        if not meshes:
            continue
        changed = True
        for visual in meshes:
            link.remove(visual)
        for collision in link.findall("collision"):
            if collision.find("geometry/mesh") is None:
                shape = ET.SubElement(link, "visual")
                shape.extend(collision)
                material = ET.SubElement(shape, "material", name="plain_shape")
                ET.SubElement(material, "color", rgba="0.75 0.77 0.8 1")
    return ET.tostring(robot, encoding="unicode") if changed else text
