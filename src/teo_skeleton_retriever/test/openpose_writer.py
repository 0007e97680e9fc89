# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Writes people as OpenPose's `--write_json` does, version 1.3."""

from __future__ import annotations

import json
from pathlib import Path

from teo_skeleton_retriever.detectors.openpose_files import PARTS, People


def frame_path(folder: Path, name: str) -> Path:
    """Where OpenPose puts the keypoints of an image of this name (without its suffix)."""
    return folder / f"{name}_keypoints.json"


def format_frame(people: People) -> str:
    """People as the text of one file."""
    written = [
        {keys[0]: getattr(person, part).ravel().tolist() for part, keys in PARTS.items()} for person in people
    ]
    return json.dumps({"version": 1.3, "people": written})


def write_frame(path: Path, people: People) -> None:
    path.write_text(format_frame(people), encoding="utf-8")
