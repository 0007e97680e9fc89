# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Writes people as OpenPose's `--write_json` does, version 1.3."""

from __future__ import annotations

import json
from pathlib import Path

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.detectors.openpose_files import PARTS, VERSION, People
from teo_skeleton_retriever.layouts.person_2d import Person2D

DIGITS = 6
"""Significant digits of a number, as OpenPose's own stream writes them: 1e-3 px at 1000 px."""


def frame_path(folder: Path, name: str) -> Path:
    """Tell where OpenPose puts the keypoints of an image of this name (without its suffix)."""
    return folder / f"{name}_keypoints.json"


def format_frame(frame: People) -> str:
    """Write people as the text of one file; it is always of the present version."""
    data: dict[str, object] = {"version": VERSION, "people": [_person(person) for person in frame]}
    return json.dumps(data, separators=(",", ":"))


def write_frame(path: Path, frame: People) -> None:
    """Write one file."""
    path.write_text(format_frame(frame), encoding="utf-8")


def _person(person: Person2D) -> dict[str, object]:
    parts: dict[str, object] = {keys[0]: _numbers(getattr(person, part)) for part, keys in PARTS.items()}
    unused = {f"{key}_keypoints_3d": [] for key in ("pose", "face", "hand_left", "hand_right")}
    return {"person_id": [-1], **parts, **unused}


def _numbers(table: FloatArray) -> list[float]:
    rounded = [float(f"{number:.{DIGITS}g}") for number in table.ravel()]
    return [int(number) if number.is_integer() and abs(number) < 1e15 else number for number in rounded]
