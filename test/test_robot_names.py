# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Robots are data: no code names a joint, link or frame of any of them."""

from __future__ import annotations

import re
import subprocess
import xml.etree.ElementTree as ET
from pathlib import Path

from teo_description.errors import DescriptionError
from teo_description.humanoid import available_robots, load_humanoid

ROOT = Path(__file__).parents[1]

#: The root that every robot has, and names that are words of the language.
WORDS = {"base_link", "pelvis"}


def names_of(robot: str) -> set[str]:
    try:
        root = ET.fromstring(load_humanoid(robot).urdf_text())
    except DescriptionError as error:
        if error.code == "robot_package_missing":
            return set()
        raise
    return {element.attrib["name"] for tag in ("joint", "link") for element in root.iter(tag)} - WORDS


def sources() -> list[Path]:
    listed = subprocess.run(
        ["git", "ls-files", "src/*.py", "src/*.js", "studio/teo_*.py", "tools/*.py", "scripts/*.py"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    ).stdout.split()
    return [ROOT / name for name in listed if "/test/" not in name]


def test_no_code_names_a_joint_a_link_or_a_frame_of_a_robot():
    names = set().union(*map(names_of, available_robots()))
    assert {"AxialNeck", "right_palm", "R_index_proximal_joint"} <= names
    named = re.compile(rf"\b({'|'.join(sorted(map(re.escape, names), key=len, reverse=True))})\b")
    found = {
        str(path.relative_to(ROOT)): sorted(set(hits))
        for path in sources()
        if (hits := named.findall(path.read_text(encoding="utf-8")))
    }
    assert found == {}
